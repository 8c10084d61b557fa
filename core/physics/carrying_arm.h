#pragma once
/** @file
The arm that carries the hand of a world, in place of the springs of SimConfig: its joints' speeds
replace the six speeds of the hand's base,

    [w_WH; v_WH] = J(q) qdot        [wdot_WH; vdot_WH] = J qddot + Jdot qdot

so the hand yields as the arm's joints do, the arm's reflected inertia is part of the mass matrix
(Khatib 1987), and along a direction that a singular posture has lost the hand does not yield.

Each joint's drive is a spring with damping beside it to the commanded angle, which is given or
follows the hand's commanded pose by inverse kinematics (RefinePosture). The drive also carries the
arm and the hand: their weight, and their inertia along the commanded motion, deflect nothing. Its
torque has the joint's limit. The weights count towards it, the inertia along the commanded motion
does not.

Not modelled: friction and play of the joints, links that bend, collisions of the arm, the arm's
forces of velocity on its drives. */

#include <Eigen/Core>
#include <vector>

#include "core/arm/mounted_arm.h"

namespace graspbench {

struct WorldCommand;

/** [angular; linear] by joint, of H's origin in W. */
using ArmJacobian = Eigen::Matrix<double, 6, Eigen::Dynamic>;

class CarryingArm {
 public:
  /** @param arm  outlives this.   @param q, u  commanded until Follow says otherwise [rad],
  [rad/s]. */
  CarryingArm(const MountedArm& arm, const Eigen::VectorXd& q, const Eigen::VectorXd& u);

  int num_joints() const { return arm_->arm->num_joints(); }
  const ArmJoint& joint(int i) const { return arm_->arm->joints[static_cast<size_t>(i)]; }

  /** Takes over what the hand is asked for at the end of a step of length h. False: the arm cannot
  follow, and stays. */
  bool Follow(const WorldCommand& command, double h);
  const Eigen::VectorXd& q_command() const { return q_command_; }
  const Eigen::VectorXd& u_command() const { return u_command_; }
  const Eigen::VectorXd& acceleration_command() const { return acceleration_command_; }

  /** Poses and Jacobian at q. */
  void Update(const Eigen::VectorXd& q);
  const Pose& X_WH() const { return X_WH_; }
  const ArmJacobian& jacobian() const { return J_; }
  /** Jdot qdot at joint speeds u. */
  Eigen::Matrix<double, 6, 1> CalcVelocityTerm(const Eigen::VectorXd& u) const;
  Eigen::MatrixXd CalcMass() const;
  /** Torques of the arm's own weight on the joints [N m]. */
  Eigen::VectorXd CalcWeight(const Eigen::Vector3d& gravity_W) const;
  /** [moment; force] on H's origin in W whose torques on the joints come nearest to tau. */
  Eigen::Matrix<double, 6, 1> CalcBaseForce(const Eigen::VectorXd& tau) const;

 private:
  std::vector<Pose> ListLinkPoses() const;  // X_BL

  const MountedArm* arm_;
  Eigen::VectorXd q_command_, u_command_, acceleration_command_;
  Pose X_WH_command_;
  std::vector<Pose> X_BL_;  // of the last link X_BH in place of X_BF
  Pose X_WH_;
  ArmJacobian J_;
};

}  // namespace graspbench
