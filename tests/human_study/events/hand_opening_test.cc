#include "human_study/events/hand_opening.h"

#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/units.h"
#include "tests/human_study/events/trajectories.h"

namespace graspbench {
namespace {

using Eigen::Matrix3Xd;
using Eigen::Vector3d;

Matrix3Xd MakePolygon(int count, double radius) {
  Matrix3Xd tips(3, count);
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * kPi * i / count;
    tips.col(i) = Vector3d(radius * std::cos(angle), 0.1, radius * std::sin(angle));
  }
  return tips;
}

double Calc(const std::string& id, const Matrix3Xd& tips) { return FindHandOpening(id).calc(tips); }

TEST(HandOpening, ARegularPentagonHasItsClosedForms) {
  const double r = 0.05;
  const Matrix3Xd tips = MakePolygon(5, r);
  const double side = 2 * r * std::sin(kPi / 5), diagonal = 2 * r * std::sin(2 * kPi / 5);
  EXPECT_NEAR(Calc("aperture", tips), side, 1e-15);
  EXPECT_NEAR(Calc("virtual_finger", tips), 1.25 * r, 1e-15);  // the others' mean is -r/4 away
  EXPECT_NEAR(Calc("thumb_finger", tips), (side + diagonal) / 2, 1e-15);
  EXPECT_NEAR(Calc("rms_radius", tips), r, 1e-15);
  EXPECT_NEAR(Calc("centroid_sum", tips), 5 * r, 1e-15);
  EXPECT_NEAR(Calc("fan", tips), std::sqrt(2.5 * r * r * std::sin(2 * kPi / 5)), 1e-15);
  EXPECT_NEAR(Calc("perimeter", tips), 5 * side, 1e-15);
  const double height = std::sqrt(diagonal * diagonal - side * side / 4);
  EXPECT_NEAR(Calc("outer_triangle", tips), std::sqrt(side * side * std::sin(3 * kPi / 5) / 2),
              1e-15);
  EXPECT_GT(height, side);
}

TEST(HandOpening, TwoDigitsMakeTheDistancesEqual) {
  const Matrix3Xd tips = MakePolygon(2, 0.03);
  for (const char* id : {"aperture", "virtual_finger", "thumb_finger", "centroid_sum"}) {
    EXPECT_NEAR(Calc(id, tips), 0.06, 1e-15) << id;
  }
}

TEST(HandOpening, AllAreLengthsThatAMotionOfTheHandDoesNotChange) {
  Matrix3Xd tips = MakePolygon(5, 0.04);
  tips(0, 2) += 0.01;
  tips(1, 3) -= 0.02;
  const Pose X = MakePose(MakeRotationRpy(0.3, 1.1, -2.0), Vector3d(1, 2, 3));
  Matrix3Xd moved(3, 5);
  for (int i = 0; i < 5; ++i) moved.col(i) = X * tips.col(i);
  for (const HandOpening& opening : HandOpeningList()) {
    EXPECT_NEAR(opening.calc(moved), opening.calc(tips), 1e-12) << opening.id;
    EXPECT_NEAR(opening.calc(1000.0 * tips), 1000.0 * opening.calc(tips), 1e-9) << opening.id;
  }
}

/** The hull by brute force: three tips are a face when the others lie on one side of their plane. */
double CalcHullVolume(const Matrix3Xd& tips) {
  const Vector3d inside = tips.rowwise().mean();
  double volume = 0.0;
  for (Eigen::Index a = 0; a < tips.cols(); ++a) {
    for (Eigen::Index b = a + 1; b < tips.cols(); ++b) {
      for (Eigen::Index c = b + 1; c < tips.cols(); ++c) {
        const Vector3d normal =
            (tips.col(b) - tips.col(a)).cross(Vector3d(tips.col(c) - tips.col(a)));
        int num_above = 0, num_below = 0;
        for (Eigen::Index i = 0; i < tips.cols(); ++i) {
          if (i == a || i == b || i == c) continue;
          (normal.dot(tips.col(i) - tips.col(a)) > 0 ? num_above : num_below)++;
        }
        if (num_above > 0 && num_below > 0) continue;
        volume += std::abs(normal.dot(inside - tips.col(a))) / 6;
      }
    }
  }
  return volume;
}

TEST(HandOpening, TheHullIsThatOfAllFacesAlsoWithATipInside) {
  RandomStream random("hull", "test");
  int num_inside = 0;
  for (int round = 0; round < 500; ++round) {
    Matrix3Xd tips(3, round % 2 == 0 ? 5 : 4);
    for (double& value : tips.reshaped()) value = 0.1 * random.NextUnit();
    if (round % 4 == 0) {
      tips.col(4) = tips.leftCols(4).rowwise().mean();
      ++num_inside;
    }
    EXPECT_NEAR(std::pow(Calc("hull", tips), 3), CalcHullVolume(tips), 1e-15);
  }
  EXPECT_EQ(num_inside, 125);
  EXPECT_NEAR(Calc("hull", MakePolygon(5, 0.04)), 0.0, 1e-6);  // flat
}

ReachTrial MakeTrial(int num_digits) {
  ReachTrial trial;
  trial.times = MakeTimes(0, 1, 100);
  for (int d = 0; d < num_digits; ++d) {
    DigitTrack digit;
    digit.digit = "D" + std::to_string(d);
    digit.is_thumb = d == 0;
    digit.tip = SamplePath(trial.times, [d](double t) { return Vector3d(d * 0.02, t, 0); });
    trial.digits.push_back(digit);
  }
  return trial;
}

TEST(OpeningCurve, ASampleWithoutOneDigitIsMissingAndOneWithAFilledDigitSaysSo) {
  ReachTrial trial = MakeTrial(3);
  HideSamples(trial.digits[1].tip, 0.295, 0.405);
  trial.digits[2].tip.states[80] = SampleState::kFilled;
  FilteredTrial filtered(trial);
  const ScalarCurve curve = CalcOpeningCurve(filtered, FindHandOpening("virtual_finger"), 10.0);
  EXPECT_FALSE(curve.IsValid(35));
  EXPECT_TRUE(std::isnan(curve.values[35]));
  EXPECT_EQ(curve.states[80], SampleState::kFilled);
  EXPECT_NEAR(curve.values[10], 0.03, 1e-9);
  const ScalarCurve without =
      CalcOpeningCurve(filtered, FindHandOpening("virtual_finger"), 10.0, "D1");
  EXPECT_NEAR(without.values[35], 0.04, 1e-9);
}

TEST(OpeningCurve, AFanNeedsThreeDigitsAndAHullFour) {
  const ReachTrial two = MakeTrial(2), four = MakeTrial(4);
  FilteredTrial of_two(two), of_four(four);
  EXPECT_FALSE(CalcOpeningCurve(of_two, FindHandOpening("fan"), 10.0).IsValid(0));
  EXPECT_TRUE(CalcOpeningCurve(of_four, FindHandOpening("hull"), 10.0).IsValid(0));
  EXPECT_FALSE(CalcOpeningCurve(of_four, FindHandOpening("hull"), 10.0, "D2").IsValid(0));
}

}  // namespace
}  // namespace graspbench
