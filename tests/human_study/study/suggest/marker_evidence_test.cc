#include <gtest/gtest.h>

#include <functional>

#include "core/base/random.h"
#include "human_study/study/suggest/suggest_settings.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr int kFrames = 600;
constexpr double kRate = 100.0;

void AddPoint(const std::string& label, const std::function<Vector3d(double)>& place,
              Recording& recording) {
  recording.rate = kRate;
  recording.start_time = 0.0;
  recording.num_frames = kFrames;
  recording.points.emplace_back();
  RecordedPoint& point = recording.points.back();
  point.label = label;
  point.unit = "m";
  point.metres_per_unit = 1.0;
  for (int i = 0; i < kFrames; ++i) {
    const Vector3d p = place(i / kRate);
    point.Append(p.x(), p.y(), p.z());
  }
}

/** Comes to the origin once in two seconds, from 0.4 m. */
Vector3d Come(double t) { return {0.2 + 0.2 * std::cos(3.14159265 * t), 0.0, 0.0}; }

Recording MakeRecording() {
  Recording recording;
  AddPoint("thumb_tip", Come, recording);
  AddPoint(
      "thumb_joint", [](double t) { return Vector3d(Come(t) + Vector3d(0, 0.03, 0)); }, recording);
  AddPoint(
      "elbow", [](double t) { return Vector3d(0.5 * Come(t) + Vector3d(0.3, 0, 0)); }, recording);
  AddPoint(
      "index_tip", [](double t) { return Vector3d(Come(t) + Vector3d(0, 0, 0.05)); }, recording);
  AddPoint(
      "box_1", [](double) { return Vector3d(0, 0, -0.02); }, recording);
  AddPoint(
      "box_2", [](double t) { return Vector3d(0.05 + 0.006 * std::sin(t * 6), 0, -0.02); },
      recording);
  for (size_t i = 100; i < 150; ++i) recording.points[0].SetInvalid(i);
  return recording;
}

MarkerConfig MakeMarkers() {
  MarkerConfig markers;
  markers.tips.thumb = {"thumb_tip"};
  markers.tips.index = {"index_tip"};
  markers.object = {"box_1", "box_2"};
  return markers;
}

TEST(FindCompanions, IsTheMarkerThatGoesAlongWhileTheTipIsHidden) {
  const std::vector<CompanionEvidence> found = FindCompanions(MakeRecording(), MakeMarkers());
  ASSERT_EQ(found.size(), 1u) << "the index is never hidden";
  EXPECT_EQ(found[0].companion, "thumb_joint");
  EXPECT_EQ(found[0].num_hidden, 50u);
  EXPECT_EQ(found[0].num_bridged, 50u);
  EXPECT_NEAR(found[0].distance, 0.03, 1e-6);
  EXPECT_LT(found[0].spread, 1e-6);
}

TEST(FindCompanions, NoneThatIsHiddenTooOrAlreadyNamed) {
  Recording recording = MakeRecording();
  for (size_t i = 100; i < 130; ++i) recording.points[1].SetInvalid(i);
  EXPECT_TRUE(FindCompanions(recording, MakeMarkers()).empty());
  MarkerConfig named = MakeMarkers();
  named.companions.thumb = "elbow";
  EXPECT_TRUE(FindCompanions(MakeRecording(), named).empty());
}

PreparedRecording Prepare(const Recording& recording) {
  StudyConfig config;
  config.markers = MakeMarkers();
  config.cleaning.drop_frozen = false;  // the box rests
  return PrepareRecording(recording, config);
}

// The second marker of the box swings by 2 x 6 mm against the first; 90 % of a sine's values lie
// within sin(0.45 pi) of its amplitude.
TEST(FindYield, IsHowFarTheObjectsMarkersPart) {
  EXPECT_NEAR(FindYield(Prepare(MakeRecording())), 0.012 * std::sin(0.45 * 3.14159265), 2e-4);
  Recording one = MakeRecording();
  one.points.pop_back();
  EXPECT_EQ(FindYield(Prepare(one)), 0.0);
}

TEST(FindYield, NoiseIsNoYield) {
  Recording still = MakeRecording();
  RandomStream random("yield", "noise");
  for (RecordedPoint& point : still.points) {
    for (size_t i = kFrames; i-- > 0;) {
      for (size_t k = 0; k < 3; ++k)
        point.xyz[3 * i + k] = point.xyz[k] + random.NextNormal() / 1e3;
    }
  }
  EXPECT_LT(FindYield(Prepare(still)), 0.002);  // the middle 90 % are 4.7 mm wide
}

TEST(FindCut, FindsTheThreeReachesOfSixSeconds) {
  const PreparedRecording prepared = Prepare(MakeRecording());
  const std::optional<CutConfig> cut = FindCut(prepared);
  ASSERT_TRUE(cut);
  EXPECT_LT(cut->near, cut->far);
  EXPECT_EQ(FindReaches(prepared, *cut).size(), 3u);
  Recording still = MakeRecording();
  for (RecordedPoint& point : still.points) {
    for (size_t i = 1; i < kFrames; ++i) {
      for (size_t k = 0; k < 3; ++k) point.xyz[3 * i + k] = point.xyz[k];
    }
  }
  EXPECT_FALSE(FindCut(Prepare(still)));
}

}  // namespace
}  // namespace graspbench
