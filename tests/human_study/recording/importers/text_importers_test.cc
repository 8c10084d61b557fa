#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "core/base/files/files.h"
#include "core/base/text/yaml.h"
#include "tests/human_study/faults.h"
#include "tests/human_study/recording/synthetic_recording.h"
#include "tests/support/shared_data.h"
#include "tests/support/transcript.h"

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

// Blanks for tabs: one for each, so that cells may be empty, or runs of them.
TEST(Trc, BlanksForTabs) {
  const std::string head =
      "PathFileType 4 (X/Y/Z) /home/anna/my take.trc\n"
      "DataRate CameraRate NumFrames NumMarkers Units\n100 100 2 2 mm\n";
  for (const char* rows :
       {"Frame# Time thumb   index  \n  X1 Y1 Z1 X2 Y2 Z2\n\n1 0.00 1 2 3    \n2 0.01 1 2 3 4 5 "
        "6\n",
        "Frame#  Time  thumb  index\n        X1 Y1 Z1  X2 Y2 Z2\n"
        "  1  0.00  1  2  3  nan nan nan\n  2  0.01  1  2  3   4   5   6\n"}) {
    const Recording read = ImportBytes(head + rows, "trc");
    ASSERT_EQ(read.points.size(), 2u) << rows;
    EXPECT_EQ(read.points[1].label, "index");
    EXPECT_EQ(read.num_frames, 2u);
    EXPECT_EQ(read.points[1].states[0], SampleState::kInvalid);
    EXPECT_NEAR(read.points[1].Position(1).z(), 0.006, 1e-9);
    EXPECT_EQ(read.rate, 100.0);
  }
  std::string bytes = head;
  const auto fields = FindImporter("trc", "", "").redact(bytes, "file");
  ASSERT_EQ(fields.size(), 1u);
  EXPECT_EQ(fields[0].text, "/home/anna/my take.trc");
}

// Lines that end in a carriage return alone.
TEST(Trc, MacLineEnds) {
  std::string bytes = Trc('\t');
  bytes.erase(std::remove(bytes.begin(), bytes.end(), '\r'), bytes.end());
  std::replace(bytes.begin(), bytes.end(), '\n', '\r');
  const auto path = std::filesystem::path(testing::TempDir()) / "mac.trc";
  WriteFile(path, bytes);
  const Recording read = LoadRecording(path);
  EXPECT_EQ(read.num_frames, 2u);
  EXPECT_EQ(CountFindings(read, "mac_line_ends"), 1u);
  const auto copy = path.parent_path() / "mac_redacted.trc";
  EXPECT_EQ(RedactRecording(path, copy).size(), 1u);
  EXPECT_EQ(ReadFile(copy).find('\n'), std::string::npos);
  EXPECT_EQ(LoadRecording(copy).num_frames, 2u);
}

