#include <gtest/gtest.h>

#include "core/base/random.h"
#include "tests/human_study/events/trajectories.h"

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
  EXPECT_NE(fault.find("3 markers lie on one line"), std::string::npos) << fault;
}

TEST(FindMarkerPlaces, AreMeansAtRestAboutTheGivenOrigin) {
  std::vector<Trajectory> markers = MakeMarkers(2);
  const std::vector<Vector3d> places = FindMarkerPlaces(markers, 0.01, Vector3d(0, 0, -0.05));
  const Vector3d a = FindPose(0) * kPlaces[0], b = FindPose(0) * kPlaces[1];
  EXPECT_LT((places[0] - ((a - b) / 2 + Vector3d(0, 0, 0.05))).norm(), 1e-12);
  HideSamples(markers[1], 0.0, 0.1);
  EXPECT_NE(FaultOf([&] {
              FindMarkerPlaces(markers, 0.01, Vector3d::Zero());
            }).find("marker 2 of the object is not seen"),
            std::string::npos);
}

TEST(SmoothObject, KeepsASlowMotionAndTakesNoiseAway) {
  ReachTrial trial;
  trial.times = MakeTimes(0, 2, 200);
  RandomStream random("object", "noise");
  for (const double t : trial.times) {
    const auto noise = [&] { return 0.01 * random.NextNormal(); };
    trial.object.X_LO.push_back(
        MakePose(MakeRotationRpy(0.1 * t + noise(), noise(), noise()), Vector3d(0.1 * t, 0, 0)));
    trial.object.states.push_back(SampleState::kMeasured);
  }
  const ObjectTrack smooth = SmoothObject(trial, 6.0);
  const Pose& pose = smooth.X_LO[200];
  EXPECT_TRUE(pose.linear().isUnitary(1e-9));
  EXPECT_NEAR(pose.translation().x(), 0.1, 1e-9);
  EXPECT_LT((pose.linear() - MakeRotationRpy(0.1, 0, 0)).norm(), 0.01);
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
  EXPECT_NE(fault_of([](ReachTrial& t) { t.digits.pop_back(); }).find("it has 1 digits"),
            std::string::npos);
  EXPECT_NE(fault_of([](ReachTrial& t) { t.digits[1].is_thumb = true; }).find("2 thumbs"),
            std::string::npos);
  EXPECT_NE(fault_of([](ReachTrial& t) {
              t.digits[1].tip.times.pop_back();
            }).find("the track of digit FF has 100 samples, the trial has 101"),
            std::string::npos);
  EXPECT_NE(fault_of([](ReachTrial& t) { t.times[5] += 0.004; }).find("not evenly spaced"),
            std::string::npos);
  EXPECT_NE(fault_of([](ReachTrial& t) { t.object.X_LO.resize(3); }).find("3 poses"),
            std::string::npos);
  EXPECT_NE(fault_of([](ReachTrial& t) {
              t.digits[0].force.times = {0.0};
            }).find("the force of digit TH has 1 times and 0 values"),
            std::string::npos);
}

}  // namespace
}  // namespace graspbench
