#include "human_study/recording/cleaning/lost_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/random.h"
#include "human_study/study/run/recording_faults.h"
#include "tests/human_study/events/trajectories.h"

namespace graspbench {
namespace {

constexpr double kRate = 200.0, kNoise = 3e-4;

/** Markers of a hand that goes 0.4 m in 0.8 s and closes; without the frames of `lost`. */
std::vector<Trajectory> MakeHand(const std::vector<int>& lost, double closing = 0.03) {
  std::vector<double> stamps, times;
  for (int i = 0; i < 400; ++i) {
    if (std::find(lost.begin(), lost.end(), i) != lost.end()) continue;
    times.push_back(i / kRate);
    stamps.push_back(static_cast<double>(stamps.size()) / kRate);  // evenly, whatever is missing
  }
  RandomStream random("lost frames", "hand");
  std::vector<Trajectory> tracks;
  for (int m = 0; m < 5; ++m) {
    Trajectory track = SamplePath(times, [&](double t) {
      return Eigen::Vector3d(0.4 * Ease(t, 0.5, 1.3), 0.02 * m - closing * m * Ease(t, 0.9, 1.3),
                             0.1 * Ease(t, 0.4, 0.9) - 0.1 * Ease(t, 0.8, 1.3));
    });
    track.times = stamps;
    for (size_t i = 0; i < track.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) track.At(i)(axis) += kNoise * random.NextNormal();
    }
    tracks.push_back(std::move(track));
  }
  return tracks;
}

std::vector<FrameLoss> Find(const std::vector<Trajectory>& tracks) {
  std::vector<const Trajectory*> pointers;
  for (const Trajectory& track : tracks) pointers.push_back(&track);
  return FindFrameLosses(pointers);
}

TEST(FrameLosses, AreFoundWhereTheHandMovesWithTheirNumber) {
  EXPECT_TRUE(Find(MakeHand({})).empty());
  const std::vector<FrameLoss> losses = Find(MakeHand({180, 200, 201, 202}));
  ASSERT_EQ(losses.size(), 2u);
  EXPECT_EQ(losses[0].sample, 180u);
  EXPECT_NEAR(losses[0].count, 1.0, 0.3);
  EXPECT_EQ(losses[1].sample, 199u);
  EXPECT_NEAR(losses[1].count, 3.0, 0.4);
  EXPECT_TRUE(Find(MakeHand({20, 21, 22})).empty()) << "at rest nothing shows them";
}

// One marker that jumps, or all that turn back, lacks no frame.
TEST(FrameLosses, OtherJumpsAreNone) {
  std::vector<Trajectory> spike = MakeHand({});
  for (size_t i = 180; i < spike[0].size(); ++i) spike[0].At(i).x() += 0.02;
  EXPECT_TRUE(Find(spike).empty());
  std::vector<Trajectory> back = MakeHand({});
  for (Trajectory& track : back) {
    for (size_t i = 180; i < track.size(); ++i) track.At(i).y() += 0.02;  // across its way
  }
  EXPECT_TRUE(Find(back).empty());
}

TEST(RecordingFaults, NameLostFramesAndHandModels) {
  const auto find = [](const std::vector<Trajectory>& tracks) {
    PreparedRecording recording;
    ReachTrial trial;
    recording.rate = kRate;
    recording.times = trial.times = tracks[0].times;
    recording.frame_losses = Find(tracks);
    for (const Trajectory& track : tracks) trial.digits.emplace_back().tip = track;
    return FindRecordingFaults(recording, trial);
  };
  EXPECT_TRUE(find(MakeHand({})).empty());
  EXPECT_TRUE(find(MakeHand({180})).empty()) << "5 ms in one place";
  const std::vector<Doubt> lost = find(MakeHand({180, 200}));
  ASSERT_EQ(lost.size(), 1u);
  EXPECT_EQ(lost[0].code, "frame_jump");
  ExpectHolds(lost[0].text, "in 2 places all markers go on by more than one of their own steps");
  const std::vector<Doubt> model = find(MakeHand({}, 0.0));  // never closes
  ASSERT_EQ(model.size(), 1u);
  EXPECT_EQ(model[0].code, "constant_shape");
  ExpectHolds(model[0].text, "a hand model, not measured digits");
}

}  // namespace
}  // namespace graspbench