// One recording as its makers' programs wrote it, in the layouts that newcomers have.
TEST(Strangers, LayoutsOfOneRecordingAgree) {
  const std::filesystem::path folder = FindSharedData() / "strangers" / "people";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  const Recording spaces = LoadRecording(folder / "spaces.trc");
  const Recording mac = LoadRecording(folder / "mac_cr.trc");
  const Recording motive = LoadRecording(folder / "motive_1.1.csv");
  ASSERT_EQ(spaces.num_frames, 519u);
  ASSERT_EQ(mac.num_frames, 519u);
  ASSERT_EQ(motive.num_frames, 519u);
  ASSERT_EQ(spaces.points.size(), 9u);
  for (size_t i = 0; i < spaces.points.size(); ++i) {
    for (const size_t frame : {0, 100, 518}) {
      const Eigen::Vector3d p = spaces.points[i].Position(frame);
      EXPECT_NEAR((mac.points[i].Position(frame) - p).norm(), 0.0, 1e-9);
      EXPECT_NEAR((motive.points[i].Position(frame) - p).norm(), 0.0, 1e-6);
    }
  }
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

// One first cell per row says what it is: the format of 2014, whose frames list what they saw.
const std::string kTagged =
    "comment,Optitrack Export of Anna\r\ninfo,version,1.1\r\ninfo,framecount,4\r\n"
    "info,rigidbodycount,1\r\nrigidbody,cup,1,1,0,0,0\r\nrighthanded\r\n"
    "frame,0,0.000000,0,2,0.1,0.2,0.3,1,thumb,0.4,0.5,0.6,2,index\r\n"
    "rigidbody,0,0.000000,cup,1,0,0\r\n"
    "frame,1,0.010000,1,1,0,0,0,0,0,0,1,0,0,0,1,0.1,0.2,0.4,1,thumb\r\n"
    "frame,2,0.020000,0,3,0.4,0.5,0.7,2,index,0.1,0.2,0.5,1,thumb,9,9,9,7,\r\n"
    "frame,3,0.030000,0,0\r\n";

TEST(MotiveCsv, TaggedRowsAreReadByTheirFrames) {
  EXPECT_STREQ(FindImporter("", kTagged, "x.csv").id, "motive_csv");
  const Recording read = ImportBytes(kTagged, "motive_csv");
  ASSERT_EQ(read.num_frames, 4u);
  ASSERT_EQ(read.points.size(), 3u);
  EXPECT_EQ(read.points[0].label, "thumb");
  EXPECT_EQ(read.points[1].label, "index");
  EXPECT_EQ(read.points[2].label, "unlabelled_7");
  EXPECT_NEAR(read.points[0].Position(1).z(), 0.4, 1e-7);  // behind a rigid body
  EXPECT_NEAR(read.points[1].Position(2).z(), 0.7, 1e-7);  // in another order
  EXPECT_EQ(read.points[1].states[1], SampleState::kInvalid);
  EXPECT_EQ(read.points[0].states[3], SampleState::kInvalid);
  EXPECT_NEAR(read.rate, 100.0, 1e-9);
  EXPECT_EQ(CountFindings(read, "unit_by_convention"), 1u);
  std::string bytes = kTagged;
  EXPECT_EQ(FindImporter("motive_csv", "", "").redact(bytes, "file").size(), 1u);
  EXPECT_EQ(bytes.find("Anna"), std::string::npos);
  EXPECT_EQ(ImportBytes(bytes, "motive_csv").num_frames, 4u);
}

// A new marker in every frame, as of reflections: no more than its own cells are kept of each.
TEST(MotiveCsv, MarkersThatPassAreLeftOut) {
  std::string text = "info,version,1.1\nrighthanded\n";
  for (int i = 0; i < 100; ++i) {
    const std::string n = std::to_string(i);
    text += "frame," + n + "," + std::to_string(0.01 * i) + ",0,2,1,2,3,1,tip,4,5,6," + n + ",\n";
  }
  const Recording read = ImportBytes(text, "motive_csv");
  ASSERT_EQ(read.points.size(), 1u);
  EXPECT_EQ(CountFindings(read, "passing_markers"), 1u);
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
    return FaultOf([&] { Import(); });
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
  ExpectHolds(bids.Fault(), "_motion.tsv:1: the row has 2 columns, expected 4");
}

/** The recordings of wrong_recordings.yaml, each with its own message. */
TEST(WrongRecordings, EachIsRefusedWithItsFault) {
  const std::filesystem::path path =
      FindDataRoot() / "tests/human_study/recording/wrong_recordings.yaml";
  Diagnostics problems;
  const YAML::Node file = LoadYaml(path, problems);
  ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  const std::filesystem::path mapping = std::filesystem::path(testing::TempDir()) / "wrong.yaml";
  for (const YAML::Node& wrong : file["cases"]) {
    const auto text = [&](const char* key) { return wrong[key].as<std::string>(""); };
    ImportOptions options;
    options.trial = text("trial");
    if (wrong["mapping"] || wrong["own"]) {
      WriteFileAtomically(mapping,
                          text("own") + file["mappings"][text("mapping")].as<std::string>(""));
      options.mapping = mapping;
    }
    const std::string fault = ImportFault(
        file["heads"][text("head")].as<std::string>("") + text("bytes"), text("format"), options);
    EXPECT_TRUE(MatchesLine(fault, text("fault"))) << fault << "\nfor " << text("fault");
  }
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
}

TEST(FindImporter, Utf16IsSaid) {
  using namespace std::string_literals;
  EXPECT_EQ(
      FaultOf([] { FindImporter("", "\xff\xfeN\0O\0"s, "take.tsv"); }),
      "take.tsv: is UTF-16 (\"Unicode text\" of a spreadsheet); no format of motion capture is: "
      "save it as UTF-8, or export it again");
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
