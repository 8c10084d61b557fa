#include <gtest/gtest.h>

#include <algorithm>

#include "core/base/units.h"
#include "core/hand/import/read_foreign_urdf.h"
#include "core/hand/load_hand.h"
#include "tests/core/hand/import/small_claw.h"
#include "tests/core/hand/text_cases.h"

namespace graspbench {
namespace {

ForeignHand Read(const std::string& text, Diagnostics& problems) {
  return ReadForeignMjcf(text, "claw.xml", "no-such-folder", problems);
}

const ForeignLink& LinkOf(const ForeignHand& hand, const std::string& name) {
  return *std::find_if(hand.links.begin(), hand.links.end(),
                       [&](const ForeignLink& link) { return link.name == name; });
}

TEST(ReadForeignMjcfTest, TellsWhatItRepairs) {
  Diagnostics problems;
  const ForeignHand hand = Read(kSmallClaw, problems);
  EXPECT_EQ(
      problems.Format(),
      "claw.xml:22: warning: shapes of the world belong to the scene; left out\n"
      "claw.xml:23: warning: body \"cube\": no joint moves below it: a part of the scene; left "
      "out\n"
      "claw.xml:28: warning: body \"palm\": a joint of type \"free\" is fixed: the arm of an "
      "experiment carries the hand\n"
      "claw.xml:45: warning: joint \"MFJ3\": its zero is its place in the file, which MuJoCo calls "
      "5.0 deg\n"
      "claw.xml:82: warning: actuator \"A_FFJ0\" moves several joints: \"FFJ1\" follows \"FFJ2\" "
      "by the hand's coupling rule\n"
      "claw.xml: warning: no actuator moves \"THJ1\", and no other joint; each gets a drive of its "
      "own, as no joint is loose here");
  EXPECT_EQ(hand.name, "small claw");
  EXPECT_EQ(hand.links.size(), 12u);  // world, palm, one more for the body with two joints
  EXPECT_EQ(hand.joints.size(), 11u);
  const auto middle = std::find_if(hand.joints.begin(), hand.joints.end(),
                                   [](const ForeignJoint& j) { return j.name == "MFJ3"; });
  EXPECT_NEAR(middle->lower, 0.0, 1e-12);  // 5 to 95 deg, at 5 in the file
  EXPECT_NEAR(middle->upper, RadFromDeg(90.0), 1e-12);
}

// The user's word is not doubted.
TEST(ReadForeignMjcfTest, AnglesOfAnotherUnitAreTold) {
  const std::string text = ReplaceOnce(kSmallClaw, "angle=\"degree\"", "angle=\"radian\"");
  Diagnostics problems;
  Read(text, problems);
  EXPECT_NE(problems.Format().find("go beyond one turn, up to 95; taken as radians"),
            std::string::npos)
      << problems.Format();
  Diagnostics told;
  ReadForeignMjcf(text, "claw.xml", "no-such-folder", told, false);
  EXPECT_EQ(told.Format().find("--angle"), std::string::npos) << told.Format();
}

TEST(ReadForeignMjcfTest, ShapesHaveTheirWholeExtent) {
  Diagnostics problems;
  const std::string text = ReplaceOnce(
      kSmallClaw, "<geom name=\"palm\" ",
      "<geom type=\"sphere\" size=\"0.01\"/><geom type=\"ellipsoid\" size=\"0.01 0.02 0.03\"/>"
      "<geom type=\"cylinder\" size=\"0.01 0.02\"/><geom size=\"0.01 0.02\"/>"
      "<geom type=\"box\" size=\"0.01\" fromto=\"0 0 0 0 0.05 0\"/><geom name=\"palm\" ");
  const ForeignLink palm = LinkOf(Read(text, problems), "palm");
  const Eigen::Vector3d sizes[] = {{0.02, 0.02, 0.02}, {0.02, 0.04, 0.06}, {0.02, 0.02, 0.04},
                                   {0.02, 0.02, 0.06}, {0.02, 0.02, 0.05}, {0.08, 0.024, 0.08}};
  ASSERT_EQ(palm.collisions.size(), std::size(sizes));
  for (size_t i = 0; i < std::size(sizes); ++i) {
    EXPECT_LT((palm.collisions[i].size - sizes[i]).norm(), 1e-15) << i;
  }
  EXPECT_TRUE(palm.visuals.empty());  // group 3
}

TEST(ReadForeignMjcfTest, PicturesAndWhatTouches) {
  Diagnostics problems;
  const std::string asset =
      "<asset><material name=\"red\" rgba=\"1 0 0 1\"/><mesh file=\"sub/tip.stl\"/></asset>"
      "<worldbody>";
  std::string text = ReplaceOnce(kSmallClaw, "<worldbody>", asset);
  text = ReplaceOnce(text, "angle=\"degree\"", "angle=\"degree\" meshdir=\"../meshes/\"");
  text =
      ReplaceOnce(text, "<geom name=\"palm\" ",
                  "<geom type=\"mesh\" mesh=\"tip\" material=\"red\" contype=\"0\" "
                  "conaffinity=\"0\" group=\"2\"/>"
                  "<geom type=\"box\" size=\"1 1 1\" contype=\"0\" conaffinity=\"0\"/>"
                  "<geom type=\"box\" size=\"0.02 0.02 0.02\" group=\"0\"/><geom name=\"palm\" ");
  text =
      ReplaceOnce(text, "<geom name=\"ff_proximal\" ", "<geom name=\"ff_proximal\" group=\"1\" ");
  const ForeignHand hand = Read(text, problems);
  const ForeignLink &palm = LinkOf(hand, "palm"), &finger = LinkOf(hand, "ff_proximal");
  // A picture apart: what touches is not shown; nor what neither touches nor is in a shown group.
  EXPECT_EQ(palm.collisions.size(), 2u);
  ASSERT_EQ(palm.visuals.size(), 1u);
  EXPECT_EQ(palm.visuals[0].mesh, "../meshes/sub/tip.stl");
  EXPECT_EQ(*palm.visuals[0].colour, Eigen::Vector3d(1.0, 0.0, 0.0));
  EXPECT_EQ(finger.visuals.size(), 1u);
  EXPECT_EQ(finger.collisions.size(), 1u);
}

TEST(ReadForeignMjcfTest, FramesMoveWhatIsInThem) {
  Diagnostics problems;
  const std::string text = ReplaceOnce(
      kSmallClaw, "<geom name=\"palm\" ",
      "<frame pos=\"0 0 0.1\" axisangle=\"0 0 1 90\"><geom type=\"sphere\" size=\"0.01\" "
      "pos=\"0.02 0 0\"/></frame><geom name=\"palm\" ");
  const ForeignLink palm = LinkOf(Read(text, problems), "palm");
  EXPECT_LT((palm.collisions[0].X_LS.translation() - Eigen::Vector3d(0.0, 0.02, 0.1)).norm(),
            1e-15);
}

TEST(ReadForeignMjcfTest, TellsWhatItRepairsAndWhatItCannot) {
  for (const TextCase& odd : ReadTextCases(IMPORT_TEST_DATA_DIR "/odd_mjcf.yaml")) {
    Diagnostics problems;
    Read(odd.Change(kSmallClaw), problems);
    EXPECT_NE(problems.Format().find(odd.expected), std::string::npos) << odd.expected << "\n\n"
                                                                       << problems.Format();
  }
}

TEST(ReadForeignMjcfTest, TheClawIsAHandThatLoads) {
  Diagnostics problems, of_loading;
  const ImportedFiles imported = ImportHand(kSmallClaw, MakeMjcfSource(), "", problems);
  ASSERT_EQ(problems.num_errors(), 0) << problems.Format();
  EXPECT_EQ(imported.num_digits, 3);
  EXPECT_EQ(imported.num_joints, 10);
  EXPECT_EQ(imported.num_driven, 8);
  const Hand hand = ParseHand(imported.files.at("hand.urdf"), imported.files.at("hand.yaml"),
                              "no-such-folder", of_loading);
  ASSERT_EQ(of_loading.Format(), "") << imported.files.at("hand.yaml");
  const HandJoint& distal = hand.joints[static_cast<size_t>(hand.FindJoint("FFJ1"))];
  EXPECT_EQ(hand.joints[static_cast<size_t>(distal.coupled_to)].name, "FFJ2");
  EXPECT_FALSE(distal.is_mimic);
  const HandJoint& knuckle = hand.joints[static_cast<size_t>(hand.FindJoint("FFJ3"))];
  EXPECT_EQ(knuckle.drive.stiffness, 2.0);
  EXPECT_EQ(knuckle.drive.torque_limit, 0.8);
}

TEST(ReadForeignMjcfTest, TheUnitOfAnglesCanBeSaid) {
  Diagnostics problems;
  const ForeignHand hand =
      ReadForeignMjcf(ReplaceOnce(kSmallClaw, "range=\"0 90\"", "range=\"0 1.5\""), "claw.xml", ".",
                      problems, false);
  const auto middle = std::find_if(hand.joints.begin(), hand.joints.end(),
                                   [](const ForeignJoint& j) { return j.name == "FFJ3"; });
  EXPECT_EQ(middle->upper, 1.5);
}

}  // namespace
}  // namespace graspbench
