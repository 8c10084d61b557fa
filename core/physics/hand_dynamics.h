#pragma once
/** @file
Equations of motion of the hand in the degrees of freedom that its couplings leave.

Simbody (hand_tree.h) provides the link poses, the mass that each link carries, and the
velocity-dependent forces. The motion vector of a joint about the world's origin is S = (a, p x a),
or (0, a) for a prismatic joint. With the momentum F of everything that the joint carries, the mass
matrix is

    M(joint, ancestor) = S_ancestor . F_joint

(Featherstone 2008), summed over joints, weighted with their rates.

There is one degree of freedom per driven joint, followed by the six of the base, which an arm
carries. A coupled joint shares the degree of freedom of the joint that it follows: u_joint = rate_j
* u_dof (core/hand/hand.h). A joint with a compliant coupling also has a degree of freedom of its
own, its deviation: u_joint = rate_j * u_dof + u_deviation. The speeds are

    u = [ of driven joints and deviations (num_dofs) | w_WH (3) | v_WH (3) ]

where v_WH is the velocity of H's origin. */

#include <Eigen/Core>
#include <vector>

#include "core/base/pose.h"
#include "core/hand/hand.h"
#include "core/physics/simbody/hand_tree.h"

namespace graspbench {

using SpatialVector = Eigen::Matrix<double, 6, 1>;  ///< (angular, linear)

/** Below this speed, velocity-dependent forces of the hand are neglected: some 1e-4 N m at a finger
[rad/s, m/s]. */
inline constexpr double kFastSpeed = 0.3;

class HandDynamics {
 public:
  explicit HandDynamics(const Hand& hand);

  int num_dofs() const { return num_dofs_; }  ///< of the joints
  int num_speeds() const { return num_dofs_ + 6; }
  int num_joints() const { return static_cast<int>(joint_link_.size()); }
  int dof_of_joint(int joint) const { return dof_of_joint_[joint]; }
  /** Returns the degree of freedom of the joint's deviation from its coupling; -1: the coupling is
  rigid. */
  int deviation_dof(int joint) const { return deviation_dof_[joint]; }
  bool is_deviation(int dof) const { return deviation_dof_[joint_of_dof_[dof]] == dof; }
  /** Returns the joint that a degree of freedom is named after: the middle joint of a coupled pair,
  or the joint that deviates. */
  int joint_of_dof(int dof) const { return joint_of_dof_[dof]; }
  /** Returns the distal joint that shares the degree of freedom by the hand's coupling rule; -1:
  none. Joints tied by a linkage (HandJoint::is_mimic) do not count, because their rate never
  changes. */
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

  /** Updates link poses, joint motion vectors and the centres of the carried masses.
  @param q  (num_joints) [rad]. */
  void UpdatePositions(const Pose& X_WH, const Eigen::VectorXd& q);

  const Eigen::Vector3d& p_WH() const { return p_WH_; }
  const Pose& X_WL(int link) const { return X_WL_[link]; }
  /** Motion vector of a joint about the world's origin, for a unit rate of the joint. */
  const SpatialVector& motion(int joint) const { return S_[joint]; }
  /** Joints between the root and a link, base first. */
  const std::vector<int>& chain(int link) const { return chain_[link]; }

  /** Computes the mass matrix (num_speeds x num_speeds) for the current positions. */
  void CalcMassMatrix(Eigen::Ref<Eigen::MatrixXd> M);

  /** Computes the generalised force (num_speeds) that gives zero acceleration at speeds u
  (num_speeds): gravity and, if a speed exceeds kFastSpeed, Coriolis, centrifugal and gyroscopic
  forces. */
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
