#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <fstream>

#include "core/base/files/files.h"
#include "human_study/recording/importers/table_mapping.h"
#include "tests/human_study/recording/synthetic_recording.h"
#include "tests/support/processor_time.h"

namespace graspbench {
namespace {

const std::string kQualisysHead =
    "NO_OF_FRAMES\t3\r\nNO_OF_CAMERAS\t7\r\nNO_OF_MARKERS\t2\r\nFREQUENCY\t100\r\n"
    "DESCRIPTION\t--\r\nTIME_STAMP\t2021-08-26, 15:19:24.317\t1483034.68\r\n"
    "DATA_INCLUDED\t3D\r\nEVENT\ttouch\t2\t0.01000\r\n"
    "MARKER_NAMES\tthumb\tindex\r\nTRAJECTORY_TYPES\tMeasured\tMixed\r\n";

TEST(QualisysTsv, MissingIsEmptyNanOrZero) {
  const Recording read = ImportBytes(kQualisysHead +
                                         "Frame\tTime\tthumb X\tthumb Y\tthumb Z\tindex X\tindex "
                                         "Y\tindex Z\t\r\n"
                                         "11\t0.10000\t1\t2\t3\t0\t0\t0\t\r\n"
                                         "12\t0.11000\tnan\tnan\tnan\t4\t5\t6\t\r\n"
                                         "13\t0.12000\t\t\t\t-4.5e1\t5\t6\t\r\n",
                                     "qualisys_tsv");
  EXPECT_EQ(read.num_frames, 3u);
  EXPECT_EQ(read.first_frame, 11);
  EXPECT_DOUBLE_EQ(read.Time(2), 0.12);
  EXPECT_EQ(read.points[0].CountStates(SampleState::kInvalid), 2u);
  EXPECT_EQ(read.points[1].CountStates(SampleState::kInvalid), 1u);
  EXPECT_NEAR(read.points[1].Position(2).x(), -0.045, 1e-9);
  EXPECT_EQ(CountFindings(read, "zero_coordinates"), 1u);
  EXPECT_EQ(CountFindings(read, "mixed_trajectory"), 1u);
  ASSERT_EQ(read.events.size(), 1u);
  EXPECT_EQ(read.events[0].time, 0.01);
}

TEST(QualisysTsv, RowsMayComeWithoutFrameTimeAndHeading) {
  const Recording read =
      ImportBytes(kQualisysHead + "1\t2\t3\t4\t5\t6\n1\t2\t3\t4\t5\t6\n", "qualisys_tsv");
  EXPECT_EQ(read.num_frames, 2u);
  EXPECT_EQ(read.Time(1), 0.01);
  EXPECT_EQ(CountFindings(read, "frame_count_disputed"), 1u);
}

// Some write metres; a unit that a person states is believed.
TEST(QualisysTsv, AStatedUnitCounts) {
  const std::string file =
      "NO_OF_FRAMES\t2\nNO_OF_MARKERS\t1\nFREQUENCY\t100\nDATA_INCLUDED\t3D\nMARKER_NAMES\ttip\n"
      "0.1\t0.2\t0.3\n0.1\t0.2\t0.4\n";
  ImportOptions options;
  EXPECT_NEAR(ImportBytes(file, "qualisys_tsv", options).points[0].Position(0).z(), 0.0003, 1e-9);
  EXPECT_EQ(CountFindings(ImportBytes(file, "qualisys_tsv", options), "unit_by_convention"), 1u);
  options.unit = "m";
  const Recording metres = ImportBytes(file, "qualisys_tsv", options);
  EXPECT_NEAR(metres.points[0].Position(0).z(), 0.3, 1e-7);
  EXPECT_EQ(CountFindings(metres, "unit_by_convention"), 0u);
}

TEST(QualisysTsv, FaultsNameTheirLine) {
  EXPECT_EQ(
      ImportFault(kQualisysHead + "1\t2\t3\t4\t5\t6\n1\t2\tx\x01y\t4\t5\t6\n", "qualisys_tsv"),
      "file:12: column 3: \"x?y\" is not a number");
  EXPECT_EQ(ImportFault(kQualisysHead + "1\t2\t3\t4\t5\t6\n1\t2", "qualisys_tsv"),
            "file:12: the row has 2 columns, expected 6; the file is cut off or damaged here "
            "(--accept-truncated reads what comes before)");
  EXPECT_EQ(ImportFault("NO_OF_FRAMES\t-5\n", "qualisys_tsv"),
            "file:1: NO_OF_FRAMES is \"-5\"; expected a number from 0 to 2147483647");
  EXPECT_EQ(ImportFault("NO_OF_FRAMES\t1\nDATA_INCLUDED\t6D\n", "qualisys_tsv"),
            "file:2: DATA_INCLUDED is 6D; only position exports (3D) can be read");
  EXPECT_EQ(ImportFault("NO_OF_FRAMES\t3\n", "qualisys_tsv"),
            "file:2: the file ends before the first row of data");
  EXPECT_EQ(ImportFault("", "qualisys_tsv"), "file:1: the file ends before its header");
  EXPECT_EQ(ImportFault(kQualisysHead + "1\t2\t3\t4\n", "qualisys_tsv"),
            "file:11: the first row of data has 4 columns, expected 6 or more");
  EXPECT_EQ(ImportFault(kQualisysHead + "1\t2\t3\t4\t5\t6\t7\n", "qualisys_tsv"),
            "file:11: the row has 7 columns, expected 6 or, with frame and time, 8");
  EXPECT_NE(ImportFault(kQualisysHead + "1\t0.5\t1\t2\t3\t4\t5\t6\n2\t0.4\t1\t2\t3\t4\t5\t6\n",
                        "qualisys_tsv")
                .find("file:12: time is 0.4 s after 0.5 s; times must increase"),
            std::string::npos);
}

TEST(QualisysTsv, ATruncatedRowMayBeAccepted) {
  ImportOptions options;
  options.accept_truncated = true;
  const Recording read =
      ImportBytes(kQualisysHead + "1\t2\t3\t4\t5\t6\n1\t2", "qualisys_tsv", options);
  EXPECT_EQ(read.num_frames, 1u);
  EXPECT_EQ(CountFindings(read, "truncated"), 1u);
}

TEST(QualisysTsv, RedactingKeepsTheData) {
  std::string bytes = kQualisysHead + "1\t2\t3\t4\t5\t6\n";
  const auto fields = FindImporter("qualisys_tsv", "", "").redact(bytes, "file");
  ASSERT_EQ(fields.size(), 2u);
  EXPECT_EQ(bytes.find("2021-08-26"), std::string::npos);
  EXPECT_EQ(ImportBytes(bytes, "qualisys_tsv").num_frames, 1u);
}

std::string Trc(char delimiter) {
  std::string text =
      "PathFileType\t4\t(X/Y/Z)\t/home/anna/s01.trc\n"
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n100\t100\t2\t2\tmm\n"
      "Frame#\tTime\tthumb\t\t\tindex\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n"
      "0\t0\t1\t2\t3\t\t\t\n1\t0.01\t1\t2\t3\t4\t5\t6\n";
  for (char& c : text) {
    if (c == '\t') c = delimiter;
  }
  return text;
}

TEST(Trc, TabsAndCommas) {
  for (const char delimiter : {'\t', ','}) {
    const Recording read = ImportBytes(Trc(delimiter), "trc");
    EXPECT_EQ(read.num_frames, 2u);
    EXPECT_EQ(read.first_frame, 0);
    EXPECT_EQ(read.Time(1), 0.01);
    EXPECT_EQ(read.points[1].label, "index");
    EXPECT_EQ(read.points[1].states[0], SampleState::kInvalid);
    EXPECT_NEAR(read.points[1].Position(1).z(), 0.006, 1e-9);
    EXPECT_TRUE(read.findings.empty());
    std::string bytes = Trc(delimiter);
    const auto fields = FindImporter("trc", "", "").redact(bytes, "file");
    ASSERT_EQ(fields.size(), 1u);
    EXPECT_EQ(fields[0].text, "/home/anna/s01.trc");
    EXPECT_EQ(bytes.find("anna"), std::string::npos);
    EXPECT_EQ(ImportBytes(bytes, "trc").num_frames, 2u);
  }
  EXPECT_EQ(ImportFault("PathFileType\t4\nDataRate\n100\n", "trc"),
            "file:3: NumFrames is \"\"; expected a number from 0 to 2147483647");
}

const std::string kMotive =
    "\xef\xbb\xbf"
    "Format Version,1.23,Take Name,Anna 01,Take Notes,,Capture Frame Rate,120.000000,"
    "Export Frame Rate,120.000000,Capture Start Time,2020-01-01 10.00.00 AM,Total Frames in "
    "Take,2,Rotation Type,XYZ,Length Units,Millimeters,Coordinate Space,Global\n\n"
    ",Type,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid Body,Rigid "
    "Body,Marker,Marker,Marker,Marker,Marker,Marker\n"
    ",Name,Box,Box,Box,Box,Box,Box,Box,Hand:thumb,Hand:thumb,Hand:thumb,Unlabeled 1,Unlabeled "
    "1,Unlabeled 1\n"
    ",ID,1,1,1,1,1,1,1,2,2,2,3,3,3\n"
    ",,Rotation,Rotation,Rotation,Position,Position,Position,Mean Marker "
    "Error,Position,Position,Position,Position,Position,Position\n"
    "Frame,Time (Seconds),X,Y,Z,X,Y,Z,,X,Y,Z,X,Y,Z\n"
    "0,0.000000,1,2,3,10,20,30,0.1,100,200,300,,,\n"
    "1,0.008333,1,2,3,10,20,30,0.1,,,,7,8,9\n";

TEST(MotiveCsv, RawTakesPositionsAndLeavesRotations) {
  const Recording read = ImportBytes(kMotive, "motive_csv");
  ASSERT_EQ(read.points.size(), 3u);
  EXPECT_EQ(read.points[0].label, "Box");
  EXPECT_NEAR(read.points[0].Position(0).z(), 0.03, 1e-9);
  EXPECT_EQ(read.points[1].label, "Hand:thumb");
  EXPECT_EQ(read.points[1].states[1], SampleState::kInvalid);
  EXPECT_EQ(read.rate, 120.0);
  EXPECT_EQ(read.Time(0), 0.0);
  EXPECT_EQ(CountFindings(read, "unlabelled_markers"), 1u);
  std::string bytes = kMotive;
  EXPECT_EQ(FindImporter("motive_csv", "", "").redact(bytes, "file").size(), 2u);
  EXPECT_EQ(bytes.find("Anna"), std::string::npos);
  EXPECT_EQ(ImportBytes(bytes, "motive_csv").num_frames, 2u);
}

TEST(MotiveCsv, CleanedIsMetresAndSaysSo) {
  const Recording read = ImportBytes(
      "frame,time_sec,T_position_x,T_position_y,T_position_z\n0,0,0.1,0.2,0.3\n1,0.01,0.1,0.2,0."
      "3\n",
      "motive_csv");
  EXPECT_NEAR(read.points[0].Position(0).y(), 0.2, 1e-7);
  EXPECT_NEAR(read.rate, 100.0, 1e-9);
  EXPECT_EQ(CountFindings(read, "unit_by_convention"), 1u);
  EXPECT_EQ(CountFindings(read, "rate_from_times"), 1u);
}

// Format version 1.1: NaturalPoint's Motive 1.5 to 1.7 leave the titles of the rows out.
TEST(MotiveCsv, RowsWithoutTitlesAreThoseOfVersions15To17) {
  const Recording read = ImportBytes(
      "Format Version,1.1,Take Name,take,Capture Frame Rate,100.000000,Total Frames,2\n\n"
      ",,Marker,Marker,Marker,Marker,Marker,Marker\n"
      ",,Hand:thumb,Hand:thumb,Hand:thumb,Hand:index,Hand:index,Hand:index\n"
      ",,A1,A1,A1,A2,A2,A2\n"
      ",,Position,Position,Position,Position,Position,Position\n"
      "Frame,Time,X,Y,Z,X,Y,Z\n"
      "0,0.00,0.1,0.2,0.3,,,\n"
      "1,0.01,0.1,0.2,0.4,0.5,0.6,0.7\n",
      "motive_csv");
  ASSERT_EQ(read.points.size(), 2u);
  EXPECT_EQ(read.points[0].label, "Hand:thumb");
  EXPECT_EQ(read.points[1].label, "Hand:index");
  EXPECT_NEAR(read.points[0].Position(1).z(), 0.4, 1e-7);
  EXPECT_EQ(read.points[1].states[0], SampleState::kInvalid);
  EXPECT_EQ(read.rate, 100.0);
  EXPECT_EQ(CountFindings(read, "unit_by_convention"), 1u);
}

TEST(MotiveCsv, FaultsNameTheirLine) {
  EXPECT_EQ(ImportFault("Format Version,1.23\n\n,Type,Marker\n", "motive_csv"),
            "file:4: the file ends before the row \"Frame, Time (Seconds), ..\"");
  EXPECT_EQ(ImportFault("Format Version,1.23,Capture Frame Rate,fast\n", "motive_csv"),
            "file:1: Capture Frame Rate is \"fast\"; expected a number from 1e-06 to 1000000");
}

const std::string kNexus =
    "Events\n100\nSubject,Context,Name,Time (s),Description\nAnna,Left,touch,0.02,\n\n"
    "Devices\n200\n,,Plate - Force,,\nFrame,Sub Frame,Fx,Fy,Fz\n,,N,N,N\n1,0,1,2,3\n1,1,4,5,6\n\n"
    "Joints\n100\n,,x\nFrame,Sub Frame,RX\n,,deg\n1,0,5\n\n"
    "Trajectories\n100\n,,Anna:thumb,,,Anna:index,,\nFrame,Sub Frame,X,Y,Z,X,Y,Z\n"
    ",,mm,mm,mm,mm,mm,mm\n31,0,1,2,3,,,\n32,0,1,2,3,4,5,6\n";

TEST(NexusCsv, BlocksBecomePointsChannelsAndEvents) {
  const Recording read = ImportBytes(kNexus, "nexus_csv");
  EXPECT_EQ(read.first_frame, 31);
  EXPECT_EQ(read.Time(0), 0.30);
  ASSERT_EQ(read.points.size(), 2u);
  EXPECT_EQ(read.points[1].label, "Anna:index");
  EXPECT_EQ(read.points[1].states[0], SampleState::kInvalid);
  ASSERT_EQ(read.analog.size(), 3u);
  EXPECT_EQ(read.analog[2].label, "Plate - Force Fz");
  EXPECT_EQ(read.analog[2].rate, 200.0);
  EXPECT_EQ(read.analog[2].samples, (std::vector<float>{3, 6}));
  ASSERT_EQ(read.events.size(), 1u);
  EXPECT_EQ(read.events[0].context, "Left");
  EXPECT_EQ(CountFindings(read, "block_skipped"), 1u);
}

TEST(NexusCsv, RedactingRemovesTheSubject) {
  std::string bytes = kNexus;
  EXPECT_EQ(FindImporter("nexus_csv", "", "").redact(bytes, "file").size(), 3u);
  EXPECT_EQ(bytes.find("Anna"), std::string::npos);
  EXPECT_EQ(ImportBytes(bytes, "nexus_csv").points[0].label, "thumb");
}

TEST(NexusCsv, FaultsNameTheirLine) {
  EXPECT_EQ(ImportFault("Trajectories\n0\n", "nexus_csv"),
            "file:2: the rate of block Trajectories is \"0\"; expected a number from 1e-06 to "
            "1000000");
  EXPECT_EQ(ImportFault("Trajectories\n100\n,,a,,\nFrame,Sub Frame,X,Y,Z\n,,mm,mm,mm\n1,0,1,2,3\n"
                        "3,0,1,2,3\n",
                        "nexus_csv"),
            "file:7: frame 3 follows frame 1; frames must be consecutive");
  EXPECT_EQ(ImportFault("Joints\n1\n\n", "nexus_csv"),
            "file:3: no block of Trajectories or Devices was found");
}

struct Bids {
  std::string motion = "1\t2\t3\t0.5\n4\tn/a\t6\t0.6\n";
  std::string channels =
      "name\tcomponent\ttype\ttracked_point\tunits\nt_x\tx\tPOS\tthumb\tm\nt_y\ty\tPOS\tthumb\tm\n"
      "t_z\tz\tPOS\tthumb\tm\nforce\tn/a\tMISC\tn/a\tN\n";
  std::string json = "{\"SamplingFrequency\": 100}";
  std::string events = "onset\tduration\ttrial_type\n0.25\t0\ttouch\n";

