#include <gtest/gtest.h>

#include "core/base/random.h"
#include "core/base/units.h"
#include "tests/human_study/events/trajectories.h"
#include "tests/human_study/faults.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

const std::vector<Vector3d> kPlaces = {{0.02, 0, 0.05}, {-0.02, 0, 0.05}, {0, 0.03, 0.02}};

Pose FindPose(double t) {
  return MakePose(MakeRotationRpy(0.3 * t, -0.2, t), Vector3d(0.1 * t, 0.2, 0.3));
}

std::vector<Trajectory> MakeMarkers(size_t count) {
  std::vector<Trajectory> markers;
  for (size_t m = 0; m < count; ++m) {
    markers.push_back(SamplePath(MakeTimes(0, 1, 50),
                                 [m](double t) { return Vector3d(FindPose(t) * kPlaces[m]); }));
  }
  return markers;
}

TEST(MakeObjectTrack, ARigidMotionIsRecoveredExactly) {
  const ObjectTrack track = MakeObjectTrack(MakeMarkers(3), kPlaces);
  ASSERT_EQ(track.X_LO.size(), 51u);
  for (size_t i = 0; i < 51; ++i) {
    EXPECT_LT((track.X_LO[i].matrix() - FindPose(0.02 * static_cast<double>(i)).matrix()).norm(),
              1e-9);
  }
}

// Another implementation (Eigen's, by singular values) of the same least squares: three and four
// markers in a plane, a tetrahedron, and a strip, each with noise.
TEST(MakeObjectTrack, NoisyMarkersGiveThePoseOfUmeyama) {
  const std::vector<std::vector<Eigen::Vector3d>> sets = {
      {{0.0, 0.0, 0.1}, {0.03, 0.0, 0.1}, {0.01, 0.04, 0.1}},
      {{0.0, 0.0, 0.0}, {0.05, 0.0, 0.0}, {0.05, 0.04, 0.0}, {0.0, 0.04, 0.0}},
      {{0.0, 0.0, 0.0}, {0.05, 0.0, 0.0}, {0.0, 0.04, 0.0}, {0.01, 0.01, 0.06}},
      {{0.0, 0.0, 0.0}, {0.08, 0.001, 0.0}, {0.04, -0.001, 0.0}},
  };
  for (const std::vector<Eigen::Vector3d>& p_OM : sets) {
    RandomStream random("markers", std::to_string(p_OM.size()));
    std::vector<Trajectory> markers(p_OM.size());
    constexpr int kNumPoses = 200;
    std::vector<Eigen::Matrix3Xd> seen(kNumPoses);
    Eigen::Matrix3Xd places(3, static_cast<Eigen::Index>(p_OM.size()));
    for (size_t m = 0; m < p_OM.size(); ++m) places.col(static_cast<Eigen::Index>(m)) = p_OM[m];
    for (int i = 0; i < kNumPoses; ++i) {
      const Eigen::Vector3d axis(random.NextNormal(), random.NextNormal(), random.NextNormal());
      const Pose X_LO = MakePose(
          Eigen::AngleAxisd(random.NextUniform(0.0, kPi), axis.normalized()).matrix(), axis);
      seen[i] = X_LO * places;
      for (double& value : seen[i].reshaped()) value += 3e-4 * random.NextNormal();
    }
    for (size_t m = 0; m < p_OM.size(); ++m) {
      markers[m].p.resize(3, kNumPoses);
      for (int i = 0; i < kNumPoses; ++i) {
        markers[m].times.push_back(0.01 * i);
        markers[m].states.push_back(SampleState::kMeasured);
        markers[m].p.col(i) = seen[i].col(static_cast<Eigen::Index>(m));
      }
    }
    const ObjectTrack track = MakeObjectTrack(markers, p_OM);
    for (int i = 0; i < kNumPoses; ++i) {
      const Eigen::Matrix4d expected = Eigen::umeyama(places, seen[i], false);
      EXPECT_LT((track.X_LO[i].matrix() - expected).cwiseAbs().maxCoeff(), 1e-11) << p_OM.size();
    }
  }
}

TEST(MakeObjectTrack, AHiddenMarkerOfThreeHidesTheObjectAndAFilledOneMarksIt) {
  std::vector<Trajectory> markers = MakeMarkers(3);
  HideSamples(markers[1], 0.4, 0.5);
  markers[2].states[3] = SampleState::kFilled;
  const ObjectTrack track = MakeObjectTrack(markers, kPlaces);
  EXPECT_EQ(track.states[3], SampleState::kFilled);
  EXPECT_EQ(track.states[22], SampleState::kInvalid);
  EXPECT_TRUE(std::isnan(track.X_LO[22].translation().x()));
}

