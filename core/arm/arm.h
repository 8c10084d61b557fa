#pragma once
/** @file
A robot arm as data: a chain of revolute joints in Denavit and Hartenberg's form (1955, "standard"),
limits, speeds, torques, stiffnesses, masses and capsules.

Frame B is the arm's base, its z along joint 1. Frame i is fixed to link i, behind joint i:

    X_(i-1)i(q) = Rot(z, q_i + offset_i) Shift(z, d_i) Shift(x, a_i) Rot(x, alpha_i)

The last frame is the flange F, to which the hand is fixed. Each joint's drive is a spring between
its commanded angle and its angle, so that a force f at the flange moves it by J K^-1 J^T f
(Salisbury 1980). Not modelled: joints that slide, coupling between joints, play, links that bend.
*/

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/base/pose.h"

namespace graspbench {

struct ArmJoint {
  std::string name;
  double a = 0.0, d = 0.0;            ///< [m]
  double alpha = 0.0, offset = 0.0;   ///< [rad]
  double lower = 0.0, upper = 0.0;    ///< of q [rad]
  double speed = 0.0;                 ///< largest [rad/s]
  double torque = 0.0;                ///< largest [N m]
  double stiffness = 0.0;             ///< of drive and gear, seen at the joint [N m/rad]
  double armature = 0.0;              ///< rotor's inertia, seen at the joint [kg m^2]
  double mass = 0.0;                  ///< of the link behind it [kg]
  Eigen::Vector3d p_com = {0, 0, 0};  ///< its centre of mass in the link's frame [m]
  /** Moments of inertia about the axes of the link's frame through its centre of mass; products of
  inertia are 0 [kg m^2]. */
  Eigen::Vector3d inertia = {0, 0, 0};
};

struct ArmCapsule {
  int link = 0;                                        ///< 0: the base, fixed to B
  Eigen::Vector3d p_LA = {0, 0, 0}, p_LB = {0, 0, 0};  ///< ends of the axis [m]
  double radius = 0.0;                                 ///< [m]
};

struct Arm {
  std::string id;
  std::string name;
  std::string folder;
  std::string content_hash;  ///< of arm.yaml
  std::vector<ArmJoint> joints;
  std::vector<ArmCapsule> capsules;
  Eigen::VectorXd ready;  ///< where the gross motion starts [rad]

  int num_joints() const { return static_cast<int>(joints.size()); }
};

/** X_(i-1)i of the link behind it, at angle 0. */
Pose CalcArmPoseAtZero(const ArmJoint& joint);

/** X_BL of the base (identity) and of every link; the last is X_BF.
@pre q has one angle a joint. */
std::vector<Pose> CalcArmPoses(const Arm& arm, const Eigen::VectorXd& q);
Pose CalcFlangePose(const Arm& arm, const Eigen::VectorXd& q);

/** Of the flange: [v_BF; w_BF] = J qdot, both in B; (6, num_joints).
@param X_BL  of CalcArmPoses. */
Eigen::MatrixXd CalcArmJacobian(const std::vector<Pose>& X_BL);

/** Acceleration of the flange while no joint accelerates, Jdot qdot: [linear; angular] in B.
@param X_BL  of CalcArmPoses.   @param u  joint speeds [rad/s]. */
Eigen::Matrix<double, 6, 1> CalcArmVelocityTerm(const std::vector<Pose>& X_BL,
                                                const Eigen::VectorXd& u);

/** Mass matrix of links and rotors (num_joints, num_joints) [kg m^2].
@param X_BL  of CalcArmPoses; the last is not used but for the last link. */
Eigen::MatrixXd CalcArmMass(const Arm& arm, const std::vector<Pose>& X_BL);
/** Torques of the links' weight on the joints (num_joints) [N m]. @param gravity_B [m/s^2]. */
Eigen::VectorXd CalcArmWeight(const Arm& arm, const std::vector<Pose>& X_BL,
                              const Eigen::Vector3d& gravity_B);

/** How the flange yields to a force and moment on it: [linear; angular] = C [force; moment], with
C = J K^-1 J^T, in the Jacobian's frame. Along a direction that a singular posture has lost C is 0:
the arm is stiff there. */
Eigen::Matrix<double, 6, 6> CalcArmCompliance(const Arm& arm, const Eigen::MatrixXd& jacobian);

/** Longest distance of the flange from joint 1: the sum of the links' lengths [m]. */
double CalcArmReach(const Arm& arm);

/** How far from a singular posture: the smallest singular value of the Jacobian whose linear rows
are divided by the arm's reach; 0 at a singular posture. */
double CalcDexterity(const Arm& arm, const Eigen::MatrixXd& jacobian);

}  // namespace graspbench
