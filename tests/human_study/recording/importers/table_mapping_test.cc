#include "human_study/recording/importers/table_mapping.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/base/files/files.h"
#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "tests/human_study/recording/synthetic_recording.h"
#include "tests/support/processor_time.h"

namespace graspbench {
namespace {

GloveMapping MakeMapping() {
  GloveMapping mapping;
  mapping.hand = "shadow";
  mapping.joints = {{"FFJ3", "index_mcp"}, {"FFJ4", "index_abduction"}};
  mapping.base = {"x", "y", "z"};
  mapping.quaternion = {"qx", "qy", "qz", "qw"};
  return mapping;
}

/** Place of a digit's tip. */
Eigen::Vector3d FindTip(const GloveModel& model, const std::vector<Eigen::Vector3d>& points,
                        const std::string& label) {
  for (size_t i = 0; i < points.size(); ++i) {
    if (model.labels()[i] == label) return points[i];
  }
  ADD_FAILURE() << "no " << label;
  return {};
}

TEST(Glove, AJointTurnsItsTipAboutItsAxis) {
  const GloveModel model(MakeMapping());
  const Hand hand = LoadHand("shadow");
  const auto calc = [&](double angle) {
    return model.CalcPoints({angle, 0.0, 0, 0, 0, 0, 0, 0, 1}, 1.0);
  };
  const Eigen::Vector3d straight = FindTip(model, calc(0.0), "index_tip");
  const Eigen::Vector3d bent = FindTip(model, calc(90.0), "index_tip");
  // A quarter turn about the knuckle: chord = sqrt(2) times the distance from the axis.
  const int link = hand.joints[static_cast<size_t>(hand.FindJoint("FFJ3"))].link;
  const Pose X_HL = CalcLinkPose(hand, Eigen::VectorXd::Zero(hand.num_joints()), link);
  const Eigen::Vector3d axis = X_HL.linear() * hand.links[static_cast<size_t>(link)].axis;
  const Eigen::Vector3d arm = straight - X_HL.translation();
  const double radius = (arm - axis * axis.dot(arm)).norm();
  EXPECT_NEAR((bent - straight).norm(), std::sqrt(2.0) * radius, 1e-9);
  EXPECT_GT(radius, 0.05);
  // No other digit moves.
  EXPECT_NEAR(
      (FindTip(model, calc(90.0), "middle_tip") - FindTip(model, calc(0.0), "middle_tip")).norm(),
      0.0, 1e-12);
}

TEST(Glove, TheTrackersPoseCarriesTheHand) {
  const GloveModel model(MakeMapping());
  const auto at_home = model.CalcPoints({20, 5, 0, 0, 0, 0, 0, 0, 1}, 1.0);
  const double half = std::sqrt(0.5);  // a quarter turn about z; lengths in millimetres
  const auto moved = model.CalcPoints({20, 5, 100, 200, 300, 0, 0, half, half}, 0.001);
  ASSERT_EQ(at_home.size(), moved.size());
  for (size_t i = 0; i < moved.size(); ++i) {
    const Eigen::Vector3d& p = at_home[i];
    const Eigen::Vector3d expected(100 - 1000 * p.y(), 200 + 1000 * p.x(), 300 + 1000 * p.z());
    EXPECT_NEAR((moved[i] - expected).norm(), 0.0, 1e-9);
  }
  EXPECT_EQ(model.labels().back(), "wrist");
}

TEST(Glove, MissingAnglesAndNoQuaternionAreMissingPoints) {
  const GloveModel model(MakeMapping());
  EXPECT_TRUE(model.CalcPoints({NAN, 0, 0, 0, 0, 0, 0, 0, 1}, 1.0).empty());
  EXPECT_TRUE(model.CalcPoints({0, 0, 0, 0, 0, 0, 0, 0, 0}, 1.0).empty());
}

TEST(Glove, AJointThatTheModelLacksIsNamed) {
  GloveMapping mapping = MakeMapping();
  mapping.joints[0].first = "FFJ9";
  ExpectHolds(FaultOf([&] { const GloveModel model(mapping); }), "has no joint \"FFJ9\"");
}

std::filesystem::path WriteText(const std::string& name, const std::string& text) {
  const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / name;
  WriteFileAtomically(path, text);
  return path;
}

Recording Import(const std::string& bytes, const std::string& mapping) {
  ImportOptions options;
  options.mapping = WriteText("layout.yaml", mapping);
  return ImportBytes(bytes, "table", options);
}

// As DeepLabCut's triangulate(save_as_csv=True) writes: three heading rows, the frame first.
const std::string kDeepLabCut =
    "scorer,DLC_3D,DLC_3D,DLC_3D,DLC_3D,DLC_3D,DLC_3D\n"
    "bodyparts,thumb,thumb,thumb,index,index,index\n"
    "coords,x,y,z,x,y,z\n"
    "0,1.0,2.0,3.0,4.0,5.0,6.0\n"
    "1,1.1,2.0,3.0,,,\n"
    "2,1.2,2.0,3.0,4.2,5.0,6.0\n";
const std::string kDeepLabCutMapping = "layout: deeplabcut\nunit: mm\nscale: 25\nrate_hz: 100\n";

TEST(DeepLabCut, CountsInSquaresOfItsBoard) {
  const Recording read = Import(kDeepLabCut, kDeepLabCutMapping);
  ASSERT_EQ(read.points.size(), 2u);
  EXPECT_EQ(read.points[0].label, "thumb");
  EXPECT_EQ(read.points[1].label, "index");
  EXPECT_EQ(read.num_frames, 3u);
  EXPECT_EQ(read.rate, 100.0);
  EXPECT_NEAR((read.points[0].Position(1) - Eigen::Vector3d(0.0275, 0.05, 0.075)).norm(), 0, 1e-7);
  EXPECT_EQ(read.points[1].states[1], SampleState::kInvalid);
  EXPECT_EQ(read.points[0].unit, "mm");
}

TEST(DeepLabCut, SeveralIndividualsKeepTheirNames) {
  const Recording read = Import(
      "scorer,s,s,s,s,s,s\nindividuals,left,left,left,right,right,right\n"
      "bodyparts,tip,tip,tip,tip,tip,tip\ncoords,x,y,z,x,y,z\n0,1,2,3,4,5,6\n1,1,2,3,4,5,6\n",
      "layout: deeplabcut\nunit: cm\nscale: 1\nrate_hz: 50\n");
  ASSERT_EQ(read.points.size(), 2u);
  EXPECT_EQ(read.points[1].label, "right:tip");
  EXPECT_NEAR(read.points[1].Position(0).z(), 0.06, 1e-8);
}

// As FreeMoCap's mediapipe_right_hand_3d_xyz.csv: one heading row, no times, empty where not seen.
const std::string kFreeMoCap =
    "right_hand_wrist_x,right_hand_wrist_y,right_hand_wrist_z,right_hand_thumb_tip_x,"
    "right_hand_thumb_tip_y,right_hand_thumb_tip_z\n"
    "100.5,200.0,300.0,150.0,210.0,320.0\n"
    ",,,151.0,210.0,320.0\n";

TEST(FreeMoCap, NamesItsPointsByTheirColumns) {
  const Recording read = Import(kFreeMoCap, "layout: freemocap\nunit: mm\nrate_hz: 30\n");
  ASSERT_EQ(read.points.size(), 2u);
  EXPECT_EQ(read.points[1].label, "right_hand_thumb_tip");
  EXPECT_NEAR(read.points[1].Position(1).x(), 0.151, 1e-8);
  EXPECT_EQ(read.points[0].states[1], SampleState::kInvalid);
  EXPECT_EQ(read.rate, 30.0);
}

TEST(TableLayouts, TheShippedMappingsReadThem) {
  ImportOptions options;
  options.mapping = FindDataRoot() / "human_study/examples/deeplabcut/columns.yaml";
  EXPECT_NEAR(ImportBytes(kDeepLabCut, "table", options).points[0].Position(0).z(), 0.075, 1e-7);
  options.mapping = FindDataRoot() / "human_study/examples/freemocap/columns.yaml";
  EXPECT_EQ(ImportBytes(kFreeMoCap, "table", options).rate, 30.0);
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
  const std::filesystem::path path = WriteText("table.csv", kTable);
  const std::vector<TableTrial> trials = FindTableTrials(path, LoadTableMapping(options.mapping));
  ASSERT_EQ(trials.size(), 2u);
  EXPECT_EQ(trials[0].name, "1");
  EXPECT_EQ(trials[1].name, "2");
  for (const TableTrial& trial : trials) {  // by its rows it is the same
    options.trial = trial.name;
    options.rows.reset();
    const Recording whole = ImportBytes(kTable, "table", options);
    options.rows = trial.rows;
    const Recording rows = ImportBytes(kTable, "table", options);
    EXPECT_EQ(rows.num_frames, whole.num_frames);
    EXPECT_EQ(testing::PrintToString(rows.points[0].xyz),  // with what is not a number
              testing::PrintToString(whole.points[0].xyz));
    EXPECT_EQ(rows.times, whole.times);
    EXPECT_EQ(rows.findings.size(), whole.findings.size());
  }
}

// Rows of trials may stand between each other, and a faulty row is named by its line.
TEST(Table, ATrialIsReadByItsRows) {
  ImportOptions options;
  options.mapping = WriteText("mapping.yaml", kMapping);
  const std::string table =
      "n;t;a;b;c;o\n1;0;1;2;3;0\n2;0;4;5;6;0\n1;10;7;8;9;0\n2;10;1;1;1;0\n2;20;x;1;1;0\n";
  const auto trials =
      FindTableTrials(WriteText("mixed.csv", table), LoadTableMapping(options.mapping));
  ASSERT_EQ(trials.size(), 2u);
  EXPECT_EQ(trials[1].rows.first_line, 3);
  EXPECT_EQ(trials[1].rows.last_line, 6);
  options.trial = "1";
  options.rows = trials[0].rows;
  const Recording first = ImportBytes(table, "table", options);
  EXPECT_EQ(first.num_frames, 2u);
  EXPECT_EQ(first.points[0].xyz[3], 7.0f);
  options.trial = "2";
  options.rows = trials[1].rows;
  try {
    ImportBytes(table, "table", options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(":6: "), std::string::npos) << error.what();
  }
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

std::string Propose(const std::string& bytes) {
  return ProposeMapping(WriteText("proposed.csv", bytes));
}

// What is proposed reads the table, and what the table does not say is marked.
TEST(ProposedMapping, ReadsTheTableItIsFor) {
  struct Case {
    const char* name;
    std::string bytes, label, line;
  };
  const std::vector<Case> cases = {
      {"suffix", "frame,time_ms,thumb_x_mm,thumb_y_mm,thumb_z_mm\n0,0,1,2,3\n1,5,1,2,4\n", "thumb",
       "unit: mm\n"},
      {"middle", "globalTime;indexXraw;indexYraw;indexZraw\n0;10;200;300\n10;10;200;310\n",
       "index_raw", "# check: not stated; the times go on by 10"},
      {"blank", "Time (s)\tthumb X\tthumb Y\tthumb Z\n0\t0.1\t0.2\t0.3\n0.01\t0.1\t0.2\t0.3\n",
       "thumb", "time_unit: s\n"},
      {"no times", "thumb.x,thumb.y,thumb.z\n1,2,3\n1,2,4\n", "thumb",
       "rate_hz: 100            # check"},
      {"numbers", "0.00 0.1 0.2 0.3 0.4 0.5 0.6\n0.01 0.1 0.2 0.3 0.4 0.5 0.6\n", "point_2",
       "heading: false"}};
  for (const Case& one : cases) {
    const std::string mapping = Propose(one.bytes);
    EXPECT_NE(mapping.find(one.line), std::string::npos) << one.name << "\n" << mapping;
    const Recording read = Import(one.bytes, mapping);
    EXPECT_EQ(read.num_frames, 2u) << one.name;
    EXPECT_TRUE(read.FindPoint(one.label).IsLength()) << one.name;
  }
  EXPECT_NE(Propose(kDeepLabCut).find("layout: deeplabcut"), std::string::npos);
  EXPECT_NE(Propose("t,ring_x,ring_y,ring_z\n0,1,2,3\n1,1,2,3\n").find("#     ring: [ring]"),
            std::string::npos);
}

TEST(ProposedMapping, WithoutPointsTheColumnsAreListed) {
  ExpectHolds(FaultOf([] { Propose("time,force\n0,1\n1,2\n"); }),
              "no three columns differ by x, y and z alone, so none is proposed as a point");
  ExpectHolds(FaultOf([] { Propose("NO_OF_FRAMES\t3\n"); }),
              "is read as Qualisys TSV without a mapping");
}

// One mapping for a study with files of several programs: it is for those that show no format.
TEST(Table, AMappingLeavesOtherFormatsAlone) {
  ImportOptions options;
  options.mapping = WriteText("columns.yaml", "unit: mm\ntime: t\npoints: {tip: [a, b, c]}\n");
  const std::string table = "t,a,b,c\n0,1,2,3\n0.01,1,2,3\n";
  EXPECT_EQ(LoadRecording(WriteText("one.csv", table), options).format, "table");
  const std::string qualisys =
      "NO_OF_FRAMES\t2\nNO_OF_MARKERS\t1\nFREQUENCY\t100\nDATA_INCLUDED\t3D\nMARKER_NAMES\ttip\n"
      "1\t2\t3\n1\t2\t3\n";
  EXPECT_EQ(LoadRecording(WriteText("two.tsv", qualisys), options).format, "qualisys_tsv");
  // A heading that has the mapping's columns is the mapping's, whatever else it looks like.
  options.mapping = WriteText(
      "columns.yaml",
      "unit: mm\ntime: time_sec\npoints: {tip: [A_position_x, A_position_y, A_position_z]}\n");
  EXPECT_EQ(LoadRecording(WriteText("three.csv",
                                    "frame,time_sec,A_position_x,A_position_y,A_position_z\n"
                                    "0,0,1,2,3\n1,0.01,1,2,3\n"),
                          options)
                .format,
            "table");
}

}  // namespace
}  // namespace graspbench
