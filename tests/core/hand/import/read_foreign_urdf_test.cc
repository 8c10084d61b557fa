#include "core/hand/import/read_foreign_urdf.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/core/hand/import/small_gripper.h"
#include "tests/core/hand/text_cases.h"

namespace graspbench {
namespace {

TEST(ReadForeignUrdfTest, TellsWhatItRepairsAndWhatItCannot) {
  for (const TextCase& odd : ReadTextCases(IMPORT_TEST_DATA_DIR "/odd_urdf.yaml")) {
    Diagnostics problems;
    ReadForeignUrdf(odd.Change(kSmallGripper), "g.urdf", problems);
    EXPECT_EQ(problems.Format(), odd.expected) << odd.from << " -> " << odd.to;
  }
}

TEST(ReadForeignUrdfTest, ReadsNamesOfAnyScript) {
  Diagnostics problems;
  const ForeignHand hand = ReadForeignUrdf(kSmallGripper, "g.urdf", problems);
  EXPECT_EQ(problems.Format(), "");
  EXPECT_EQ(hand.name, "parallel gripper ü");
  EXPECT_EQ(hand.links[1].name, "the hand");
  EXPECT_EQ(hand.joints[2].mimic->joint, 1);
}

TEST(ReadForeignUrdfTest, AMimicOfAMimicFollowsTheDrivenJoint) {
  Diagnostics problems;
  std::string text = kSmallGripper;
  text = ReplaceOnce(text, "<mimic joint=\"slide_left\"/>",
                     "<mimic joint=\"third\" multiplier=\"-2\" offset=\"0.001\"/>");
  text = ReplaceOnce(text, "</robot>", R"(<link name="c"/><joint name="third" type="revolute">
    <parent link="left"/><child link="c"/><limit lower="0" upper="1"/>
    <mimic joint="slide_left" multiplier="5" offset="0.1"/></joint></robot>)");
  const ForeignHand hand = ReadForeignUrdf(text, "g.urdf", problems);
  EXPECT_EQ(problems.Format(), "");
  // q_right = 0.001 - 2 (0.1 + 5 q_left)
  EXPECT_EQ(hand.joints[2].mimic->joint, 1);
  EXPECT_NEAR(hand.joints[2].mimic->ratio, -10.0, 1e-12);
  EXPECT_NEAR(hand.joints[2].mimic->offset, 0.001 - 0.2, 1e-12);
}

TEST(ReadForeignUrdfTest, MimicsInARingGetOneDrive) {
  Diagnostics problems;
  std::string text = ReplaceOnce(kSmallGripper, "velocity=\"0.2\"/>\n  </joint>",
                                 "velocity=\"0.2\"/><mimic joint=\"slide_right\"/></joint>");
  const ForeignHand hand = ReadForeignUrdf(text, "g.urdf", problems);
  EXPECT_EQ(problems.Format(),
            "g.urdf:34: warning: joint \"slide_left\": <mimic> goes round in a ring; the joint "
            "gets a drive of its own");
  EXPECT_FALSE(hand.joints[1].mimic);
  EXPECT_EQ(hand.joints[2].mimic->joint, 1);
}

TEST(ReadForeignUrdfTest, LooksBeyondTheOrderOfElements) {
  // Joints before links, as some exporters write.
  Diagnostics problems;
  const ForeignHand hand = ReadForeignUrdf(
      R"(<robot name="r"><joint name="j" type="revolute"><parent link="a"/><child link="b"/>
         <axis xyz="0 0 2"/><limit lower="-1" upper="1"/></joint><link name="a"/><link name="b"/>
         </robot>)",
      "r.urdf", problems);
  EXPECT_EQ(problems.Format(), "");
  ASSERT_EQ(hand.joints.size(), 1u);
  EXPECT_EQ(hand.joints[0].axis, Eigen::Vector3d::UnitZ());
}

TEST(ReadForeignUrdfTest, TheCountOfLinksIsTold) {
  std::string text = "<robot name=\"r\"><link name=\"l0\"/>";
  for (int i = 1; i < 1200; ++i) {
    const std::string number = std::to_string(i);
    text += "<link name=\"l" + number + "\"/><joint name=\"j" + number +
            "\" type=\"fixed\"><parent link=\"l0\"/><child link=\"l" + number + "\"/></joint>";
  }
  Diagnostics problems;
  ReadForeignUrdf(text + "</robot>", "r.urdf", problems);
  EXPECT_EQ(problems.Format(),
            "r.urdf:1: error: the file has 1200 links and 1199 joints; expected a hand, which has "
            "fewer than 1000 of each");
}

/** Two fingers that turn, with these limits. */
std::string MakeTurning(const std::string& left, const std::string& right) {
  std::string text = kSmallGripper;
  for (const std::string& limits : {left, right}) {
    text = ReplaceOnce(text, "type=\"prismatic\"", "type=\"revolute\"");
    text = ReplaceOnce(text, "lower=\"0\" upper=\"0.04\"", limits);
  }
  return ReplaceOnce(text, "<mimic joint=\"slide_left\"/>", "");
}

TEST(ReadForeignUrdfTest, LimitsBeyondATurnAreDegrees) {
  Diagnostics problems;
  const std::string all = MakeTurning("lower=\"-20\" upper=\"90\"", "lower=\"0\" upper=\"45\"");
  ForeignHand hand = ReadForeignUrdf(all, "g.urdf", problems);
  EXPECT_NEAR(hand.joints[1].lower, RadFromDeg(-20.0), 1e-12);
  EXPECT_NEAR(hand.joints[2].upper, RadFromDeg(45.0), 1e-12);
  EXPECT_EQ(problems.Format(),
            "g.urdf:2: warning: limits of 2 of 2 joints would be more than one turn, up to 90; all "
            "are taken as degrees, though URDF has radians (--angle says otherwise)");
  problems = {};
  const std::string one = MakeTurning("lower=\"0\" upper=\"90\"", "lower=\"0\" upper=\"1.5\"");
  hand = ReadForeignUrdf(one, "g.urdf", problems);
  EXPECT_NEAR(hand.joints[1].upper, RadFromDeg(90.0), 1e-12);
  EXPECT_EQ(hand.joints[2].upper, 1.5);
  EXPECT_EQ(problems.Format(),
            "g.urdf:34: warning: joint \"slide_left\": a limit of 90 would be more than one turn; "
            "this joint's limits are taken as degrees (--angle says otherwise)");
  problems = {};
  hand = ReadForeignUrdf(MakeTurning("lower=\"0\" upper=\"5\"", "lower=\"0\" upper=\"3\""),
                         "g.urdf", problems, true);
  EXPECT_NEAR(hand.joints[1].upper, RadFromDeg(5.0), 1e-12);
  EXPECT_EQ(problems.Format(), "");
  hand = ReadForeignUrdf(all, "g.urdf", problems, false);
  EXPECT_EQ(problems.Format(),
            "g.urdf:31: warning: joint \"slide_left\" has a limit of 90, more than one turn; "
            "fixed: give it a lower and an upper limit if it moves\n"
            "g.urdf:36: warning: joint \"slide_right\" has a limit of 45, more than one turn; "
            "fixed: give it a lower and an upper limit if it moves");
}

}  // namespace
}  // namespace graspbench