TEST(MakeObjectTrack, OneMarkerGivesTheDisplacementAlone) {
  const std::vector<Trajectory> markers = {
      SamplePath(MakeTimes(0, 1, 50), [](double t) { return Vector3d(0.1 + t, 0.2, 0.3); })};
  const ObjectTrack track = MakeObjectTrack(markers, {{0, 0, 0.05}});
  EXPECT_LT((track.X_LO[50].translation() - Vector3d(1.1, 0.2, 0.25)).norm(), 1e-12);
  EXPECT_TRUE(track.X_LO[50].linear().isIdentity());
}

TEST(MakeObjectTrack, MarkersOnOneLineAreRefused) {
  const std::string fault = FaultOf([] {
    MakeObjectTrack(MakeMarkers(3), {{0, 0, 0}, {0.01, 0, 0}, {0.03, 0, 0}});
  });
  ExpectHolds(fault, "3 markers lie on one line");
}

TEST(FindMarkerPlaces, AreMeansAtRestAboutTheGivenOrigin) {
  std::vector<Trajectory> markers = MakeMarkers(2);
  const std::vector<Vector3d> places = FindMarkerPlaces(markers, 0.01, Vector3d(0, 0, -0.05));
  const Vector3d a = FindPose(0) * kPlaces[0], b = FindPose(0) * kPlaces[1];
  EXPECT_LT((places[0] - ((a - b) / 2 + Vector3d(0, 0, 0.05))).norm(), 1e-12);
  HideSamples(markers[1], 0.0, 0.1);
  ExpectHolds(FaultOf([&] { FindMarkerPlaces(markers, 0.01, Vector3d::Zero()); }),
              "marker 2 of the object is not seen");
}

/** Markers of a body that moves as `pose` says, each coordinate with noise. */
ReachTrial MakeMovingObject(const std::vector<Vector3d>& places, double noise,
                            const std::function<Pose(double)>& pose) {
  ReachTrial trial;
  trial.times = MakeTimes(0, 2, 200);
  RandomStream random("object", "noise");
  std::vector<Trajectory> markers;
  for (const Vector3d& place : places) {
    markers.push_back(SamplePath(trial.times, [&](double t) {
      const Vector3d error(random.NextNormal(), random.NextNormal(), random.NextNormal());
      return Vector3d(pose(t) * place + noise * error);
    }));
  }
  trial.object = MakeObjectTrack(markers, places);
  return trial;
}

TEST(SmoothObject, KeepsAMotionAndTakesNoiseAway) {
  const auto pose = [](double t) {
    return MakePose(MakeRotationRpy(0.3 * t, 0, 0), Vector3d(0.1 * t, 0, 0));
  };
  const ObjectTrack exact = SmoothObject(MakeMovingObject(kPlaces, 0.0, pose), 6.0, 6.0);
  const ObjectTrack smooth = SmoothObject(MakeMovingObject(kPlaces, 0.0003, pose), 6.0, 6.0);
  for (size_t i = 100; i < 300; ++i) {
    const Pose truth = pose(exact.X_LO[i].translation().x() / 0.1);
    EXPECT_LT((exact.X_LO[i].matrix() - truth.matrix()).norm(), 1e-4);
    EXPECT_TRUE(smooth.X_LO[i].linear().isUnitary(1e-9));
    EXPECT_LT((smooth.X_LO[i].linear() - pose(0.005 * static_cast<double>(i)).linear()).norm(),
              0.02);
  }
}

/** SD of a coordinate, about its mean, of a fixed point near the hand, seen in O. */
double CalcLeverNoise(const std::vector<Vector3d>& places) {
  const ObjectTrack smooth = SmoothObject(
      MakeMovingObject(places, 0.0005, [](double) { return Pose::Identity(); }), 6.0, 6.0);
  const Vector3d tip(0.04, 0.03, -0.06);
  Vector3d sum = Vector3d::Zero();
  double squares = 0.0;
  for (size_t i = 40; i <= 360; ++i) {
    const Vector3d off = smooth.X_LO[i].inverse() * tip - tip;
    sum += off;
    squares += off.squaredNorm();
  }
  return std::sqrt((squares - sum.squaredNorm() / 321.0) / (3.0 * 321.0));
}

TEST(SmoothObject, ThreeMarkersAreNoWorseThanOneHoweverCloseTogether) {
  const double one = CalcLeverNoise({{0, 0, 0.06}});
  EXPECT_GT(one, 0.00005);
  for (const double edge : {0.005, 0.015, 0.03, 0.06}) {
    const double height = edge * std::sqrt(3.0) / 2.0;
    EXPECT_LT(CalcLeverNoise({{-edge / 2, 0, 0.06}, {edge / 2, 0, 0.06}, {0, height, 0.06}}), one)
        << edge;
  }
}

