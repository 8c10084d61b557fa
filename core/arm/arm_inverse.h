#pragma once
/** @file
Inverse kinematics: all postures of an arm that put its flange to a pose.

An arm whose first two axes meet (a_1 = 0) and whose last three meet in the wrist centre P (a
spherical wrist), with six joints, or with seven and joint 3 held at an angle, is solved in closed
form (Pieper 1968): the distance of P from the shoulder gives the elbow's angle (2 solutions), the
height of P the two before it (2), the orientation the wrist's three (2): at most 8 postures. With
seven joints joint 3 is the free parameter. All other arms are solved by Newton's method with
damping from kNumStarts random postures, so that some may be missed.

Joint angles are those nearest to the middle of their range. Postures beyond the limits are listed,
too. */

#include <optional>
#include <vector>

#include "core/arm/arm.h"

namespace graspbench {

inline constexpr int kNumStarts = 64;
/** A posture counts when it misses the pose by less [m], [rad]. */
inline constexpr double kPoseTolerance = 1e-10;

/** What keeps the flange from a pose whatever the limits. */
struct ReachFault {
  int joint = -1;          ///< that is stretched or folded as far as it goes; -1: unknown
  double shortfall = 0.0;  ///< how far the wrist centre, or the flange, stays away [m]
};

struct ArmPostures {
  std::vector<Eigen::VectorXd> postures;
  ReachFault fault = {};  ///< where there is none
};

/** Whether the closed form holds; `kFree`: with joint 3 as a parameter. */
enum class ArmForm { kOther, kSixJoints, kFree };
ArmForm FindArmForm(const Arm& arm);

/** @param free_angle  of joint 3, for ArmForm::kFree [rad]; unset: the middles of `num_free`
equal parts of its range.
*/
ArmPostures FindArmPostures(const Arm& arm, const Pose& X_BF, int num_free,
                            std::optional<double> free_angle = {});

/** Newton's method with damping from `q`, by the smallest motion; limits do not count. Unset: it
did not come within kPoseTolerance. */
std::optional<Eigen::VectorXd> RefinePosture(const Arm& arm, const Pose& X_BF, Eigen::VectorXd q);

/** Nearest its limit, or farthest beyond. */
struct LimitMargin {
  int joint = -1;
  double margin = 0.0;  ///< negative: beyond [rad]
};
LimitMargin FindLimitMargin(const Arm& arm, const Eigen::VectorXd& q);

/** Postures within the limits. */
struct ArmReach {
  std::vector<Eigen::VectorXd> postures;  ///< exact; those farthest from their limits first
  LimitMargin closest = {};  ///< where there is none: of the posture that exceeds them least
  ReachFault fault = {};     ///< where no posture exists whatever the limits
};

/** A free joint is tried at 24 angles, and at 360 where none of these gives a posture. */
ArmReach FindArmReach(const Arm& arm, const Pose& X_BF);

}  // namespace graspbench
