#include "core/trial/grip/grip_regulator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/trial/trial_trace.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

TrialSetup MakeRegulated(const char* hand, const char* grasp, const char* grip, double force,
                         double mass = 0.0122, double mu = 0.5) {
  TrialSetup setup = MakeSetup(hand, grasp, MakeCube(mass, mu));
  setup.strategy.grip = grip;
  setup.strategy.grip_force = force;
  setup.strategy.touch_speed = 0.25;
  return setup;
}
// Two digits on a cube: what one presses with the other does, too, and both what was asked.
TEST(GripRegulator, TwoDigitsHoldTheForceThatWasAsked) {
  for (const double force : {0.4, 1.0, 2.5}) {
    const TrialResult result = RunSetup(MakeRegulated("tum", "g2", "force", force));
    ASSERT_EQ(result.outcome, Outcome::kSuccess) << force << ": " << result.reason;
    ASSERT_TRUE(result.grip);
    EXPECT_NEAR(result.grip->asked, 2.0 * force, 0.05 * force);
    EXPECT_NEAR(result.grip->held, 2.0 * force, 0.2 * force);
    // By the physics' own account, too, not by the regulator's.
    EXPECT_NEAR(result.stability.hold.normal_force, 2.0 * force, 0.2 * force);
    EXPECT_LE(result.grip->peak, 2.4 * force + 0.2);
    EXPECT_TRUE(result.grip->was_in_band);
    for (const DigitGripRecord& digit : result.grip->digits) {
      EXPECT_NEAR(digit.held, force, 0.2 * force) << digit.digit;
      EXPECT_EQ(digit.fault, GripFault::kNone);
    }
  }
}

// No two sides do with less than m g / (2 mu). These two press at places 8.7 mm apart sideways on a
// cube of 31 mm: friction has that couple to bear, too; pyramids add at most 8.2 %.
TEST(GripRegulator, AMarginIsAMultipleOfWhatStaticsAsk) {
  TrialSetup setup = MakeRegulated("tum-evolved", "g2", "margin", 0.0, 0.05, 0.5);
  setup.strategy.grip_margin = 2.0;
  const TrialResult result = RunSetup(setup);
  ASSERT_EQ(result.outcome, Outcome::kSuccess) << result.reason;
  const double smallest = 0.05 * setup.sim.gravity / (2.0 * 0.5);
  EXPECT_GE(result.grip->smallest, smallest);
  const double sideways = 0.0087 / 0.031;
  EXPECT_LE(result.grip->smallest,
            1.082 * smallest * 0.5 / std::sqrt(0.5 * 0.5 - sideways * sideways));
  EXPECT_NEAR(result.grip->force, 2.0 * result.grip->smallest, 1e-12);
  EXPECT_NEAR(result.grip->told_weight, 0.05 * setup.sim.gravity, 1e-12);
  EXPECT_NEAR(result.grip->told_friction, 0.5, 1e-12);
}

TEST(GripRegulator, MoreThanThePostureGivesIsNamed) {
  // Rough, so that it is not squeezed out before the drives give all they can.
  const TrialResult result = RunSetup(MakeRegulated("tum", "g2", "force", 200.0, 0.0122, 1.2));
  ASSERT_TRUE(result.grip);
  EXPECT_FALSE(result.grip->was_in_band);
  for (const DigitGripRecord& digit : result.grip->digits) {
    EXPECT_LT(digit.closed, 200.0);
    EXPECT_TRUE(digit.fault == GripFault::kPosture || digit.fault == GripFault::kLimit)
        << NameOf(digit.fault);
    EXPECT_LE(digit.closing, 3.0);
    EXPECT_EQ(digit.joint.has_value(), digit.fault == GripFault::kLimit) << "the drive is named";
  }
}

// A weak thumb against a finger that stands at its stops just where it touches: the one is at its
// drive's limit, the other's drive could give more, but its stop takes it.
TEST(GripRegulator, AStopIsNoLimitOfADrive) {
  TrialSetup setup = MakeRegulated("tum", "g2", "force", 60.0, 0.0122, 1.2);
  const TrialResult free = RunSetup(setup);
  ASSERT_EQ(free.touches.size(), 2u);
  Hand hand = *setup.hand;
  const int opposing = FindOpposingDigit(hand, setup.grasp);
  std::string stopped, weak;
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    const Digit& digit = hand.digits[d];
    const auto& ids = setup.grasp.digits;
    const auto place = std::find(ids.begin(), ids.end(), digit.id);
    if (place == ids.end()) continue;
    const bool is_thumb = static_cast<int>(d) == opposing;
    (is_thumb ? weak : stopped) = digit.id;
    for (const int joint : FindDrivenJoints(hand, digit)) {
      HandJoint& one = hand.joints[static_cast<size_t>(joint)];
      const double q = free.touches[static_cast<size_t>(place - ids.begin())].q[joint];
      if (is_thumb) {
        one.drive.torque_limit *= 0.2;
      } else if (setup.grasp.q_target[joint] > setup.grasp.q_pre[joint]) {
        one.upper = q;
      } else if (setup.grasp.q_target[joint] < setup.grasp.q_pre[joint]) {
        one.lower = q;
      }
    }
  }
  setup.hand = std::make_shared<Hand>(hand);
  const TrialResult result = RunSetup(setup);
  ASSERT_TRUE(result.grip);
  for (const DigitGripRecord& digit : result.grip->digits) {
    EXPECT_EQ(digit.fault, digit.digit == weak ? GripFault::kLimit : GripFault::kStop)
        << digit.digit << " " << NameOf(digit.fault);
    ASSERT_TRUE(digit.joint) << digit.digit;
    EXPECT_GE(hand.FindJoint(*digit.joint), 0) << *digit.joint;
  }
}

