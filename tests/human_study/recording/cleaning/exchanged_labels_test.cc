#include "human_study/recording/cleaning/exchanged_labels.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.h"
#include "human_study/study/run/recording_faults.h"
#include "tests/human_study/events/trajectories.h"

namespace graspbench {
namespace {

/** Thumb, index, middle (20 mm from the index) and wrist of a hand that goes 0.4 m in 0.8 s, opens
and closes. */
std::vector<Trajectory> MakeReachingHand(double rate, double noise) {
  RandomStream random("exchanged labels", std::to_string(rate));
  std::vector<Trajectory> tracks;
  for (const Eigen::Vector3d& place :
       {Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(1, 0, 0.01), Eigen::Vector3d(1, 0, -0.01),
        Eigen::Vector3d(0, -0.15, 0.05)}) {
    Trajectory track = SamplePath(MakeTimes(0.0, 2.0, rate), [&](double t) {
      const double open = 0.02 + 0.04 * Ease(t, 0.5, 1.0) - 0.025 * Ease(t, 1.0, 1.3);
      return Eigen::Vector3d(open * place.x(), place.y() + 0.4 * Ease(t, 0.5, 1.3),
                             place.z() + 0.1 * Ease(t, 1.5, 2.0));
    });
    for (size_t i = 0; i < track.size(); ++i) {
      for (int axis = 0; axis < 3; ++axis) track.At(i)(axis) += noise * random.NextNormal();
    }
    tracks.push_back(std::move(track));
  }
  return tracks;
}

void Exchange(std::vector<Trajectory>& tracks, size_t a, size_t b, size_t first, size_t last) {
  for (size_t i = first; i < last; ++i) {
    const Eigen::Vector3d place = tracks[a].At(i);
    tracks[a].At(i) = tracks[b].At(i);
    tracks[b].At(i) = place;
    std::swap(tracks[a].states[i], tracks[b].states[i]);
  }
}

/** Exchanged from an instant on, for some frames (0: the rest): each edge is found, both ways. */
void ExpectFound(double rate, double noise, double time, size_t num_frames, size_t a, size_t b) {
  std::vector<Trajectory> tracks = MakeReachingHand(rate, noise);
  const auto first = static_cast<size_t>(std::lround(time * rate));
  const size_t last = num_frames == 0 ? tracks[0].size() : first + num_frames;
  Exchange(tracks, a, b, first, last);
  const std::string where = std::to_string(rate) + " Hz, " + std::to_string(time) + " s, " +
                            std::to_string(num_frames) + " frames";
  const std::vector<LabelExchange> found = FindLabelExchanges(tracks);
  ASSERT_GE(found.size(), 2u) << where;
  EXPECT_EQ(found[0].sample, first) << where;
  EXPECT_EQ(found[0].label, a) << where;
  EXPECT_EQ(found[0].other, b) << where;
  EXPECT_EQ(found[1].label, b) << where;
  const double apart = (tracks[a].At(first) - tracks[b].At(first)).norm();
  EXPECT_NEAR(found[0].distance, apart, 0.2 * apart + 3.0 * noise) << where;
  EXPECT_EQ(found.back().sample, num_frames == 0 ? first : last) << where;
}

TEST(LabelExchanges, AreFoundAtAnyRateForAnyTime) {
  for (const double rate : {30.0, 60.0, 120.0, 240.0, 500.0}) {
    EXPECT_TRUE(FindLabelExchanges(MakeReachingHand(rate, 3e-4)).empty()) << rate;
    for (const double time : {0.2, 0.9, 1.2, 1.4, 1.7}) {
      for (const size_t num_frames : {size_t{0}, size_t{1}, size_t{2}, size_t{5}}) {
        ExpectFound(rate, 3e-4, time, num_frames, 0, 1);
      }
    }
  }
  // Neighbours, 20 mm apart.
  for (const double rate : {60.0, 120.0, 240.0}) {
    for (const size_t num_frames : {size_t{0}, size_t{1}, size_t{4}}) {
      ExpectFound(rate, 3e-4, 0.9, num_frames, 1, 2);
    }
  }
  EXPECT_TRUE(FindLabelExchanges(MakeReachingHand(100.0, 1e-3)).empty());
  ExpectFound(100.0, 1e-3, 1.0, 0, 0, 1);
}

// Markers that are lost and come back under each other's label, as where a hand closes.
TEST(LabelExchanges, AreFoundAcrossGaps) {
  for (const double rate : {60.0, 120.0, 240.0}) {
    for (const bool is_exchanged : {false, true}) {
      std::vector<Trajectory> tracks = MakeReachingHand(rate, 3e-4);
      const auto at = static_cast<size_t>(std::lround(1.15 * rate));
      if (is_exchanged) Exchange(tracks, 0, 1, at, tracks[0].size());
      HideSamples(tracks[0], 1.11, 1.17);
      HideSamples(tracks[1], 1.13, 1.20);
      EXPECT_EQ(FindLabelExchanges(tracks).empty(), !is_exchanged) << rate;
    }
  }
}

TEST(LabelExchanges, OtherFaultsAreNone) {
  const auto expect_none = [](const char* what, const auto& change) {
    std::vector<Trajectory> tracks = MakeReachingHand(120.0, 3e-4);
    change(tracks);
    EXPECT_TRUE(FindLabelExchanges(tracks).empty()) << what;
  };
  expect_none("a reflection", [](auto& tracks) { tracks[0].At(100).z() += 0.05; });
  expect_none("a marker that slips and stays", [](auto& tracks) {
    for (size_t i = 100; i < tracks[0].size(); ++i) tracks[0].At(i).z() += 0.03;
  });
  // Two labels for one marker: the other one has not gone.
  expect_none("a label on the next marker, which keeps its own", [](auto& tracks) {
    for (size_t i = 100; i < 110; ++i)
      tracks[0].At(i) = tracks[1].At(i) + Eigen::Vector3d(1e-3, 0, 0);
  });
  expect_none("lost frames", [](auto& tracks) {
    for (Trajectory& track : tracks) {
      for (size_t i = 100; i + 8 < track.size(); ++i)
        track.At(i) = Eigen::Vector3d(track.At(i + 8));
    }
  });
  expect_none("digits that pass each other 6 mm apart", [](auto& tracks) {
    for (size_t i = 0; i < tracks[0].size(); ++i) {
      const double across = 0.03 - 0.06 * Ease(tracks[0].times[i], 0.7, 1.1);
      tracks[0].At(i) = tracks[2].At(i) + Eigen::Vector3d(across, 0, 0);
      tracks[1].At(i) = tracks[2].At(i) + Eigen::Vector3d(-across, 0, 6e-3);
    }
  });
  EXPECT_TRUE(FindLabelExchanges({}).empty());
  EXPECT_TRUE(FindLabelExchanges(std::vector<Trajectory>(2)).empty());
}

// By names and time, in trials that hold the exchange alone.
TEST(RecordingFaults, NameTheMarkersThatExchangeTheirLabels) {
  Recording recording;
  recording.rate = 120.0;
  std::vector<Trajectory> tracks = MakeReachingHand(recording.rate, 3e-4);
  Exchange(tracks, 0, 1, 96, 99);
  const char* const labels[] = {"t", "i", "m", "w"};
  recording.num_frames = tracks[0].size();
  for (size_t m = 0; m < tracks.size(); ++m) {
    RecordedPoint& point = recording.points.emplace_back();
    point.label = labels[m];
    for (size_t i = 0; i < tracks[m].size(); ++i) {
      point.Append(tracks[m].At(i).x(), tracks[m].At(i).y(), tracks[m].At(i).z());
    }
  }
  SetLengthUnit(recording, "m", "test");
  StudyConfig config;
  config.markers.tips = {{"t"}, {"i"}, {"m"}, {}, {}};
  config.markers.wrist = {"w"};
  const auto find = [&](double begin, double end) {
    const PreparedRecording prepared = PrepareRecording(recording, config);
    return FindRecordingFaults(prepared, MakeReachTrial(prepared, {begin, end}, config, nullptr));
  };
  const std::vector<Doubt> doubts = find(0.0, 2.0);
  ASSERT_EQ(doubts.size(), 1u);
  EXPECT_EQ(doubts[0].code, "label_jump");
  ExpectHolds(doubts[0].text, "at 0.800 s the marker of thumb goes on where that of index was, ");
  ExpectHolds(doubts[0].text,
              "that of index is no longer there (the last such frame is at 0.825 s)");
  EXPECT_TRUE(find(0.9, 2.0).empty());
  EXPECT_TRUE(find(0.0, 0.7).empty());
  // A label that names no digit is quoted.
  for (RecordedPoint& point : recording.points) {
    if (point.label == "i") point.label = "w2";
  }
  config.markers.tips = {{"t"}, {"m"}, {}, {}, {}};
  config.markers.wrist = {"w2"};
  ExpectHolds(find(0.0, 2.0).at(0).text, "where that of \"w2\" was");
}

}  // namespace
}  // namespace graspbench
