#pragma once
/** @file
Step 1: a pre-grasp from which all digits touch at the same time (Roethling 2007 names the one- and
two-shot learning of the pre-grasp; the rule is proposed by graspbench).

Closing is linear in the commanded angles, q(s) = q_pre + s (q_target - q_pre). A trial tells at
which s_i digit i touched first, so q_c = q(s_i). From

    q'_pre = (q_c - s* q_target) / (1 - s*)

the new command passes q_c at the common s*, for every digit. The larger s*, the wider the new
opening; s* is the largest for which every joint stays within its limits. Of the change so found as
much is taken as leaves the opening (opposing pad to the mean of the other pads) 20 mm above the
object's width, or at what the old pre-grasp had if that was less. The width is the one that matters
here: the opening of the posture in which all digits touch.

Cases with a name: a digit that never touched keeps its pre-grasp; one that touched before the
closure began is opened as far as its limits allow and does not bind s*.

q_c is the commanded posture, not the measured one: the drives lag behind their command by the same
time in every joint, so equal commands give equal times. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"

namespace graspbench {

enum class DigitCase { kLearned, kNeverTouched, kTouchedAtOnce };
const char* NameOf(DigitCase digit_case);  ///< "learned", "never touched", "touched at once"

struct LearnedPreGrasp {
  Eigen::VectorXd q_pre;               ///< (num_joints) [rad]
  std::vector<DigitCase> digit_cases;  ///< of grasp.digits
  double common_closing = 0.0;         ///< s*
  double opening = 0.0;                ///< of q_pre [m]
  double required_opening = 0.0;       ///< [m]
  double share = 0.0;  ///< of the change that was taken; 0: nothing to learn, 1: all of it
};

/** s* stays below this, so that the closing keeps a course. */
inline constexpr double kLargestCommonClosing = 0.9;

/** @param closings  s_i of grasp.digits; NaN: never touched, <= 0: before the closure. Fewer than
two digits that touched in the closure: nothing is learned. */
LearnedPreGrasp LearnPreGrasp(const Hand& hand, const StandardGrasp& grasp,
                              const std::vector<double>& closings);

/** Distance from the opposing digit's pad to the mean of the other grasping digits' pads [m]. */
double CalcOpening(const Hand& hand, const StandardGrasp& grasp, const Eigen::VectorXd& q);

}  // namespace graspbench
