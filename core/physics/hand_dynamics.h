#pragma once
/** @file
The hand's equations of motion in the degrees of freedom that its couplings leave.

Where the links are, what each carries and the forces of velocity are Simbody's (hand_tree.h). With
a joint's motion vector about the world's origin, S = (a, p x a), of a prismatic joint (0, a), and
the momentum F of all that it carries, the mass matrix is

    M(joint, ancestor) = S_ancestor . F_joint

(Featherstone 2008), summed over joints with their rates.

Degrees of freedom: one for every driven joint, then six of the base, which an arm carries. A
coupled joint shares that of the joint it follows: u_joint = rate_j * u_dof (core/hand/hand.h). One
whose coupling yields has a second one of its own, its deviation: u_joint = rate_j * u_dof +
u_deviation. Speeds are

    u = [ of driven joints and deviations (num_dofs) | w_WH (3) | v_WH (3) ]

v_WH is that of H's origin.
*/

#include <Eigen/Core>
#include <vector>

#include "core/base/pose.h"
#include "core/hand/hand.h"
#include "core/physics/simbody/hand_tree.h"

namespace graspbench {

using SpatialVector = Eigen::Matrix<double, 6, 1>;  ///< (angular, linear)

/** Slower than this a hand has no forces of velocity: at a finger some 1e-4 N m [rad/s, m/s]. */
inline constexpr double kFastSpeed = 0.3;

class HandDynamics {
 public:
  explicit HandDynamics(const Hand& hand);

  int num_dofs() const { return num_dofs_; }  ///< of the joints
  int num_speeds() const { return num_dofs_ + 6; }
  int num_joints() const { return static_cast<int>(joint_link_.size()); }
  int dof_of_joint(int joint) const { return dof_of_joint_[joint]; }
  /** That of the joint's deviation from its coupling; -1: none, it is rigid. */
  int deviation_dof(int joint) const { return deviation_dof_[joint]; }
  bool is_deviation(int dof) const { return deviation_dof_[joint_of_dof_[dof]] == dof; }
  /** The joint a degree of freedom is named after (its middle joint when coupled; of a deviation
  the joint that deviates). */
  int joint_of_dof(int dof) const { return joint_of_dof_[dof]; }
  /** The distal joint that shares the degree of freedom by the hand's coupling rule; -1: none.
  Joints tied by a linkage (HandJoint::is_mimic) do not count: their rate never changes. */
  int distal_of_dof(int dof) const { return distal_of_dof_[dof]; }
  double rate_of_joint(int joint) const { return rate_[joint]; }
  void SetRate(int joint, double rate) { rate_[joint] = rate; }
  /** Calls function(dof, rate) for every degree of freedom that moves the joint. */
  template <class Function>
  void ForEachSpeed(int joint, Function&& function) const {
    if (rate_[joint] != 0.0) function(dof_of_joint_[joint], rate_[joint]);
    if (deviation_dof_[joint] >= 0) function(deviation_dof_[joint], 1.0);
  }
  bool Moves(int joint) const { return rate_[joint] != 0.0 || deviation_dof_[joint] >= 0; }
  double CalcJointSpeed(int joint, const Eigen::VectorXd& u) const {
    double speed = 0.0;
    ForEachSpeed(joint, [&](int dof, double rate) { speed += rate * u[dof]; });
    return speed;
  }

  /** Poses of links, motion vectors of joints, carried centres of mass.
  @param q  (num_joints) [rad]. */
  void UpdatePositions(const Pose& X_WH, const Eigen::VectorXd& q);

  const Eigen::Vector3d& p_WH() const { return p_WH_; }
  const Pose& X_WL(int link) const { return X_WL_[link]; }
  /** Motion vector of a joint about the world's origin; a unit rate of the joint. */
  const SpatialVector& motion(int joint) const { return S_[joint]; }
  /** Joints between root and link, base first. */
  const std::vector<int>& chain(int link) const { return chain_[link]; }

  /** Mass matrix (num_speeds x num_speeds) for the current positions. */
  void CalcMassMatrix(Eigen::Ref<Eigen::MatrixXd> M);

  /** Generalised force (num_speeds) that gives zero acceleration at speeds u (num_speeds): gravity,
  and where a speed is above kFastSpeed Coriolis, centrifugal and gyroscopic forces. */
  void CalcBias(const Eigen::VectorXd& u, const Eigen::Vector3d& gravity_W,
                Eigen::Ref<Eigen::VectorXd> bias);

 private:
  Eigen::Matrix<double, 6, 6> CalcBaseMass() const;

  HandTree tree_;
  int num_dofs_ = 0;
  std::vector<int> parent_, joint_;               // by link; -1: none, fixed
  std::vector<double> link_mass_, carried_mass_;  // by link
  std::vector<Eigen::Vector3d> p_LLcm_;           // by link
  std::vector<Eigen::Vector3d> axis_;
  std::vector<bool> slides_;  // by joint
  std::vector<std::vector<int>> chain_;
  std::vector<int> joint_link_;  // by joint
  std::vector<int> dof_of_joint_;
  std::vector<int> deviation_dof_;  // by joint
  std::vector<double> rate_;
  std::vector<int> joint_of_dof_;
  std::vector<int> distal_of_dof_;
  std::vector<Pose> X_WL_;
  std::vector<CarriedMass> carried_;             // by link
  std::vector<Eigen::Vector3d> carried_moment_;  // by link, about the world's origin [kg m]
  std::vector<SpatialVector> S_;                 // by joint
  Eigen::Vector3d p_WH_ = Eigen::Vector3d::Zero();
};

}  // namespace graspbench
