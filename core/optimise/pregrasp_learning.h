#pragma once
/** @file
Step 1: a pre-grasp from which all digits touch at the same time (Roethling 2007 names the one- and
two-shot learning of the pre-grasp; the rule is proposed by graspbench).

Closing is linear in the commanded angles, q(s) = q_pre + s (q_target - q_pre). A digit is opened by
l along this line beyond its old pre-grasp, and every joint goes no further than its limit:

    q'_pre(l) = clip(q_pre - l (q_target - q_pre)),   l > 0 opens, l < 0 closes

A lesson, one trial without variation, tells by how much the joints of each digit fell short of
their commands when it first touched. With that, geometry tells at which s_i(l) the digit meets the
object at rest (CalcDigitCourse), and every l_i is chosen such that s_i(l_i) = s* for all digits.
Where no joint is at its limit this is the closed form, with q_c the contact angles,

    q'_pre = (q_c - s* q_target) / (1 - s*)

The larger s*, the wider the new pre-grasp, and wide is good: the same error of the object's place
makes GFT a smaller part of GCT. So s* is the largest that every digit can be opened to. But a
finger that opens far can scrape along the table, or topple what it should hold: PreGraspWidth has
three choices to be tried. The opening (opposing pad to the mean of the other pads) must stay 20 mm
above the object's width, or at what the old pre-grasp had if that was less. The width is the one
that matters here: the opening of the posture in which all digits touch.

Cases with a name: a digit that never comes to the object keeps its pre-grasp; one that is at the
object before the closure begins is opened. */

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

/** How far the digits are opened, by the common s*. */
enum class PreGraspWidth {
  kWidest,      ///< the largest s*
  kAboveTable,  ///< the largest with which no digit comes nearer to the table than 0.5 mm, or than
                ///< it came before if that was less
  kHalf,  ///< midway from there to the s of the digit that came first: no digit is opened more
};

struct LearnedPreGrasp {
  Eigen::VectorXd q_pre;               ///< (num_joints) [rad]; the old one if nothing was learned
  std::vector<DigitCase> digit_cases;  ///< of grasp.digits
  bool is_new = false;            ///< false: fewer than two digits come to the object, or no room
  double common_closing = 0.0;    ///< s*
  double opening = 0.0;           ///< of q_pre [m]
  double required_opening = 0.0;  ///< [m]
};

/** s* stays below this, so that the closing keeps a course. */
inline constexpr double kLargestCommonClosing = 0.9;

/** By how much each digit's joints fell short of their commands when it first touched, of
grasp.digits (num_joints each) [rad]; 0 for the joints of other digits, and where it never touched.
@param closings, q  s and joints of the whole hand at the first touches; NaN and empty: never. */
std::vector<Eigen::VectorXd> CalcDeviations(const Hand& hand, const Grasp& grasp,
                                            const std::vector<double>& closings,
                                            const std::vector<Eigen::VectorXd>& q);

/** @param deviations  of grasp.digits.  @pre the grasp brings its placement. */
LearnedPreGrasp LearnPreGrasp(const Hand& hand, const GraspObject& object, const Grasp& grasp,
                              const std::vector<Eigen::VectorXd>& deviations, PreGraspWidth width);

/** Distance from the opposing digit's pad to the mean of the other grasping digits' pads [m]. */
double CalcOpening(const Hand& hand, const Grasp& grasp, const Eigen::VectorXd& q);

/** The way of one digit to the object at rest, by geometry alone.

A trial disturbs what it measures: the digit that comes first pushes the object towards the others,
so it tells when a digit met an object on its way, not when it would have met the object where it
stood. Here the object stands still, and the joints follow the closing law but for a deviation that
does not change on the way: lag, sag and what neighbouring fingers hold back, as a trial showed it
at the digit's first touch. */
struct DigitCourse {
  double touch = kUnset;  ///< the first s at which the digit is at the object; NaN: at none
  double lowest = 0.0;    ///< lowest point of the digit on its way there, above the table [m]
};

/** @param q_pre  the course is q_pre + s (grasp.q_target - q_pre), coupled joints filled in
(num_joints) [rad].
@param deviation  added to it (num_joints) [rad].  @pre the grasp brings its placement. */
DigitCourse CalcDigitCourse(const Hand& hand, const GraspObject& object, const Grasp& grasp,
                            const Digit& digit, const Eigen::VectorXd& q_pre,
                            const Eigen::VectorXd& deviation);

/** Step 1, what no pre-grasp reaches: each digit waits at the start of closure until the others
come. With m_d the median over trials of digit d's first contact and M the largest of them,

    delay_d <- delay_d + gain (M - m_d),   then less the least of them

so that GFT% comes to its floor (contact_timing.h) when the delayed digits meet the object
where they met it before. They need not: what a digit no longer pushes lies elsewhere. So the rule
is used twice, the second time with half the gain, and the better of both is kept. A digit that
never touched keeps its delay. Proposed by graspbench.

The closing schedules of the grasp after `trials` of it; those of its digits that need none are
left out. Its speeds stay. */
std::map<std::string, ClosingSchedule> LearnDelays(const Grasp& grasp,
                                                   const std::vector<LearningTrial>& trials,
                                                   double gain);

/** "TH waits 88 ms, FF 26 ms"; empty where no digit waits. */
std::string DescribeDelays(const Grasp& grasp);

}  // namespace graspbench