  Recording Import() const {
    std::istringstream stream(motion);
    const auto sibling = [&](const std::string& name) -> std::optional<std::string> {
      if (name == "sub-1_task-g_tracksys-q_channels.tsv") return channels;
      if (name == "sub-1_task-g_tracksys-q_motion.json") return json;
      if (name == "sub-1_task-g_events.tsv") return events;
      return std::nullopt;
    };
    return FindImporter("motion_bids", "", "")
        .import({stream, "in/sub-1_task-g_tracksys-q_motion.tsv", sibling}, {});
  }
  std::string Fault() const {
    try {
      Import();
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
};

TEST(MotionBids, SidecarsDescribeTheColumns) {
  const Recording read = Bids().Import();
  ASSERT_EQ(read.points.size(), 1u);
  EXPECT_EQ(read.points[0].label, "thumb");
  EXPECT_EQ(read.points[0].Position(0), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(read.points[0].states[1], SampleState::kInvalid);
  ASSERT_EQ(read.analog.size(), 1u);
  EXPECT_EQ(read.analog[0].samples[1], 0.6f);
  ASSERT_EQ(read.events.size(), 1u);
  EXPECT_EQ(read.events[0].time, 0.25);
}

TEST(MotionBids, FaultsNameTheSidecar) {
  Bids bids;
  bids.json = "{\"SamplingFrequency\": \"fast\"}";
  EXPECT_EQ(bids.Fault(),
            "sub-1_task-g_tracksys-q_motion.json:1: SamplingFrequency is absent or not a number "
            "above 0");
  bids = {};
  bids.channels.resize(bids.channels.find("t_z"));
  EXPECT_EQ(bids.Fault(),
            "sub-1_task-g_tracksys-q_channels.tsv:1: tracked point \"thumb\" lacks one of its "
            "components x, y, z");
  bids = {};
  bids.motion = "1\t2\n";
  EXPECT_NE(bids.Fault().find("_motion.tsv:1: the row has 2 columns, expected 4"),
            std::string::npos);
  EXPECT_EQ(ImportFault("1\t2\n", "motion_bids"),
            "file: \"_motion.json\", which describes its columns, is not beside it");
}

std::filesystem::path WriteText(const std::string& name, const std::string& text) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / name;
  std::ofstream(path) << text;
  return path;
}

const std::string kMapping =
    "unit: mm\npoints:\n  tip: [a, b, c]\ntime: t\ntime_unit: ms\ntrial: n\noccluded: o\n";
const std::string kTable =
    "n;t;a;b;c;o\n1;0;1;2;3;0\n1;11;1;2;3;1\n1;20;1;2;3;0\n2;0;7;8;9;0\n2;10;7;8;9;0\n";

TEST(Table, AMappingNamesTheColumns) {
  ImportOptions options;
  options.mapping = WriteText("mapping.yaml", kMapping);
  options.trial = "1";
  const Recording read = ImportBytes(kTable, "table", options);
  EXPECT_EQ(read.num_frames, 3u);
  EXPECT_EQ(read.points[0].states[1], SampleState::kInvalid) << "occluded";
  EXPECT_EQ(read.Time(1), 0.011);
  EXPECT_EQ(CountFindings(read, "irregular_times"), 1u);
  EXPECT_EQ(FindTableTrials(WriteText("table.csv", kTable), LoadTableMapping(options.mapping)),
            (std::vector<std::string>{"1", "2"}));
  options.trial = "3";
  EXPECT_EQ(ImportFault(kTable, "table", options),
            "file: no trial \"3\"; did you mean \"1\"? Known: 1, 2");
  options.trial = "";
  EXPECT_EQ(
      ImportFault(kTable, "table", options),
      "file: the table holds 2 trials, \"1\" to \"2\"; name one (--trial of graspbench mocap, "
      "column table_trial of a study's trials.csv)");
  EXPECT_EQ(ImportFault("n;t;a;b\n", "table", options),
            "file:1: the mapping names columns the table does not have: c, o; did you mean \"n\"? "
            "Known: n, t, a, b");
  EXPECT_EQ(ImportFault(kTable, "table"),
            "file: a plain table needs a mapping that names its columns (--mapping columns.yaml)");
}

TEST(Table, TimeIsLinearInItsTrials) {
  ImportOptions options;
  options.mapping = WriteText("mapping.yaml", kMapping);
  const TableMapping mapping = LoadTableMapping(options.mapping);
  const auto make_table = [](int num_trials) {
    std::string table = "n;t;a;b;c;o\n";
    for (int row = 0; row < 4 * num_trials; ++row) {
      table += fmt::format("{};{};1;2;3;0\n", row / 4 + 1, 10 * (row % 4));
    }
    return table;
  };
  for (const int num_trials : {10'000, 40'000}) {
    WriteText("table_" + std::to_string(num_trials), make_table(num_trials));
  }
  EXPECT_LT(FindTimeRatio([&](int num_trials) {
              const std::filesystem::path path = testing::TempDir();
              const auto trials =
                  FindTableTrials(path / ("table_" + std::to_string(num_trials)), mapping);
              EXPECT_EQ(trials.size(), static_cast<size_t>(num_trials));
            }),
            8.0);
  EXPECT_LT(FindTimeRatio([&](int num_trials) {
              options.trial = std::to_string(num_trials);
              EXPECT_EQ(ImportBytes(make_table(num_trials), "table", options).num_frames, 4u);
            }),
            8.0);
}

TEST(Table, ANumberThatIsNoPlaceIsMissingAndCounted) {
  ImportOptions options;
  options.mapping = WriteText("mapping.yaml", kMapping);
  options.trial = "1";
  std::string table = kTable;
  table.replace(table.find("1;20;1;"), 7, "1;20;1e300;");
  const Recording read = ImportBytes(table, "table", options);
  EXPECT_EQ(read.points[0].states[0], SampleState::kMeasured);
  EXPECT_EQ(read.points[0].states[2], SampleState::kInvalid);
  EXPECT_EQ(CountFindings(read, "huge_coordinates"), 1u);
}

TEST(Table, AWrongMappingTellsAllItsFaults) {
  try {
    LoadTableMapping(WriteText(
        "bad.yaml", "points:\n  tip: [a, b]\ntime_unit: h\nextra: 1\nchannels: {f: [a, b]}\n"));
    FAIL();
  } catch (const Error& error) {
    const std::string text = error.what();
    for (const char* part :
         {"needs the three columns", "each needs the name of one column",
          "is \"h\"; expected s, ms or us", "rate_hz: is needed when no column of times",
          "unknown key \"extra\""}) {
      EXPECT_NE(text.find(part), std::string::npos) << text;
    }
  }
}

TEST(Table, WithoutAHeadingColumnsAreNumbered) {
  ImportOptions options;
  options.mapping = WriteText("bare.yaml",
                              "unit: mm\nheading: false\npoints:\n  tip: [2, 3, 4]\ntime: 1\n"
                              "channels: {touch: 5}\n");
  // Tabs, semicolons, commas and runs of blanks hold the same.
  for (const char* rows : {"0\t1\t2\t3\t0\n0.01\t1\t2\t4\t1\n", "0;1;2;3;0\n0.01;1;2;4;1\n",
                           "0,1,2,3,0\n0.01,1,2,4,1\n", "  0 1  2 3   0\n 0.01 1 2  4 1 \n"}) {
    const Recording read = ImportBytes(rows, "table", options);
    ASSERT_EQ(read.num_frames, 2u) << rows;
    EXPECT_NEAR(read.points[0].Position(1).z(), 0.004, 1e-12) << rows;
    EXPECT_NEAR(read.rate, 100.0, 1e-9);
    ASSERT_EQ(read.analog.size(), 1u);
    EXPECT_EQ(read.analog[0].label, "touch");
    EXPECT_EQ(read.analog[0].rate, read.rate);
    EXPECT_EQ(read.analog[0].samples, (std::vector<float>{0.0f, 1.0f}));
  }
  EXPECT_EQ(ImportFault("t;x;y;z;f\n0;1;2;3;0\n", "table", options),
            "file:1: the first row has no number, but the mapping says heading: false; take that "
            "out and name the columns");
  EXPECT_EQ(ImportFault("0;1;2\n", "table", options),
            "file:1: the mapping names columns the table does not have: 4, 5; did you mean \"1\"? "
            "Known: 1, 2, 3");
  EXPECT_EQ(ImportFault("", "table", options), "file:1: the file ends before its first row");
  EXPECT_EQ(ImportFault("0;1;2;3;0\n0.01;1;2;3;0\n0.03;1;2;3;0\n0.04;1;2;3;0\n", "table", options),
            "file: its times are uneven, so that its channels have no rate; take them out of the "
            "mapping, or export the table at an even rate");
  // A decimal comma is no delimiter of this table's.
  EXPECT_EQ(
      ImportFault("0,0;1,5;2;3;0\n", "table", options),
      "file:1: column 2: \"1,5\" is not a number: it has a decimal comma; export with points");
  options.mapping = WriteText("mapping.yaml", kMapping);
  EXPECT_EQ(ImportFault("1;0;1;2;3;0\n", "table", options),
            "file:1: the first row holds numbers, not the names of columns (a, b, c, t, n, o); for "
            "a table without a heading the mapping says heading: false and numbers the columns "
            "from 1");
}

/** Rows of 21 landmarks; `place` gives x, y, z of one. */
template <class Place>
std::string MakeLandmarks(const Place& place) {
  std::string text = "time_s";
  for (int i = 0; i < 21; ++i) {
    for (const char* axis : {"x", "y", "z"}) text += "," + (axis + std::to_string(i));
  }
  for (int row = 0; row < 3; ++row) {
    text += "\n" + std::to_string(0.05 * row);
    for (int i = 0; i < 21; ++i) {
      for (const double value : place(row, i)) text += "," + std::to_string(value);
    }
  }
  return text + "\n";
}

TEST(Table, TheShippedMappingReadsMediaPipesLandmarksAndRefusesThoseOfAnImage) {
  ImportOptions options;
  options.mapping = FindDataRoot() / "human_study/examples/mediapipe/columns.yaml";
  const auto in_space = [](int row, int i) {
    return std::array<double, 3>{0.01 * i, 0.1 * row, 0.6 - 0.01 * i};
  };
  const Recording read = ImportBytes(MakeLandmarks(in_space), "table", options);
  EXPECT_NEAR(read.rate, 20.0, 1e-6);
  ASSERT_EQ(read.points.size(), 21u);
  EXPECT_NEAR((read.FindPoint("little_tip").Position(2) - Eigen::Vector3d(0.2, 0.2, 0.4)).norm(),
              0.0, 1e-6);
  EXPECT_NEAR(read.FindPoint("thumb_tip").Position(0).x(), 0.04, 1e-6);
  // Shares of the picture; the wrist's depth is 0 by definition.
  const auto in_image = [](int row, int i) {
    return std::array<double, 3>{0.3 + 0.01 * i, 0.5 + 0.05 * row, -0.005 * i};
  };
  EXPECT_EQ(ImportFault(MakeLandmarks(in_image), "table", options),
            "file: these are landmarks of an image (the wrist's z is 0 in every row, x and y lie "
            "within a picture): shares of its width, not lengths. Place them by a depth camera or "
            "by two cameras first");
  // A hand that nobody saw is no picture.
  std::string unseen = "time_s,x,y,z,u,v,w";
  for (int row = 0; row < 3; ++row) {
    unseen += "\n" + std::to_string(0.05 * row) + ",nan,nan,nan,0.1,0.2,0.3";
  }
  options.mapping = WriteText("unseen.yaml",
                              "unit: m\ntime: time_s\npoints:\n  wrist: [x, y, z]\n"
                              "  tip: [u, v, w]\n");
  EXPECT_EQ(ImportBytes(unseen + "\n", "table", options).num_frames, 3u);
}

TEST(Table, TheShippedMappingReadsLeapHands) {
  ImportOptions options;
  options.mapping = FindDataRoot() / "human_study/examples/leap/columns.yaml";
  const TableMapping mapping = LoadTableMapping(options.mapping);
  std::string head = "timestamp", rows[2] = {"1000000", "1010000"};
  int place = 0;
  for (const TableMapping::Point& point : mapping.points) {
    for (const std::string& column : point.columns) {
      head += "," + column;
      for (int row = 0; row < 2; ++row) rows[row] += "," + std::to_string(100 + place + 5 * row);
      ++place;
    }
  }
  const Recording read =
      ImportBytes(head + "\n" + rows[0] + "\n" + rows[1] + "\n", "table", options);
  EXPECT_NEAR(read.rate, 100.0, 1e-6);  // microseconds
  ASSERT_EQ(read.points.size(), 12u);
  EXPECT_NEAR((read.FindPoint("wrist").Position(1) - Eigen::Vector3d(0.105, 0.106, 0.107)).norm(),
              0.0, 1e-6);
  EXPECT_NO_THROW(read.FindPoint("little_tip"));
}

TEST(Table, TheShippedMappingMakesTipsOfAGlovesAngles) {
  ImportOptions options;
  options.mapping = FindDataRoot() / "human_study/examples/glove/columns.yaml";
  const std::vector<std::string> columns = LoadTableMapping(options.mapping).glove.ListColumns();
  std::string head = "time_s";
  for (const std::string& column : columns) head += "," + column;
  std::string text = head + "\n";
  for (int row = 0; row < 3; ++row) {
    text += std::to_string(0.01 * row);
    for (size_t i = 0; i + 7 < columns.size(); ++i) text += row == 1 ? ",30" : ",0";
    text += row == 2 ? ",1,2,3,,0,0,1\n" : ",1,2,3,0,0,0,1\n";
  }
  const Recording read = ImportBytes(text, "table", options);
  ASSERT_EQ(read.points.size(), 6u);
  EXPECT_NEAR((read.FindPoint("wrist").Position(0) - Eigen::Vector3d(1, 2, 3)).norm(), 0.0, 1e-6);
  // Bent fingers bring the tips nearer to the wrist; a missing cell is a missing point.
  const RecordedPoint& tip = read.FindPoint("index_tip");
  const RecordedPoint& wrist = read.FindPoint("wrist");
  EXPECT_LT((tip.Position(1) - wrist.Position(1)).norm(),
            (tip.Position(0) - wrist.Position(0)).norm() - 0.01);
  EXPECT_EQ(tip.states[2], SampleState::kInvalid);
  EXPECT_EQ(read.findings.front().code, "glove_model");
}

std::string N3d(int num_frames, int num_values = 3) {
  std::string bytes(256, '\0');
  bytes[0] = 32;
  bytes[1] = 2;
  bytes[3] = static_cast<char>(num_values);
  bytes[5] = static_cast<char>(num_frames);
  std::string rate;
  AppendC3dFloat(rate, C3dProcessor::kIntel, 70.0f);
  bytes.replace(9, 4, rate);
  bytes.replace(100, 8, "03/06/17");
  for (int i = 0; i < 2 * 6; ++i) {
    AppendC3dFloat(bytes, C3dProcessor::kIntel, i == 4 ? -3.697314e28f : static_cast<float>(i + 1));
  }
  return bytes;
}

TEST(N3d, MissingIsAHugeNegativeNumber) {
  const Recording read = ImportBytes(N3d(2), "n3d");
  EXPECT_EQ(read.rate, 70.0);
  EXPECT_EQ(read.points[1].states[0], SampleState::kInvalid);
  EXPECT_NEAR(read.points[1].Position(1).z(), 0.012, 1e-9);
  std::string bytes = N3d(2);
  EXPECT_EQ(FindImporter("n3d", "", "").redact(bytes, "file").at(0).text, "03/06/17");
  EXPECT_EQ(ImportBytes(bytes, "n3d").num_frames, 2u);
}

TEST(N3d, FaultsNameTheirByte) {
  EXPECT_EQ(ImportFault(N3d(3), "n3d"),
            "file: byte 304: the header promises 3 frames, the file holds 2; it is cut off or its "
            "count is wrong (--accept-truncated reads what is there)");
  EXPECT_EQ(ImportFault(N3d(2, 1), "n3d"),
            "file: byte 3: each item has 1 values; only positions (3 values) can be read");
  EXPECT_EQ(ImportFault("short", "n3d"),
            "file: byte 5: the file ends here; an N3D header alone has 256 bytes");
}

TEST(FindImporter, Utf16IsSaid) {
  using namespace std::string_literals;
  try {
    FindImporter("", "\xff\xfeN\0O\0"s, "take.tsv");
    FAIL();
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "take.tsv: is UTF-16 (\"Unicode text\" of a spreadsheet); no format of motion "
                 "capture is: save it as UTF-8, or export it again");
  }
}

TEST(FindImporter, ContentDecidesThenTheName) {
  EXPECT_STREQ(FindImporter("", kQualisysHead, "x.txt").id, "qualisys_tsv");
  EXPECT_STREQ(FindImporter("", Trc(','), "x").id, "trc");
  EXPECT_STREQ(FindImporter("", kMotive, "x.csv").id, "motive_csv");
  EXPECT_STREQ(FindImporter("", kNexus, "x.csv").id, "nexus_csv");
  EXPECT_STREQ(FindImporter("", N3d(2), "x").id, "n3d");
  EXPECT_STREQ(FindImporter("", FormatC3d(MakeSyntheticRecording(3, 1)), "x.csv").id, "c3d");
  EXPECT_STREQ(FindImporter("", "1\t2\n", "sub-1_task-g_tracksys-q_motion.tsv").id, "motion_bids");
  EXPECT_STREQ(FindImporter("", "", "EMPTY.C3D").id, "c3d");
  EXPECT_THROW(FindImporter("", "hello", "x.txt"), Error);
  EXPECT_THROW(FindImporter("c3", "", "x.c3d"), Error);
}

}  // namespace
}  // namespace graspbench
