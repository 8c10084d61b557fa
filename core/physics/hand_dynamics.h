#pragma once
/** @file
Kinematics, mass matrix and bias of the hand, in flat arrays for the inner loop.

The numbers are those of the Simbody model; its own routines cost several times more per step
because the packaged library checks every access. Tests hold both equal on random states (mass
matrix and bias to 1e-12), and every trial compares them again at its end.

Method: spatial vectors about the world's origin, expressed in W (Featherstone 2008): a joint's
motion vector is S = (a, p x a), of a prismatic joint (0, a); composite rigid bodies give the mass
matrix, recursive Newton-Euler the bias.

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

namespace graspbench {

using SpatialVector = Eigen::Matrix<double, 6, 1>;  ///< (angular, linear)

/** Mass, first moment and second moment about the world's origin. */
struct SpatialInertia {
  double mass = 0.0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();   ///< mass * p_Wcm
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the world's origin

  void Add(const SpatialInertia& other) {
    mass += other.mass;
    moment += other.moment;
    inertia += other.inertia;
  }
  /** Momentum of a body with this inertia moving with V. */
  SpatialVector operator*(const SpatialVector& V) const;
};

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

  /** Poses and inertias of links, motion vectors of joints. @param q  (num_joints) [rad]. */
  void UpdatePositions(const Pose& X_WH, const Eigen::VectorXd& q);

  /** The same from poses of all links that somebody else found. */
  void TakePoses(const Pose& X_WH, const std::vector<Pose>& X_WL);

  const Eigen::Vector3d& p_WH() const { return p_WH_; }
  const Pose& X_WL(int link) const { return X_WL_[link]; }
  /** Motion vector of a joint about the world's origin; a unit rate of the joint. */
  const SpatialVector& motion(int joint) const { return S_[joint]; }
  /** Joints between root and link, base first. */
  const std::vector<int>& chain(int link) const { return chain_[link]; }

  /** Mass matrix (num_speeds x num_speeds) for the current positions. */
  void CalcMassMatrix(Eigen::Ref<Eigen::MatrixXd> M) const;

  /** Generalised force (num_speeds) that gives zero acceleration at speeds u (num_speeds): Coriolis,
  centrifugal, gyroscopic, gravity. */
  void CalcBias(const Eigen::VectorXd& u, const Eigen::Vector3d& gravity_W,
                Eigen::Ref<Eigen::VectorXd> bias) const;

 private:
  struct LinkInertia {
    double mass;
    Eigen::Vector3d p_LLcm;
    Eigen::Matrix3d I_LLcm;
  };

  void UpdateInertias();

  int num_dofs_ = 0;
  std::vector<int> parent_;  // by link
  std::vector<int> joint_;   // by link; -1: fixed
  std::vector<Pose> X_PJ_;   // by link
  std::vector<Eigen::Vector3d> axis_;
  std::vector<bool> slides_;  // by joint
  std::vector<LinkInertia> inertia_;
  std::vector<std::vector<int>> chain_;
  std::vector<int> joint_link_;  // by joint
  std::vector<int> dof_of_joint_;
  std::vector<int> deviation_dof_;  // by joint
  std::vector<double> rate_;
  std::vector<int> joint_of_dof_;
  std::vector<int> distal_of_dof_;
  std::vector<Pose> X_WL_;
  std::vector<SpatialInertia> inertia_W_;  // by link
  std::vector<SpatialVector> S_;           // by joint
  Eigen::Vector3d p_WH_ = Eigen::Vector3d::Zero();
};

}  // namespace graspbench
