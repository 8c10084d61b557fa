#include "core/trial/delayed_digit.h"

#include <gtest/gtest.h>

#include "core/grasp/placement.h"
#include "core/trial/judge/disturbance.h"
#include "core/trial/trial_trace.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

Displacement CalcClosingLate(const std::vector<TraceInstant>& trace) {
  ClosingMeter meter;
  for (const TraceInstant& instant : trace) meter.Observe(instant.phase, instant.X_WO);
  return meter.Calc();
}

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

// Two jaws and a free cube: the first alone pushes it for as long as the other is late, at its own
// speed.
TEST_F(DelayedDigit, TheOtherDigitPushesTheObjectMeanwhile) {
  const double early = CalcClosingLate(TraceLate(0.1).trace).shift;
  const double late = CalcClosingLate(TraceLate(0.3).trace).shift;
  const Hand& hand = *setup_.hand;
  const auto find_pad = [&](double s) {
    const Digit& digit = hand.digits[digit_ == 0 ? 1 : 0];
    const std::vector<Pose> X_HL = CalcLinkPoses(hand, CalcClosingPosture(hand, setup_.grasp, s));
    return Eigen::Vector3d(X_HL[static_cast<size_t>(digit.distal_link)] * digit.p_LPad);
  };
  const double way = (find_pad(0.8) - find_pad(0.6)).norm();  // in 0.2 s
  EXPECT_GT(late - early, 0.2 * way);  // the pad yields, and moves up and down, too
  EXPECT_LT(late - early, way);
}

}  // namespace
}  // namespace graspbench
