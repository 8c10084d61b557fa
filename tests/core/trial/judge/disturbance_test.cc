#include "core/trial/judge/disturbance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/trial/trial_trace.h"

namespace graspbench {
namespace {

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

TEST(Disturbance, ClosingPushesAndTheLiftAddsNothing) {
  const Disturbance disturbance = CalcDisturbance(MakeLift());
  EXPECT_NEAR(disturbance.before_lift.shift, 0.005, 1e-12);
  EXPECT_NEAR(disturbance.before_lift.turn, 0.2, 1e-12);
  EXPECT_NEAR(disturbance.in_hand.shift, 0.005, 1e-12);
  EXPECT_NEAR(disturbance.in_hand.turn, 0.2, 1e-12);
}

TEST(Disturbance, WhatTurnsInTheHandAfterwardsIsNotOfTheClosing) {
  TrialResult result = MakeLift();
  result.snapshots[2].X_WO.rotate(Eigen::AngleAxisd(0.1, Eigen::Vector3d(1.0, 2.0, 2.0) / 3.0));
  const Disturbance disturbance = CalcDisturbance(result);
  EXPECT_NEAR(disturbance.before_lift.turn, 0.2, 1e-12);
  EXPECT_NEAR(disturbance.in_hand.turn, 0.3, 1e-12);
  EXPECT_NEAR(disturbance.in_hand.shift, 0.005, 1e-12);
}

TEST(Disturbance, ATrialThatEndsBeforeTheLiftCountsToItsEnd) {
  TrialResult result = MakeLift();
  result.snapshots.erase(result.snapshots.begin() + 1);
  EXPECT_NEAR(CalcDisturbance(result).before_lift.shift, std::sqrt(0.005 * 0.005 + 0.01), 1e-12);
}

TEST(Disturbance, WithoutClosureThereIsNone) {
  TrialResult result = MakeLift();
  result.snapshots.erase(result.snapshots.begin());
  EXPECT_TRUE(std::isnan(CalcDisturbance(result).before_lift.shift));
  EXPECT_TRUE(std::isnan(CalcDisturbance(TrialResult()).in_hand.turn));
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
