#include "core/hand/import/read_foreign_urdf.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/core/hand/import/small_gripper.h"

namespace graspbench {
namespace {

/** A change of the gripper and what is said about it. */
struct OddUrdf {
  const char* from;
  const char* to;
  const char* expected;
};

class OddUrdfTest : public testing::TestWithParam<OddUrdf> {};

TEST_P(OddUrdfTest, TellsWhatItRepairsAndWhatItCannot) {
  const std::string text = ReplaceOnce(kSmallGripper, GetParam().from, GetParam().to);
  ASSERT_NE(text, kSmallGripper);
  Diagnostics problems;
  ReadForeignUrdf(text, "g.urdf", problems);
  EXPECT_EQ(problems.Format(), GetParam().expected) << GetParam().from << " -> " << GetParam().to;
}

constexpr const char* kLeftLimit = "lower=\"0\" upper=\"0.04\"";

INSTANTIATE_TEST_SUITE_P(
    Repaired, OddUrdfTest,
    testing::Values(
        OddUrdf{kLeftLimit, "lower=\"0.04\" upper=\"0\"",
                "g.urdf:34: warning: joint \"slide_left\": the limits are reversed; exchanged"},
        OddUrdf{"<limit effort=\"20\" lower=\"0\" upper=\"0.04\" velocity=\"0.2\"/>", "",
                "g.urdf:31: warning: joint \"slide_left\" has no <limit>; fixed: give it a lower "
                "and an upper limit if it moves"},
        OddUrdf{kLeftLimit, "",
                "g.urdf:31: warning: joint \"slide_left\" has equal limits; fixed: give it a lower "
                "and an upper limit if it moves"},
        OddUrdf{"\"slide_left\" type=\"prismatic\"", "\"slide_left\" type=\"continuous\"",
                "g.urdf:31: warning: joint \"slide_left\" is continuous, it turns without end; "
                "its limits are taken as half a turn each way"},
        OddUrdf{"\"slide_left\" type=\"prismatic\"", "\"slide_left\" type=\"floating\"",
                "g.urdf:31: warning: joint \"slide_left\": type \"floating\" is no joint of a "
                "hand; taken as fixed\n"
                "g.urdf:40: warning: joint \"slide_right\": <mimic> of \"slide_left\", which does "
                "not move; the joint gets a drive of its own"},
        OddUrdf{"<mimic joint=\"slide_left\"/>", "<mimic joint=\"slide_right\"/>",
                "g.urdf:40: warning: joint \"slide_right\": <mimic> of itself; the joint gets a "
                "drive of its own"},
        OddUrdf{"<mimic joint=\"slide_left\"/>", "<mimic joint=\"slide\"/>",
                "g.urdf:40: warning: joint \"slide_right\": <mimic> of \"slide\", which is no "
                "joint; the joint gets a drive of its own"},
        OddUrdf{"<mimic joint=\"slide_left\"/>", "<mimic joint=\"slide_left\" multiplier=\"0\"/>",
                "g.urdf:40: warning: joint \"slide_right\": <mimic> has a multiplier of 0; the "
                "joint gets a drive of its own"},
        OddUrdf{"axis xyz=\"0 1 0\"", "axis xyz=\"0 0 0\"",
                "g.urdf:33: warning: joint \"slide_left\": the axis has no direction; taken as x"},
        OddUrdf{"mass value=\"0.7\"", "mass value=\"0,7kg\"",
                "g.urdf:10: warning: link \"the hand\", inertial, <mass> value: expected 1 finite "
                "number, found \"0,7kg\"; taken as if it were not there"},
        OddUrdf{"box size=\"0.06 0.2 0.06\"", "box size=\"0.06 0.2 0\"",
                "g.urdf:14: warning: link \"the hand\", collision: the box has no extent; left "
                "out"},
        OddUrdf{"<box size=\"0.06 0.2 0.06\"/>", "<cone/>",
                "g.urdf:14: warning: link \"the hand\", collision: <cone> is no shape of URDF; "
                "left out"},
        OddUrdf{
            "<box size=\"0.06 0.2 0.06\"/>", "<mesh/>",
            "g.urdf:14: warning: link \"the hand\", collision: <mesh> has no attribute filename; "
            "left out"},
        OddUrdf{"<geometry><box size=\"0.06 0.2 0.06\"/></geometry>", "",
                "g.urdf:13: warning: link \"the hand\", collision: <geometry> is missing; "
                "left out"}));

INSTANTIATE_TEST_SUITE_P(
    Refused, OddUrdfTest,
    testing::Values(
        OddUrdf{
            "</robot>", "",
            "g.urdf:2: error: not valid XML: a tag or a value from here on is not closed or not "
            "well-formed (XML_ERROR_PARSING)"},
        OddUrdf{"<link name=\"world\"/>", "<xacro:macro name=\"m\"/>",
                "g.urdf:3: error: <xacro:macro> is a macro: expand the file first (xacro "
                "FILE.xacro > FILE.urdf)"},
        OddUrdf{"<parent link=\"world\"/>", "<parent link=\"wrold\"/>",
                "g.urdf:5: error: joint \"mount\": parent link \"wrold\" does not exist; did you "
                "mean \"world\"? "
                "Known: world, the hand, left, right"},
        OddUrdf{"<child link=\"right\"/>", "<child link=\"left\"/>",
                "g.urdf:36: error: joint \"slide_right\": link \"left\" already hangs on joint "
                "\"slide_left\" (line 31); a hand is a tree, so cut the loop and give one side a "
                "mimic\n"
                "g.urdf:26: error: several roots: \"world\", \"right\"; join all links into one "
                "tree below the link that the arm carries"},
        OddUrdf{"<parent link=\"world\"/>", "<parent link=\"left\"/>",
                "g.urdf:4: error: the joints \"mount\", \"slide_left\" form a cycle; a hand is a "
                "tree"},
        OddUrdf{"origin xyz=\"0 0 0.06\"", "origin xyz=\"nan 0 0.06\"",
                "g.urdf:33: error: joint \"slide_left\", <origin> xyz: expected 3 finite numbers, "
                "found \"nan 0 0.06\"; without it nobody knows where the joint is"},
        OddUrdf{"origin xyz=\"0 0 0.03\"", "origin xyz=\"0 0\"",
                "g.urdf:14: error: link \"the hand\", collision, <origin> xyz: expected 3 finite "
                "numbers, found \"0 0\"; without it nobody knows where the collision is"},
        OddUrdf{"origin xyz=\"0 0 0.03\"", "origin xyz=\"0 0 0.03\" quat_xyzw=\"0 0 0.7 0.7\"",
                "g.urdf:14: error: link \"the hand\", collision: its <origin> has the attribute "
                "\"quat_xyzw\"; expected the attributes \"xyz\" (a place in metres) and \"rpy\" "
                "(roll, pitch, yaw in radians) alone; give the place and the rotation by these"},
        OddUrdf{"origin xyz=\"0 0 0.06\"", "origin pos=\"0 0 0.06\"",
                "g.urdf:33: error: joint \"slide_left\": its <origin> has the attribute \"pos\"; "
                "expected the attributes \"xyz\" (a place in metres) and \"rpy\" (roll, pitch, yaw "
                "in radians) alone; give the place and the rotation by these"},
        OddUrdf{"<origin xyz=\"0 0 0.03\"/>", "<origin><!-- here --><xyz>0 0 0.03</xyz></origin>",
                "g.urdf:14: error: link \"the hand\", collision: its <origin> has the element "
                "<xyz>; expected the attributes \"xyz\" (a place in metres) and \"rpy\" (roll, "
                "pitch, yaw in radians) alone; give the place and the rotation by these"},
        OddUrdf{"<origin xyz=\"0 0 0.03\"/>", "<origin>0 0 0.03</origin>",
                "g.urdf:14: error: link \"the hand\", collision: its <origin> has the text \"0 0 "
                "0.03\"; expected the attributes \"xyz\" (a place in metres) and \"rpy\" (roll, "
                "pitch, yaw in radians) alone; give the place and the rotation by these"},
        OddUrdf{"<origin xyz=\"0 0 0.03\"/>", "<origin xyz=\"0 0 0.03\"/><origin rpy=\"1 0 0\"/>",
                "g.urdf:14: error: link \"the hand\", collision: a second <origin>; one is "
                "allowed"},
        OddUrdf{"mass value=\"0.7\"", "mass value=\"${m}\"",
                "g.urdf:10: error: link \"the hand\", inertial, <mass> value: expected 1 finite "
                "number, "
                "found \"${m}\", a macro: expand the file first (xacro FILE.xacro > FILE.urdf)"},
        OddUrdf{"<link name=\"world\"/>", "<link name=\"world\"/><link name=\"loose\"/>",
                "g.urdf:3: error: several roots: \"world\", \"loose\"; join all links into one "
                "tree below the link that the arm carries"}));

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
