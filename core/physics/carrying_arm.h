#pragma once
/** @file
A robot arm that carries the hand of a world, in place of the springs of SimConfig. Its joint speeds
replace the six speeds of the hand's base,

    [w_WH; v_WH] = J(q) qdot        [wdot_WH; vdot_WH] = J qddot + Jdot qdot

So the hand yields as the arm's joints do, and the arm's reflected inertia is part of the mass
matrix (Khatib 1987). Along a direction that is lost in a singular posture, the hand does not yield.

Each joint's drive is a spring-damper to the commanded angle, which is given or follows from the
hand's commanded pose by inverse kinematics (RefinePosture). The drive also carries the arm and the
hand: neither their weight nor their inertia along the commanded motion causes a deflection. Its
torque is limited by the joint's limit. The weights count towards it; the inertia along the
commanded motion does not.

Not modelled: friction and play of the joints, flexible links, collisions of the arm, and
velocity-dependent forces of the arm on its drives. */

#include <Eigen/Core>
#include <vector>

#include "core/arm/mounted_arm.h"

namespace graspbench {

struct WorldCommand;

/** Columns [angular; linear] by joint, of H's origin in W. */
using ArmJacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

class CarryingArm {
 public:
  /** @param arm  must outlive this object.
  @param q, u  commanded values until the first Follow [rad], [rad/s]. */
  CarryingArm(const MountedArm& arm, const Eigen::VectorXd& q, const Eigen::VectorXd& u);

  int num_joints() const { return arm_->arm->num_joints(); }
  const ArmJoint& joint(int i) const { return arm_->arm->joints[static_cast<size_t>(i)]; }

  /** Takes over the command for the end of a step of length h. Returns false if the arm cannot
  follow; it then keeps its commanded posture. */
  bool Follow(const WorldCommand& command, double h);
  const Eigen::VectorXd& q_command() const { return q_command_; }
  const Eigen::VectorXd& u_command() const { return u_command_; }
  const Eigen::VectorXd& acceleration_command() const { return acceleration_command_; }

  /** Computes poses and the Jacobian at q. */
  void Update(const Eigen::VectorXd& q);
  const Pose& X_WH() const { return X_WH_; }
  const ArmJacobian& jacobian() const { return J_; }
  /** Returns Jdot qdot at joint speeds u. */
  Eigen::Matrix<double, 6, 1> CalcVelocityTerm(const Eigen::VectorXd& u) const;
  Eigen::MatrixXd CalcMass() const;
  /** Returns the joint torques of the arm's own weight [N m]. */
  Eigen::VectorXd CalcWeight(const Eigen::Vector3d& gravity_W) const;
  /** Returns the [moment; force] on H's origin in W whose joint torques are closest to tau. */
  Eigen::Matrix<double, 6, 1> CalcBaseForce(const Eigen::VectorXd& tau) const;

 private:
  std::vector<Pose> ListLinkPoses() const;  // X_BL

  const MountedArm* arm_;
  Eigen::VectorXd q_command_, u_command_, acceleration_command_;
  Pose X_WH_command_;
  std::vector<Pose> X_BL_;  // for the last link X_BH instead of X_BF
  Pose X_WH_;
  ArmJacobian J_;
};

}  // namespace graspbench
