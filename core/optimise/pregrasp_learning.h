#pragma once
/** @file
Step 1: a pre-grasp from which all digits touch at the same time. Roethling 2007 names the one- and
two-shot learning of the pre-grasp; the rule is proposed by graspbench.

Closing is linear in the commanded angles, q(s) = q_pre + s (q_target - q_pre). A digit is opened by
l along this line beyond its old pre-grasp, with every joint clipped to its limits:

    q'_pre(l) = clip(q_pre - l (q_target - q_pre)),   l > 0 opens, l < 0 closes

A lesson is one trial without variation. It shows by how much the joints of each digit fell short of
their commands at its first touch. From that, geometry predicts at which s_i(l) the digit meets the
object at rest (CalcDigitCourse), and every l_i is chosen such that s_i(l_i) = s* for all digits. If
no joint is at its limit this has the closed form, with q_c the contact angles,

    q'_pre = (q_c - s* q_target) / (1 - s*)

The larger s*, the wider the new pre-grasp. A wide one is favourable, since the same error of the
object's position makes GFT a smaller part of GCT. So s* is the largest to which every digit can be
opened. A finger that opens far may scrape along the table, or topple the object, so PreGraspWidth
offers three choices. The opening (opposing pad to the mean of the other pads) must exceed the
object's width by 20 mm, or be at least that of the old pre-grasp if that is less. The width is the
opening of the posture in which all digits touch.

Special cases: a digit that never reaches the object keeps its pre-grasp; one that is at the object
before the closure begins is opened. */

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "core/base/enum_table.h"
#include "core/base/units.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/optimise/learning_trial.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

enum class DigitCase { kLearned, kNeverTouched, kTouchedAtOnce };
struct DigitCaseRow {
  DigitCase value;
  const char* name;
};
inline constexpr DigitCaseRow kDigitCases[] = {{DigitCase::kLearned, "learned"},
                                               {DigitCase::kNeverTouched, "never touched"},
                                               {DigitCase::kTouchedAtOnce, "touched at once"}};
inline const char* NameOf(DigitCase digit_case) { return RowOf(kDigitCases, digit_case).name; }

/** Width of the opening, by the common s*. */
enum class PreGraspWidth {
  kWidest,      ///< the largest s*
  kAboveTable,  ///< the largest s* with which no digit comes nearer to the table than 0.5 mm, or
                ///< than before if that was less
  kHalf,  ///< midway between that and the s of the digit that came first, which then opens least
};

struct LearnedPreGrasp {
  Eigen::VectorXd q_pre;               ///< (num_joints) [rad]; the old one if nothing was learned
  std::vector<DigitCase> digit_cases;  ///< by digit of grasp.digits
  bool is_new = false;            ///< false: fewer than two digits reach the object, or no room
  double common_closing = 0.0;    ///< s*
  double opening = 0.0;           ///< opening of q_pre [m]
  double required_opening = 0.0;  ///< [m]
};

/** Upper bound of s*, so that part of the closing motion remains. */
inline constexpr double kLargestCommonClosing = 0.9;

/** Shortfall of each digit's joints from their commands at its first touch, by digit of
grasp.digits (num_joints each) [rad]; 0 for the joints of other digits, and for a digit that never
touched.
@param closings, q  s and joints of the hand at the first touches; NaN and empty: never. */
std::vector<Eigen::VectorXd> CalcDeviations(const Hand& hand, const Grasp& grasp,
                                            const std::vector<double>& closings,
                                            const std::vector<Eigen::VectorXd>& q);

/** @param deviations  by digit of grasp.digits.  @pre the grasp has a placement. */
LearnedPreGrasp LearnPreGrasp(const Hand& hand, const GraspObject& object, const Grasp& grasp,
                              const std::vector<Eigen::VectorXd>& deviations, PreGraspWidth width);

/** Distance from the opposing digit's pad to the mean of the other grasping digits' pads [m]. */
double CalcOpening(const Hand& hand, const Grasp& grasp, const Eigen::VectorXd& q);

/** Path of one digit to the object at rest, by geometry alone.

A trial disturbs what it measures: the digit that comes first pushes the object towards the others.
It shows when a digit met the moving object, not when it would have met the object at rest. Here the
object does not move, and the joints follow the closing law except for a constant deviation. This
deviation is due to lag, sag and obstruction by neighbouring fingers, as measured in a trial at the
digit's first touch. */
struct DigitCourse {
  double touch = kUnset;  ///< first s at which the digit is at the object; NaN: none
  double lowest = 0.0;    ///< lowest point of the digit on the path, above the table [m]
};

/** @param q_pre  start of the path q_pre + s (grasp.q_target - q_pre), coupled joints filled in
(num_joints) [rad].
@param deviation  added to the path (num_joints) [rad].  @pre the grasp has a placement. */
DigitCourse CalcDigitCourse(const Hand& hand, const GraspObject& object, const Grasp& grasp,
                            const Digit& digit, const Eigen::VectorXd& q_pre,
                            const Eigen::VectorXd& deviation);

/** Step 1, differences that no pre-grasp can remove: each digit waits at the start of closure until
the others arrive. With m_d the median over trials of digit d's first contact and M the largest m_d,

    delay_d <- delay_d + gain (M - m_d),   then less the least of them

so that GFT% approaches its floor (contact_timing.h) if the delayed digits meet the object where
they met it before. They may not, since the object rests elsewhere once a digit no longer pushes it.
The rule is therefore applied twice, the second time with half the gain, and the better result is
kept. A digit that never touched keeps its delay. Proposed by graspbench.

Returns the closing schedules of the grasp after `trials` of it, without digits that need none. Its
speeds stay unchanged. */
std::map<std::string, ClosingSchedule> LearnDelays(const Grasp& grasp,
                                                   const std::vector<LearningTrial>& trials,
                                                   double gain);

/** Formats the delays: "TH waits 88 ms, FF 26 ms"; empty if no digit waits. */
std::string DescribeDelays(const Grasp& grasp);

}  // namespace graspbench
