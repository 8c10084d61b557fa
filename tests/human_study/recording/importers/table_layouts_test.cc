#include "human_study/recording/importers/table_layouts.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "human_study/recording/importers/importer.h"

namespace graspbench {
namespace {

std::filesystem::path WriteMapping(const std::string& text) {
  const auto path = std::filesystem::path(testing::TempDir()) /
                    (std::string("layout_") +
                     testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml");
  std::ofstream(path) << text;
  return path;
}

Recording Import(const std::string& bytes, const std::string& mapping) {
  ImportOptions options;
  options.mapping = WriteMapping(mapping);
  std::istringstream stream(bytes);
  return ImportRecording(FindImporter("table", "", ""), {stream, "file", {}}, options);
}

std::string FaultOf(const std::string& bytes, const std::string& mapping) {
  try {
    Import(bytes, mapping);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
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

TEST(DeepLabCut, WhatIsNotOfTheLayoutIsRefused) {
  EXPECT_EQ(FaultOf("scorer,a,a,a\nbodyparts,tip,tip,tip\ncoords,x,y,likelihood\n0,1,2,0.9\n",
                    kDeepLabCutMapping),
            "file:3: these are places in a picture (x and y, no z): triangulate them first, and "
            "read the 3-D table");
  EXPECT_EQ(FaultOf("frame,x,y,z\n0,1,2,3\n", kDeepLabCutMapping),
            "file:1: the heading row begins with \"frame\"; DeepLabCut writes \"scorer\" here "
            "(layout: deeplabcut)");
  EXPECT_EQ(FaultOf("scorer,a,a,a\n1,2,3,4\n", kDeepLabCutMapping),
            "file:2: the second row begins with \"1\"; DeepLabCut writes \"bodyparts\" there, or "
            "\"individuals\"");
  EXPECT_EQ(FaultOf("scorer,a,a,a\nbodyparts,tip,tip\ncoords,x,y,z\n", kDeepLabCutMapping),
            "file:3: its heading rows have 3 and 4 cells; expected as many in each");
  EXPECT_EQ(FaultOf("scorer,a,a,a\n", kDeepLabCutMapping),
            "file:2: the file ends before the heading row \"bodyparts\"");
  EXPECT_EQ(FaultOf("scorer,a,a,a,a,a,a\nbodyparts,t,t,t,t,t,t\ncoords,x,y,z,x,y,z\n",
                    kDeepLabCutMapping),
            "file:3: the point \"t\" is there twice");
  EXPECT_NE(FaultOf("scorer,a,a,a\nbodyparts,t,t,t\ncoords,x,y,z\n0,1,2\n", kDeepLabCutMapping)
                .find("the row has 3 columns, expected 4"),
            std::string::npos);
}

// A length in squares must not be taken for millimetres.
TEST(DeepLabCut, ALengthOfWhichNobodySaysTheScaleIsRefused) {
  const std::string fault = FaultOf(kDeepLabCut, "layout: deeplabcut\nunit: mm\nrate_hz: 100\n");
  EXPECT_NE(fault.find("scale: is missing: DeepLabCut counts lengths in squares of its "
                       "checkerboard; say how long one is"),
            std::string::npos)
      << fault;
  EXPECT_NE(FaultOf(kDeepLabCut, "layout: deeplabcut\nunit: mm\nscale: -1\nrate_hz: 100\n")
                .find("is no positive number"),
            std::string::npos);
  EXPECT_NE(FaultOf(kDeepLabCut, "layout: deeplabcat\nunit: mm\nscale: 1\nrate_hz: 100\n")
                .find("layout: \"deeplabcat\" is not known; did you mean \"deeplabcut\"?"),
            std::string::npos);
  EXPECT_NE(
      FaultOf(kDeepLabCut, "layout: deeplabcut\nunit: mm\nscale: 25\n").find("rate_hz: is needed"),
      std::string::npos);
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
  std::istringstream squares(kDeepLabCut);
  EXPECT_NEAR(ImportRecording(FindImporter("table", "", ""), {squares, "file", {}}, options)
                  .points[0]
                  .Position(0)
                  .z(),
              0.075, 1e-7);
  options.mapping = FindDataRoot() / "human_study/examples/freemocap/columns.yaml";
  std::istringstream hand(kFreeMoCap);
  EXPECT_EQ(ImportRecording(FindImporter("table", "", ""), {hand, "file", {}}, options).rate, 30.0);
}

TEST(FreeMoCap, WhatIsNotOfTheLayoutIsRefused) {
  const std::string mapping = "layout: freemocap\nunit: mm\nrate_hz: 30\n";
  EXPECT_EQ(FaultOf("frame,a,b\n1,2,3\n", mapping),
            "file:1: no three columns NAME_x, NAME_y, NAME_z are there");
  EXPECT_EQ(FaultOf("wrist_x,wrist_y,wrist_visibility\n1,2,3\n", mapping),
            "file:1: these are places in a picture (x and y, no z): triangulate them first, and "
            "read the 3-D table");
  EXPECT_EQ(FaultOf("", mapping), "file:1: the file ends before the names of its columns");
  EXPECT_NE(FaultOf("a_x,a_y,a_z\n1,2,far\n", mapping).find("\"far\" is not a number"),
            std::string::npos);
}

}  // namespace
}  // namespace graspbench
