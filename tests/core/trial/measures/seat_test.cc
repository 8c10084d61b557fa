#include "core/trial/measures/seat.h"

#include <gtest/gtest.h>

#include <cmath>

namespace graspbench {
namespace {

TrialResult MakeHeldResult(double weight, double force) {
  TrialResult result;
  result.outcome = Outcome::kSuccess;
  result.weight = weight;
  result.stability.hold.normal_force = force;
  return result;
}

TrialResult MakeClosedResult(double rise, double height, double slide) {
  TrialResult result;
  result.closure_rise = rise;
  result.object_height = height;
  result.closure_slide = slide;
  return result;
}

HandContact MakeContact(int link, double slip_speed) {
  HandContact contact;
  contact.link = link;
  contact.slip_speed = slip_speed;
  return contact;
}

TEST(Seat, WhatWasSqueezedUpByHalfOfItsHeightIsReseated) {
  EXPECT_EQ(FindSeat(MakeClosedResult(0.0250, 0.0427, 0.009)), Seat::kReseated);
  EXPECT_EQ(FindSeat(MakeClosedResult(0.0063, 0.0427, 0.009)), Seat::kKept);
  EXPECT_EQ(FindSeat(MakeClosedResult(-0.025, 0.0427, 0.009)), Seat::kKept);
  // Carried by the digits.
  EXPECT_EQ(FindSeat(MakeClosedResult(0.0230, 0.0260, 0.0005)), Seat::kKept);
  // A pencil that turned.
  EXPECT_EQ(FindSeat(MakeClosedResult(0.0045, 0.0070, 0.009)), Seat::kKept);
}

TEST(Seat, ATrialThatWasNeverLiftedOrIsOlderHasNone) {
  EXPECT_EQ(FindSeat(MakeClosedResult(kUnset, 0.04, kUnset)), Seat::kUnknown);
  EXPECT_EQ(FindSeat(MakeClosedResult(0.03, 0.04, kUnset)), Seat::kUnknown);
  EXPECT_EQ(FindSeat(MakeClosedResult(0.03, kUnset, 0.01)), Seat::kUnknown);
  EXPECT_STREQ(NameOf(FindSeat(TrialResult())), "");
  EXPECT_FALSE(IsCaged(MakeHeldResult(kUnset, 0.1)));
}

TEST(SeatMeter, SlideIsWhatNoTouchingLinkHolds) {
  SeatMeter meter;
  meter.Begin({Pose::Identity(), 0.0});
  meter.Observe({}, 0.01);
  meter.Observe({MakeContact(1, 0.5), MakeContact(1, 0.4)}, 0.01);  // pushed by one link
  meter.Observe({MakeContact(1, 0.5), MakeContact(2, 0.0)}, 0.01);  // carried by a link
  meter.Observe({MakeContact(1, 0.5), MakeContact(2, 0.3), MakeContact(2, 0.4)}, 0.01);
  TrialResult result;
  meter.End({Pose::Identity(), 0.0}, result);
  EXPECT_NEAR(result.closure_slide, 0.003, 1e-15);
}

TEST(SeatMeter, RiseIsVerticalAndDisplacementThePalmFrames) {
  const Pose X_PalmOcm = MakePose(Eigen::Vector3d(0.01, 0.02, 0.03));
  const Pose X_PalmOcm_later = MakePose(Eigen::Vector3d(0.04, 0.02, 0.07));
  SeatMeter meter;
  TrialResult result;
  meter.End({X_PalmOcm_later, -0.05}, result);
  EXPECT_TRUE(std::isnan(result.closure_rise));  // it was never touched
  EXPECT_TRUE(std::isnan(result.closure_slide));
  EXPECT_FALSE(meter.has_begun());
  meter.Begin({X_PalmOcm, -0.08});
  EXPECT_TRUE(meter.has_begun());
  meter.End({X_PalmOcm_later, -0.05}, result);
  EXPECT_NEAR(result.closure_rise, 0.03, 1e-15);
  EXPECT_NEAR(result.closure_displacement, 0.05, 1e-15);
  EXPECT_EQ(result.closure_slide, 0.0);
}

// The lesser of 1.5 N and five weights.
TEST(Seat, ASuccessThatHardlyPressesIsCaged) {
  EXPECT_TRUE(IsCaged(MakeHeldResult(1.0, 1.49)));
  EXPECT_FALSE(IsCaged(MakeHeldResult(1.0, 1.51)));
  EXPECT_TRUE(IsCaged(MakeHeldResult(0.1, 0.49)));
  EXPECT_FALSE(IsCaged(MakeHeldResult(0.1, 0.51)));
  TrialResult dropped = MakeHeldResult(1.0, 0.1);
  dropped.outcome = Outcome::kDroppedWhileHolding;
  EXPECT_FALSE(IsCaged(dropped));
  EXPECT_FALSE(IsCaged(MakeHeldResult(1.0, kUnset)));
}

}  // namespace
}  // namespace graspbench
