#include "core/trial/measures/object_in_hand.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/trial/trial_trace.h"

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

ContactEvent MakeEvent(double time, ContactEventKind kind, const char* digit, const char* link) {
  ContactEvent event;
  event.time = time;
  event.kind = kind;
  event.digit = digit;
  event.link = link;
  return event;
}

// Of each link of no digit the last event but a slip counts.
TEST(PalmContactTest, CountsWhatTouchesInTheEnd) {
  using Kind = ContactEventKind;
  const std::pair<ContactEvent, bool> course[] = {
      {MakeEvent(0.1, Kind::kTouch, "TH", "thdistal"), false},
      {MakeEvent(0.2, Kind::kTouch, "palm", "palm"), true},
      {MakeEvent(0.3, Kind::kSlip, "palm", "palm"), true},
      {MakeEvent(0.4, Kind::kLost, "palm", "palm"), false},
      {MakeEvent(0.5, Kind::kRegained, "palm", "palm"), true},
      {MakeEvent(0.6, Kind::kTouch, "palm", "wrist"), true},
      {MakeEvent(0.7, Kind::kLost, "palm", "wrist"), true}};
  TrialResult result;
  EXPECT_FALSE(TouchesPalmAtEnd(result));
  for (const auto& [event, touches] : course) {
    result.contact_events.push_back(event);
    EXPECT_EQ(TouchesPalmAtEnd(result), touches) << event.time;
  }
}

Displacement CalcClosingShown(const std::vector<TraceInstant>& trace) {
  ClosingMeter meter;
  for (const TraceInstant& instant : trace) meter.Observe(instant.phase, instant.X_WO);
  return meter.Calc();
}

SceneSnapshot MakeSnapshot(Moment moment, const Pose& X_WH, const Pose& X_WO) {
  SceneSnapshot snapshot;
  snapshot.moment = moment;
  snapshot.X_WH = X_WH;
  snapshot.X_WO = X_WO;
  return snapshot;
}

Pose Turned(const Eigen::Vector3d& p, double angle) {
  Pose X = MakePose(p);
  X.rotate(Eigen::AngleAxisd(angle, Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0));
  return X;
}

/** Pushed by (3, 4, 0) mm and 0.2 rad, then lifted by 100 mm without a slip. */
TrialResult MakeLift() {
  const Pose X_WH = Turned({0.0, 0.01, 0.2}, 0.7);
  const Pose lift = MakePose({0.0, 0.0, 0.1});
  const Pose pushed = Turned({0.003, 0.004, 0.05}, 0.2);
  TrialResult result;
  result.snapshots = {MakeSnapshot(Moment::kPreGrasp, X_WH, Turned({0.0, 0.0, 0.05}, 0.0)),
                      MakeSnapshot(Moment::kClosed, X_WH, pushed),
                      MakeSnapshot(Moment::kLifted, lift * X_WH, lift * pushed)};
  return result;
}

void ExpectDisplacement(const Displacement& found, double shift, double turn) {
  EXPECT_NEAR(found.shift, shift, 1e-12);
  EXPECT_NEAR(found.turn, turn, 1e-12);
}

TEST(Disturbance, IsThatOfTheClosingAndOfTheWholeTrialInTheHand) {
  TrialResult result = MakeLift();
  ExpectDisplacement(CalcDisturbance(result).before_lift, 0.005, 0.2);
  ExpectDisplacement(CalcDisturbance(result).in_hand, 0.005, 0.2);
  // It turns in the hand afterwards.
  result.snapshots[2].X_WO.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0));
  ExpectDisplacement(CalcDisturbance(result).before_lift, 0.005, 0.2);
  ExpectDisplacement(CalcDisturbance(result).in_hand, 0.005, 0.3);
  // A trial that ends before the lift counts to its end, one without closure not at all.
  result.snapshots.erase(result.snapshots.begin() + 1);
  EXPECT_NEAR(CalcDisturbance(result).before_lift.shift, std::sqrt(0.005 * 0.005 + 0.01), 1e-12);
  result.snapshots.erase(result.snapshots.begin());
  EXPECT_TRUE(std::isnan(CalcDisturbance(result).before_lift.shift));
}

TEST(Disturbance, ClosingEndsWithItsPhase) {
  std::vector<TraceInstant> trace;
  for (const Phase phase : {Phase::kPlacing, Phase::kClosure, Phase::kClosure,
                            Phase::kStabilisation, Phase::kLiftOff}) {
    TraceInstant instant;
    instant.phase = phase;
    instant.X_WO = MakePose({0.001 * static_cast<double>(trace.size()), 0.0, 0.0});
    trace.push_back(instant);
  }
  EXPECT_NEAR(CalcClosingShown(trace).shift, 0.001, 1e-15);
  trace.resize(3);  // ended while it closed
  EXPECT_NEAR(CalcClosingShown(trace).shift, 0.001, 1e-15);
  trace.resize(1);
  EXPECT_TRUE(std::isnan(CalcClosingShown(trace).shift));
}

}  // namespace
}  // namespace graspbench
