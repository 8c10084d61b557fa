#include "human_study/recording/save_recording.h"

#include <gtest/gtest.h>

#include "core/base/files/files.h"
#include "tests/human_study/faults.h"
#include "tests/human_study/recording/synthetic_recording.h"

namespace graspbench {
namespace {

std::filesystem::path Folder() { return testing::TempDir(); }

TEST(SaveRecording, C3dAndTsvComeBackWithTheSamePositions) {
  const Recording original = MakeSyntheticRecording(40, 3);
  for (const char* name : {"copy.c3d", "copy.tsv"}) {
    SaveRecording(Folder() / name, original);
    const Recording read = LoadRecording(Folder() / name);
    ASSERT_EQ(read.points.size(), 3u) << name;
    EXPECT_EQ(read.rate, 100.0);
    EXPECT_EQ(read.first_frame, 5);
    for (size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(read.points[i].label, original.points[i].label);
      for (size_t k = 0; k < 120; ++k) {
        const float a = read.points[i].xyz[k], b = original.points[i].xyz[k];
        EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << name << ' ' << a << ' ' << b;
      }
    }
    ASSERT_EQ(read.events.size(), 4u);
    EXPECT_FLOAT_EQ(read.events[1].time, 75.5f);
  }
}

TEST(SaveRecording, CsvIsInMetresWithTheStateOfEverySample) {
  Recording recording;
  recording.rate = 50.0;
  recording.first_frame = 7;
  recording.start_time = 0.12;
  recording.num_frames = 2;
  recording.points.resize(1);
  recording.points[0].label = "tip, left";
  recording.points[0].Append(100.5, 0.0, -2.0);
  recording.points[0].Append(NAN, 0.0, 0.0);
  SetLengthUnit(recording, "mm", "test");
  SaveRecording(Folder() / "plain.csv", recording);
  EXPECT_EQ(ReadFile(Folder() / "plain.csv"),
            "frame,time_s,tip_ left_x_m,tip_ left_y_m,tip_ left_z_m,tip_ left_state\n"
            "7,0.12,0.1005,0,-0.002,measured\n8,0.14,,,,invalid\n");
}

TEST(SaveRecording, NoLabelIsRunByASpreadsheet) {
  for (const auto& [label, kept] : std::vector<std::pair<std::string, std::string>>{
           {"=1+2", "_1+2"}, {"-5", "_5"}, {"@cmd", "_cmd"}, {"'=x", "_=x"}, {"R+", "R+"}}) {
    Recording recording = MakeSyntheticRecording(2, 1);
    recording.points[0].label = label;
    SaveRecording(Folder() / "label.csv", recording);
    EXPECT_EQ(ReadFile(Folder() / "label.csv").substr(0, 14 + kept.size()),
              "frame,time_s," + kept + "_")
        << label;
    SaveRecording(Folder() / "label.tsv", recording);
    EXPECT_EQ(LoadRecording(Folder() / "label.tsv").points[0].label, kept);
  }
}

TEST(SaveRecording, WhatIsNoPositionIsLeftOutAndCounted) {
  Recording recording = MakeSyntheticRecording(4, 3);
  recording.points[1].unit = "deg";
  recording.points[1].metres_per_unit = NAN;
  for (const char* name : {"positions.c3d", "positions.tsv"}) {
    EXPECT_EQ(SaveRecording(Folder() / name, recording), 1u);
    const Recording read = LoadRecording(Folder() / name);
    ASSERT_EQ(read.points.size(), 2u);
    EXPECT_EQ(read.points[1].label, "P3");
    EXPECT_EQ(read.points[1].xyz[0], recording.points[2].xyz[0]);
  }
}

TEST(SaveRecording, RefusalsSayWhatToDo) {
  Recording recording = MakeSyntheticRecording(4, 1);
  const auto fault = [&](const char* name) {
    return FaultOf([&] { SaveRecording(Folder() / name, recording); });
  };
  ExpectHolds(fault("x.txt"), "recordings are written as .c3d, .tsv or .csv");
  recording.times = {0, 0.1, 0.3, 0.4};
  ExpectHolds(fault("x.tsv"), "write .csv or resample it first");
  SetLengthUnit(recording, "", "test");
  ExpectHolds(fault("x.csv"), "the length unit is not stated");
}

}  // namespace
}  // namespace graspbench