// A power grasp holds by enclosing: no digit goes beyond its target posture, whatever is asked, and
// that is what a missing force is put down to. A precision grasp does.
TEST(GripRegulator, APowerGraspEndsInItsTargetPosture) {
  for (const char* grasp : {"g3", "g2"}) {
    const TrialResult result =
        RunSetup(MakeRegulated("tum-evolved", grasp, "force", 60.0, 0.0122, 1.2));
    ASSERT_TRUE(result.grip) << grasp;
    double most = 0.0;
    for (const DigitGripRecord& digit : result.grip->digits) most = std::max(most, digit.closing);
    if (std::string(grasp) == "g3") {
      EXPECT_LE(most, 1.0);
      const auto& digits = result.grip->digits;
      EXPECT_TRUE(std::any_of(digits.begin(), digits.end(), [](const DigitGripRecord& digit) {
        return digit.fault == GripFault::kPosture;
      }));
    } else {
      EXPECT_GT(most, 1.0);
    }
  }
}

// What touches beside the digits is asked for its share, too: the sums add up.
TEST(GripRegulator, TheRestOfTheHandHasItsShare) {
  const TrialResult result = RunSetup(MakeRegulated("tum-evolved", "g3", "force", 3.0, 0.05, 0.8));
  ASSERT_TRUE(result.grip);
  const GripRecord& grip = *result.grip;
  double asked = std::isnan(grip.rest_asked) ? 0.0 : grip.rest_asked;
  double held = std::isnan(grip.rest_held) ? 0.0 : grip.rest_held;
  for (const DigitGripRecord& digit : grip.digits) {
    asked += digit.asked;
    held += digit.held;
  }
  EXPECT_NEAR(asked, grip.asked, 1e-9 * grip.asked);
  EXPECT_NEAR(held, grip.held, 1e-9 * grip.held);
}

// The command never moves to and fro while it holds: that would be chatter.
TEST(GripRegulator, HoldsWithoutChatter) {
  const TrialSetup setup = MakeRegulated("tum", "g2", "force", 0.7);
  TrialRunner runner(setup.hand, setup.object);
  const TracedTrial traced = TraceTrial(runner, setup, 0.0);
  int num_turns = 0;
  double last_move = 0.0;
  const TraceInstant* before = nullptr;
  for (const TraceInstant& instant : traced.trace) {
    if (instant.phase != Phase::kHold) continue;
    if (before) {
      const double move = (instant.q_asked - before->q_asked).sum();
      if (move * last_move < 0.0) ++num_turns;
      if (move != 0.0) last_move = move;
    }
    before = &instant;
  }
  EXPECT_LE(num_turns, 10);  // of 1000 steps
}

// Two digits beside each other, against a thumb: each has its own force, and the thumb what they sum
// to.
TEST(GripRegulator, TwoDigitsOfASideShareEvenly) {
  const TrialResult result = RunSetup(MakeRegulated("tum", "g1", "force", 1.5, 0.05));
  ASSERT_EQ(result.outcome, Outcome::kSuccess) << result.reason;
  ASSERT_EQ(result.grip->digits.size(), 3U);
  for (const DigitGripRecord& digit : result.grip->digits) {
    EXPECT_NEAR(digit.held, digit.opposes ? 3.0 : 1.5, 0.3) << digit.digit;
  }
}

// Drives at a pressure: the same forces, with limits of torque instead of positions.
TEST(GripRegulator, SaturatingDrivesGiveTheForceWithoutPosition) {
  TrialSetup setup = MakeRegulated("tum", "g2", "force", 1.0);
  setup.strategy.drive_law = "saturating";
  const TrialResult result = RunSetup(setup);
  ASSERT_TRUE(result.grip);
  EXPECT_NEAR(result.grip->closed, result.grip->asked, 0.2 * result.grip->asked);
}

// Below what statics ask nothing may hold it.
TEST(GripRegulator, TooLittleForceDoesNotHold) {
  const TrialSetup setup = MakeRegulated("tum", "g2", "force", 0.2, 0.1, 0.5);
  ASSERT_LT(2.0 * 0.5 * 0.2, 0.1 * setup.sim.gravity);
  EXPECT_NE(RunSetup(setup).outcome, Outcome::kSuccess);
}

}  // namespace
}  // namespace graspbench
