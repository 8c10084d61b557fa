#include "human_study/events/hand_course.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/pose.h"
#include "core/base/units.h"
#include "tests/human_study/events/trajectories.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr int kNumDigits = 5;
constexpr double kCutoff = 10.0;

/** Where the hand's wrist is while it is transported. */
Vector3d PlaceWrist(double t) { return {0.4 * Ease(t, 0.1, 0.9), 0.05 * t, 0.02}; }

/** @param tip  of digit d at time t, from the wrist. */
ReachTrial MakeReach(const std::function<Vector3d(int d, double t)>& tip) {
  ReachTrial trial;
  trial.times = MakeTimes(0, 1, 200);
  trial.wrist = SamplePath(trial.times, PlaceWrist);
  for (int d = 0; d < kNumDigits; ++d) {
    DigitTrack digit;
    digit.digit = "D" + std::to_string(d);
    digit.is_thumb = d == 0;
    digit.tip =
        SamplePath(trial.times, [&](double t) -> Vector3d { return PlaceWrist(t) + tip(d, t); });
    trial.digits.push_back(digit);
  }
  return trial;
}

/** On a circle in the plane x = 0.1 of the hand. */
Vector3d PlaceOnCircle(int d) {
  const double angle = 2.0 * kPi * d / kNumDigits;
  return {0.1, 0.05 * std::cos(angle), 0.05 * std::sin(angle)};
}

HandCourse Follow(const ReachTrial& trial) {
  FilteredTrial filtered(trial);
  return CalcHandCourse(filtered, kCutoff);
}

TEST(HandCourse, DigitsThatHeadForOnePointMeetThereHoweverTheHandIsTransported) {
  const Vector3d point(0.12, 0.01, -0.01);
  const ReachTrial trial = MakeReach([&](int d, double t) -> Vector3d {
    return point + (1.0 - 0.6 * Ease(t, 0.2, 0.8)) * (PlaceOnCircle(d) - point);
  });
  EXPECT_NEAR(CalcMedianMeeting(Follow(trial), 0.3, 0.7), 0.0, 1e-9);
}

TEST(HandCourse, DigitsThatCloseSideBySideKeepTheirSpacing) {
  const ReachTrial trial = MakeReach([](int d, double t) -> Vector3d {
    return {0.1, 0.02 * (d - 2), -0.05 * Ease(t, 0.2, 0.8)};
  });
  const HandCourse course = Follow(trial);
  EXPECT_NEAR(CalcMedianMeeting(course, 0.3, 0.7), std::sqrt(8.0e-4), 1e-9);
  // The digits rest against the wrist at the end: their ways are noise.
  EXPECT_TRUE(std::isnan(CalcMedianMeeting(course, 0.97, 1.0)));
  EXPECT_TRUE(std::isnan(CalcMedianMeeting(course, 2.0, 3.0)));
}

TEST(HandCourse, WithoutAWristNoCourseIsKnown) {
  ReachTrial trial = MakeReach([](int d, double) { return PlaceOnCircle(d); });
  trial.wrist = Trajectory();
  const HandCourse course = Follow(trial);
  EXPECT_TRUE(std::isnan(CalcMedianMeeting(course, 0.0, 1.0)));
  EXPECT_NEAR(course.plane.At(100), 0.0, 1e-9);
}

TEST(HandCourse, TipsOutOfOnePlaneAreFoundAtEverySample) {
  const ReachTrial trial = MakeReach([](int d, double) -> Vector3d {
    return PlaceOnCircle(d) + Vector3d((d == 0 ? 0.01 : 0.0), 0.0, 0.0);
  });
  // Regression of the heights on the circle's plane: h = 1 at cos = 1, sin = 0 of five places.
  const double left = 1.0 - 1.0 / 5.0 - 1.0 / 2.5;
  const double linear = 0.01 * std::sqrt(left / 5.0);
  const HandCourse course = Follow(trial);
  for (const size_t sample : {20u, 100u, 180u}) {
    EXPECT_NEAR(course.plane.At(sample), linear, 0.03 * linear);
    EXPECT_LE(course.plane.At(sample), linear);
  }
}

TEST(HandCourse, TheAxisTurnsAsTheHandDoesAndSettlesBeforeItStops) {
  const double turn = 0.5;
  const ReachTrial trial = MakeReach([&](int d, double t) -> Vector3d {
    return MakeRotationRpy(turn * Ease(t, 0.2, 0.8), 0.0, 0.0) * PlaceOnCircle(d);
  });
  const HandCourse course = Follow(trial);
  EXPECT_NEAR(CalcAxisTurn(course, 0.0, 1.0), turn, 1e-4);
  double settled = 0.2;
  while (turn * (1.0 - Ease(settled, 0.2, 0.8)) > kSettledAngle) settled += 1e-4;
  EXPECT_NEAR(FindAxisSettling(course, 0.0, 1.0), settled, 0.01);
  EXPECT_DOUBLE_EQ(FindAxisSettling(course, 0.85, 1.0), 0.85);
  EXPECT_TRUE(std::isnan(FindAxisSettling(course, 0.0, 2.0)));
}

TEST(HandCourse, WhereATipIsHiddenNothingIsKnown) {
  ReachTrial trial = MakeReach([](int d, double) { return PlaceOnCircle(d); });
  HideSamples(trial.digits[3].tip, 0.4, 0.6);
  const HandCourse course = Follow(trial);
  EXPECT_FALSE(course.plane.IsValid(100));
  EXPECT_TRUE(std::isnan(CalcAxisTurn(course, 0.0, 0.5)));
  EXPECT_TRUE(std::isnan(FindAxisSettling(course, 0.0, 0.5)));
}

}  // namespace
}  // namespace graspbench
