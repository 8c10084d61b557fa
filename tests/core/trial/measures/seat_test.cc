#include "core/trial/measures/seat.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TrialResult MakeHeldResult(double rise, double weight, double force) {
  TrialResult result;
  result.outcome = Outcome::kSuccess;
  result.closure_rise = rise;
  result.weight = weight;
  result.stability.hold.normal_force = force;
  return result;
}

TEST(Seat, WhatRoseWhileTheHandClosedIsReseated) {
  EXPECT_EQ(FindSeat(MakeHeldResult(0.0049, 1.0, 9.0)), Seat::kKept);
  EXPECT_EQ(FindSeat(MakeHeldResult(0.0051, 1.0, 9.0)), Seat::kReseated);
  EXPECT_EQ(FindSeat(MakeHeldResult(-0.02, 1.0, 9.0)), Seat::kKept);
}

TEST(Seat, ATrialThatWasNeverLiftedOrIsOlderHasNone) {
  const TrialResult result;
  EXPECT_EQ(FindSeat(result), Seat::kUnknown);
  EXPECT_STREQ(NameOf(FindSeat(result)), "");
  EXPECT_FALSE(IsCaged(MakeHeldResult(0.0, kUnset, 0.1)));
}

// The lesser of 1.5 N and five weights.
TEST(Seat, ASuccessThatHardlyPressesIsCaged) {
  EXPECT_TRUE(IsCaged(MakeHeldResult(0.0, 1.0, 1.49)));
  EXPECT_FALSE(IsCaged(MakeHeldResult(0.0, 1.0, 1.51)));
  EXPECT_TRUE(IsCaged(MakeHeldResult(0.0, 0.1, 0.49)));
  EXPECT_FALSE(IsCaged(MakeHeldResult(0.0, 0.1, 0.51)));
  TrialResult dropped = MakeHeldResult(0.0, 1.0, 0.1);
  dropped.outcome = Outcome::kDroppedWhileHolding;
  EXPECT_FALSE(IsCaged(dropped));
  EXPECT_FALSE(IsCaged(MakeHeldResult(0.0, 1.0, kUnset)));
}

}  // namespace
}  // namespace graspbench
