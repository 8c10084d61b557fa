/** @file
Known answers of real recordings from several makers' software. They lie outside the project. */

#include <gtest/gtest.h>

#include <algorithm>

#include "human_study/recording/importers/table_mapping.h"
#include "tests/human_study/recording/synthetic_recording.h"
#include "tests/support/mocap_data.h"

namespace graspbench {
namespace {

size_t CountInvalid(const Recording& recording) {
  size_t count = 0;
  for (const RecordedPoint& point : recording.points) {
    count += point.CountStates(SampleState::kInvalid);
  }
  return count;
}

/** Distances of two points over the frames that have both [m]. */
std::vector<double> FindDistances(const Recording& recording, const std::string& a,
                                  const std::string& b) {
  const RecordedPoint &p = recording.FindPoint(a), &q = recording.FindPoint(b);
  std::vector<double> distances;
  for (size_t frame = 0; frame < recording.num_frames; ++frame) {
    const double distance = (p.Position(frame) - q.Position(frame)).norm();
    if (std::isfinite(distance)) distances.push_back(distance);
  }
  return distances;
}

TEST(KnownRecordings, SixVariantsOfOneC3dAgree) {
  GRASPBENCH_REQUIRE_MOCAP(folder, "c3d.org/sample_01");
  const Recording reference = LoadRecording(folder / "Eb015pi.c3d");
  EXPECT_LT(
      (reference.points[0].CalcMeanPosition() - 1e-3 * Eigen::Vector3d(253.560, 1071.922, 42.571))
          .norm(),
      1e-6);
  for (const char* name : {"Eb015pi", "Eb015pr", "Eb015si", "Eb015sr", "Eb015vi", "Eb015vr"}) {
    const Recording recording = LoadRecording(folder / (std::string(name) + ".c3d"));
    EXPECT_EQ(recording.points.size(), 26u);
    EXPECT_EQ(recording.num_frames, 450u);
    EXPECT_EQ(recording.rate, 50.0);
    EXPECT_EQ(CountInvalid(recording), 226u);
    EXPECT_EQ(recording.events.size(), 3u);
    ASSERT_EQ(recording.analog.size(), 16u);
    EXPECT_EQ(recording.analog[0].rate, 200.0);
    for (size_t c = 0; c < 16; ++c) {
      EXPECT_EQ(recording.analog[c].samples, reference.analog[c].samples) << name;
    }
    double worst = 0.0;
    for (size_t i = 0; i < 26; ++i) {
      EXPECT_EQ(recording.points[i].states, reference.points[i].states);
      for (size_t frame = 0; frame < 450; ++frame) {
        const double difference =
            (recording.points[i].Position(frame) - reference.points[i].Position(frame)).norm();
        if (std::isfinite(difference)) worst = std::max(worst, difference);
      }
    }
    EXPECT_LT(worst, 1e-7) << name << ": 0.0001 mm";
  }
}

TEST(KnownRecordings, TwoHandsOfFiveFingers) {
  GRASPBENCH_REQUIRE_MOCAP(path, "c3d.org/sample_37/ART-Human_hands_real_no6dof.c3d");
  const Recording recording = LoadRecording(path);
  EXPECT_EQ(recording.points.size(), 61u);
  EXPECT_EQ(recording.num_frames, 969u);
  EXPECT_EQ(recording.rate, 60.0);
  EXPECT_TRUE(recording.analog.empty());
  EXPECT_EQ(CountFindings(recording, "all_residuals_zero"), 1u);
  const auto right = FindDistances(recording, "Human4:RTTI", "Human4:RIFT");
  const auto left = FindDistances(recording, "Human4:LTTI", "Human4:LIFT");
  EXPECT_NEAR(*std::min_element(right.begin(), right.end()), 13.608e-3, 1e-6);
  EXPECT_NEAR(*std::max_element(right.begin(), right.end()), 132.809e-3, 1e-6);
  EXPECT_NEAR(*std::min_element(left.begin(), left.end()), 22.728e-3, 1e-6);
  EXPECT_NEAR(*std::max_element(left.begin(), left.end()), 122.500e-3, 1e-6);
}

TEST(KnownRecordings, EventsOfTheEventGroup) {
  GRASPBENCH_REQUIRE_MOCAP(path, "c3d.org/sample_03/gait-pig.c3d");
  const Recording recording = LoadRecording(path);
  EXPECT_EQ(recording.processor, "DEC integer");
  ASSERT_EQ(recording.events.size(), 9u);
  EXPECT_EQ(recording.events[1].label, "Foot Off");
  EXPECT_EQ(recording.events[1].context, "Left");
  EXPECT_NEAR(recording.events[1].time, 1.1525, 1e-6);
  EXPECT_FALSE(recording.FindPoint("A22:LHipAngles").IsLength());
}

TEST(KnownRecordings, AnalogOffsetsApplyToFloatFilesToo) {
  GRASPBENCH_REQUIRE_MOCAP(path, "c3d.org/sample_07/16bitanalog.c3d");
  const Recording recording = LoadRecording(path);
  ASSERT_EQ(recording.analog.size(), 40u);
  // Raw values idle near the offset of 32,767, so forces idle near zero.
  double mean = 0.0;
  for (const float value : recording.analog[2].samples) mean += std::abs(value);
  EXPECT_LT(mean / static_cast<double>(recording.analog[2].samples.size()), 100.0);
}

TEST(KnownRecordings, FloatAnalogAgreesWithItsIntegerCopy) {
  GRASPBENCH_REQUIRE_MOCAP(folder, "c3d.org/sample_25");
  const Recording real = LoadRecording(folder / "analogfpscale04.c3d");
  const Recording integer = LoadRecording(folder / "analogfpscale04i.c3d");
  for (size_t c = 0; c < 3; ++c) {
    for (size_t k = 0; k < real.analog[c].samples.size(); ++k) {
      ASSERT_NEAR(real.analog[c].samples[k], integer.analog[c].samples[k], 1.0);
    }
  }
}

TEST(KnownRecordings, RepeatedLabels) {
  GRASPBENCH_REQUIRE_MOCAP(path, "kineticstoolkit/duplicate_labels.c3d");
  const Recording recording = LoadRecording(path);
  EXPECT_EQ(recording.num_frames, 1050u);
  EXPECT_EQ(recording.FindPoint("T8").CountStates(SampleState::kInvalid), 300u);
  EXPECT_EQ(recording.FindPoint("T8_2").CountStates(SampleState::kInvalid), 1047u);
  EXPECT_EQ(recording.FindPoint("T8_3").CountStates(SampleState::kInvalid), 1043u);
}

TEST(KnownRecordings, OptotrakN3dAgreesWithItsC3dTwin) {
  GRASPBENCH_REQUIRE_MOCAP(folder, "kineticstoolkit");
  const std::string stem = "kinematics_racing_probing_radial_styloid_R";
  const Recording n3d = LoadRecording(folder / (stem + ".n3d"));
  const Recording c3d = LoadRecording(folder / (stem + ".c3d"));
  EXPECT_EQ(n3d.points.size(), 41u);
  EXPECT_EQ(n3d.num_frames, 140u);
  EXPECT_EQ(n3d.rate, 70.0);
  EXPECT_EQ(CountInvalid(n3d), 250u);
  for (size_t i = 0; i < 41; ++i) {
    ASSERT_EQ(n3d.points[i].states, c3d.points[i].states);
    for (size_t frame = 0; frame < 140; ++frame) {
      if (n3d.points[i].states[frame] == SampleState::kInvalid) continue;
      EXPECT_LT((n3d.points[i].Position(frame) - c3d.points[i].Position(frame)).norm(), 1e-6);
    }
  }
}

TEST(KnownRecordings, QualisysFiveFingers) {
  GRASPBENCH_REQUIRE_MOCAP(path, "dfki-hand_embodiment/recording.tsv");
  const Recording recording = LoadRecording(path);
  EXPECT_EQ(recording.points.size(), 21u);
  EXPECT_EQ(recording.num_frames, 6000u);
  EXPECT_EQ(recording.FindPoint("thumb_tip").CountStates(SampleState::kInvalid), 493u);
  EXPECT_EQ(recording.FindPoint("middle_tip").CountStates(SampleState::kInvalid), 78u);
  EXPECT_EQ(recording.FindPoint("ring_tip").CountStates(SampleState::kInvalid), 42u);
  const auto distances = FindDistances(recording, "thumb_tip", "index_tip");
  EXPECT_EQ(distances.size(), 5507u);
  EXPECT_NEAR(*std::min_element(distances.begin(), distances.end()), 92.335e-3, 1e-6);
  EXPECT_NEAR(*std::max_element(distances.begin(), distances.end()), 162.007e-3, 1e-6);
}

TEST(KnownRecordings, CommaSeparatedTrc) {
  GRASPBENCH_REQUIRE_MOCAP(path, "pyomeca/markers.trc");
  const Recording recording = LoadRecording(path);
  EXPECT_EQ(recording.points.size(), 51u);
  EXPECT_EQ(recording.rate, 100.0);
  EXPECT_EQ(recording.num_frames, 93u) << "the file was shortened, its header says 652";
  EXPECT_EQ(CountFindings(recording, "frame_count_disputed"), 1u);
}

TEST(KnownRecordings, CleanedMotive) {
  GRASPBENCH_REQUIRE_MOCAP(path, "kinesis/motiveData.csv");
  const Recording recording = LoadRecording(path);
  EXPECT_EQ(recording.num_frames, 1436u);
  EXPECT_NEAR(recording.rate, 120.0, 1e-4);
  EXPECT_LT(
      (recording.FindPoint("LFinger").Position(0) - Eigen::Vector3d(0.094454, 0.021593, -0.096082))
          .norm(),
      1e-7);
}

TEST(KnownRecordings, OptotrakTableOf45Trials) {
  GRASPBENCH_REQUIRE_MOCAP(path, "kinesis/rtgData.txt");
  const std::filesystem::path mapping = std::filesystem::path(testing::TempDir()) / "kinesis.yaml";
  WriteFileAtomically(
      mapping,
      "unit: mm\npoints:\n  index: [indexXraw, indexYraw, indexZraw]\n"
      "  thumb: [thumbXraw, thumbYraw, thumbZraw]\n"
      "time: globalTime\ntime_unit: ms\ntrial: trialN\noccluded: fingersOccluded\n");
  ImportOptions options;
  options.mapping = mapping;
  const std::vector<TableTrial> trials = FindTableTrials(path, LoadTableMapping(mapping));
  EXPECT_EQ(trials.size(), 45u);
  size_t num_samples = 0, num_occluded = 0;
  std::vector<double> intervals;
  for (const TableTrial& trial : trials) {
    options.trial = trial.name;
    options.rows = trial.rows;
    const Recording recording = LoadRecording(path, options);
    num_samples += recording.num_frames;
    num_occluded += recording.points[0].CountStates(SampleState::kInvalid);
    for (size_t k = 1; k < recording.num_frames; ++k) {
      intervals.push_back(recording.Time(k) - recording.Time(k - 1));
    }
  }
  EXPECT_EQ(num_samples, 14372u);
  EXPECT_EQ(num_occluded, 775u);
  std::sort(intervals.begin(), intervals.end());
  EXPECT_NEAR(intervals[intervals.size() / 2], 11.8e-3, 0.01e-3);
  EXPECT_NEAR(intervals.back(), 59.18e-3, 0.01e-3);
}

}  // namespace
}  // namespace graspbench
