#pragma once
/** @file
The courses of an arm in a trial: a gross motion from its ready posture to the pre-grasp pose,
straight in joint space, then fine motions of the hand straight in the world: the approach, and the
lift.

Postures at the grasp pose come from inverse kinematics (arm_inverse.h), those farthest from their
limits first. Each is followed along the lines by Newton's method; the first is chosen whose whole
course

    keeps every joint within its limits and, at the times of the trial, its speed,
    keeps the dexterity (arm.h) at kLeastDexterity or more,
    keeps the arm's capsules off each other (links that are not neighbours), off the table (z = 0)
    and off the object, which moves with the hand in the lift,
    keeps the hand within kLineTolerance of the lines between the knots.

In the gross motion the hand goes from CalcRestPosture to its pre-grasp posture; there its contact
surface keeps off the table, the object, and the arm but for its last two links.

If there is none, the reason is that of the posture which came farthest. The gross motion takes the
least time in which no joint exceeds its speed, minimum-jerk: T = 15/8 max_i |dq_i| / speed_i.

Not modelled: the arm's dynamics (torques, masses, deflection), and collisions of the hand with the
arm in approach and lift. A hand whose grasp seeks the palm is lifted from where it touched, up to
16 mm off the line that is checked. */

#include <string>
#include <vector>

#include "core/arm/arm_record.h"
#include "core/arm/mounted_arm.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

inline constexpr double kLeastDexterity = 0.02;   ///< proposed
inline constexpr double kLineTolerance = 0.0005;  ///< [m]

/** A straight motion of the hand without rotation, minimum-jerk. */
struct HandLine {
  Pose X_WH = Pose::Identity();          ///< at the start
  Eigen::Vector3d motion_W = {0, 0, 0};  ///< [m]
  double time = 1.0;                     ///< [s]
};

struct ArmTask {
  HandLine approach;  ///< ends at the grasp pose
  HandLine lift;      ///< starts there
  const GraspObject* object = nullptr;
  Pose X_WO = Pose::Identity();
  const Hand* hand = nullptr;
  Eigen::VectorXd q_rest, q_pre;  ///< of the hand at both ends of the gross motion
};

enum class ArmFault { kNone, kOutOfReach, kNoStraightPath, kNearSingularity };

struct ArmCourse {
  ArmFault fault = ArmFault::kNone;
  std::string reason;  ///< one sentence for a person; empty: there is a course
  ArmRecord record;
  std::vector<Eigen::VectorXd> approach, lift;  ///< knots, evenly in time; empty: no course
};

/** @pre the object has a distance field. */
ArmCourse PlanArmCourse(const MountedArm& mounted, const ArmTask& task);

/** What an arm touches with its capsules; empty: nothing. "link 3 would meet the table". */
std::string FindArmCollision(const MountedArm& mounted, const Eigen::VectorXd& q,
                             const GraspObject& object, const Pose& X_WO);
/** The hand's posture in the ready posture of the arm: every joint at 0, or at its nearest limit. */
Eigen::VectorXd CalcRestPosture(const Hand& hand);
/** What arm and hand touch where every trial begins, of table and arm alone. */
std::string FindReadyCollision(const MountedArm& mounted, const Hand& hand);

}  // namespace graspbench
