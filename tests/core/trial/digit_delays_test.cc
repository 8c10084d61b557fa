#include "core/trial/digit_delays.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/grasp/placement.h"
#include "core/trial/trial_trace.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

class DelayedDigit : public ::testing::Test {
 protected:
  TracedTrial Trace(const TrialSetup& setup) { return TraceTrial(runner_, setup, 0.0); }
  TracedTrial TraceLate(double delay) { return Trace(DelayDigit(setup_, digit_, delay)); }

  TrialSetup setup_ = MakeSetup("tum-evolved", "g2", MakeCube(0.0122, 0.5));
  TrialRunner runner_{setup_.hand, setup_.object};
  int digit_ = FindOpposingDigit(*setup_.hand, setup_.grasp);
  double closure_start_ = Trace(setup_).closure_start;
};

TEST_F(DelayedDigit, NoDelayIsTheSameTrialToTheByte) {
  EXPECT_EQ(ToJson(TraceLate(0.0).result), ToJson(Trace(setup_).result));
}

// With nothing between the fingers the other digits do as ever and this one follows later.
TEST_F(DelayedDigit, OnlyThisDigitIsAskedLater) {
  const int num_steps = 25;
  const TracedTrial before = Trace(setup_);
  const TracedTrial after = TraceLate(num_steps * setup_.sim.step);
  const Hand& hand = *setup_.hand;
  for (size_t i = 1; i + num_steps < std::min(before.trace.size(), after.trace.size()); ++i) {
    if (after.trace[i + num_steps].phase > Phase::kStabilisation) break;
    for (size_t digit = 0; digit < hand.digits.size(); ++digit) {
      const bool is_late = static_cast<int>(digit) == digit_;
      if (is_late && before.trace[i].time < closure_start_) continue;
      for (const int joint : FindDrivenJoints(hand, hand.digits[digit])) {
        EXPECT_NEAR(after.trace[is_late ? i + num_steps : i].q_asked[joint],
                    before.trace[i].q_asked[joint], 1e-12)
            << hand.joints[static_cast<size_t>(joint)].name << " at " << before.trace[i].time;
      }
    }
  }
}

/** What the digits do with that closing: of each how long after the first it touched [s]. */
std::map<std::string, double> FindLags(TrialRunner& runner, TrialSetup setup,
                                       const std::map<std::string, ClosingSchedule>& closing) {
  setup.grasp.closing = closing;
  std::map<std::string, double> lags;
  double first = HUGE_VAL;
  for (const DigitContact& contact : runner.Run(setup).contacts) {
    lags[contact.digit] = contact.time;
    first = std::min(first, contact.time);
  }
  for (auto& [digit, lag] : lags) lag -= first;
  return lags;
}

// Whatever the order in which the digits would touch by themselves.
TEST(ContactLags, DigitsTouchInTheOrderAndAtTheTimesAskedFor) {
  const TrialSetup setup = MakeSetup("tum", "g1", MakeCube(0.05, 0.9));
  ASSERT_EQ(setup.grasp.digits.size(), 3u);
  TrialRunner runner(setup.hand, setup.object);
  std::vector<std::string> digits = setup.grasp.digits;
  std::sort(digits.begin(), digits.end());
  do {
    const std::map<std::string, double> asked = {
        {digits[0], 0.0}, {digits[1], 0.04}, {digits[2], 0.1}};
    const LaggedClosing found = FitContactLags(runner, setup, asked);
    ASSERT_TRUE(found.untouching.empty()) << found.untouching;
    EXPECT_LE(found.largest_error, 2.0 * setup.sim.step);
    for (const auto& [digit, lag] : FindLags(runner, setup, found.closing)) {
      EXPECT_NEAR(lag, asked.at(digit), found.largest_error + 1e-9) << digit;
    }
    for (const auto& [digit, schedule] : found.closing) EXPECT_GT(schedule.delay, 0.0) << digit;
    EXPECT_LT(found.closing.size(), digits.size()) << "one digit begins with the closure";
  } while (std::next_permutation(digits.begin(), digits.end()));
}

TEST(ContactLags, AGraspWhoseDigitsDoNotAllTouchSaysWhich) {
  TrialSetup setup = MakeSetup("tum", "g1", MakeCube(0.05, 0.9));
  setup.draw.offset_x = 0.5;  // far beside the hand
  TrialRunner runner(setup.hand, setup.object);
  std::map<std::string, double> lags;
  for (const std::string& digit : setup.grasp.digits) lags[digit] = 0.0;
  const LaggedClosing found = FitContactLags(runner, setup, lags);
  EXPECT_TRUE(std::isnan(found.largest_error));
  EXPECT_EQ(lags.count(found.untouching), 1u) << found.untouching;
  EXPECT_TRUE(found.closing.empty());
}

}  // namespace
}  // namespace graspbench