// A turn about the vertical does not let noise tilt the thing: at a lever of 70 mm in O, radially.
TEST(SmoothObject, WhatTurnsAboutOneAxisDoesNotTiltByNoise) {
  const std::vector<Vector3d> places = {{-0.015, 0, 0.05}, {0.015, 0, 0.05}, {0, 0.026, 0.05}};
  const auto pose = [](double t) {
    const double u = std::clamp((t - 0.9) / 0.2, 0.0, 1.0);
    return MakePose(MakeRotationRpy(0, 0, 0.26 * u * u * (3.0 - 2.0 * u)), Vector3d::Zero());
  };
  const ObjectTrack smooth = SmoothObject(MakeMovingObject(places, 0.0003, pose), 15.0, 15.0);
  // 0.3 mm over a lever of 21 mm, two ways, tilt one sample by 0.020, a mean of the 40 samples by
  // which the rest and a turn's axis are known by 0.0032. Smoothing alone would leave 0.0073.
  constexpr double kMeanTilt = 0.0032;
  double squares = 0.0;
  for (size_t i = 40; i < 360; ++i) {
    const Vector3d axis = smooth.X_LO[i].linear().col(2);
    EXPECT_LT(axis.head<2>().norm(), 3.0 * kMeanTilt) << i;
    if (i < 160) {
      EXPECT_EQ(axis, smooth.X_LO[40].linear().col(2)) << i;
    }
    if (i >= 220) squares += axis.head<2>().squaredNorm() / 140.0;
    const double yaw = std::atan2(smooth.X_LO[i].linear()(1, 0), smooth.X_LO[i].linear()(0, 0));
    const double truth = std::atan2(pose(0.005 * static_cast<double>(i)).linear()(1, 0),
                                    pose(0.005 * static_cast<double>(i)).linear()(0, 0));
    EXPECT_NEAR(yaw, truth, 0.03) << i;
  }
  EXPECT_LT(std::sqrt(squares), 1.4 * kMeanTilt);
}

TEST(MakeObjectTrack, TheLeverOfATurnIsThatOfItsMarkers) {
  // Four markers in a square of half diagonal a: J = diag(2, 2, 4) a^2.
  constexpr double a = 0.02;
  const std::vector<Vector3d> square = {{a, 0, 0.1}, {0, a, 0.1}, {-a, 0, 0.1}, {0, -a, 0.1}};
  const ObjectTrack track =
      MakeMovingObject(square, 0.0, [](double) { return Pose::Identity(); }).object;
  const Vector3d lever(std::sqrt(2.0) * a, std::sqrt(2.0) * a, 2 * a);
  EXPECT_LT((track.turn_lever - Eigen::Matrix3d(lever.asDiagonal())).norm(), 1e-12);
  EXPECT_LT((track.p_OC - Vector3d(0, 0, 0.1)).norm(), 1e-12);
}

ReachTrial MakeTrial() {
  ReachTrial trial;
  trial.times = MakeTimes(0, 1, 100);
  for (const char* id : {"TH", "FF"}) {
    DigitTrack digit;
    digit.digit = id;
    digit.is_thumb = digit.digit == "TH";
    digit.tip = SamplePath(trial.times, [](double t) { return Vector3d(t, 0, 0); });
    trial.digits.push_back(digit);
  }
  return trial;
}

TEST(CheckTrial, SaysWhatIsWrong) {
  EXPECT_EQ(FaultOf([] { CheckTrial(MakeTrial()); }), "");
  const auto fault_of = [](const std::function<void(ReachTrial&)>& spoil) {
    ReachTrial trial = MakeTrial();
    spoil(trial);
    return FaultOf([&] { CheckTrial(trial); });
  };
  ExpectHolds(fault_of([](ReachTrial& t) { t.digits.pop_back(); }), "it has 1 digits");
  ExpectHolds(fault_of([](ReachTrial& t) { t.digits[1].is_thumb = true; }), "2 thumbs");
  ExpectHolds(fault_of([](ReachTrial& t) { t.digits[1].tip.times.pop_back(); }),
              "the track of digit FF has 100 samples, the trial has 101");
  ExpectHolds(fault_of([](ReachTrial& t) { t.times[5] += 0.004; }), "not evenly spaced");
  ExpectHolds(fault_of([](ReachTrial& t) { t.object.X_LO.resize(3); }), "3 poses");
  ExpectHolds(fault_of([](ReachTrial& t) { t.digits[0].force.times = {0.0}; }),
              "the force of digit TH has 1 times and 0 values");
}

}  // namespace
}  // namespace graspbench
