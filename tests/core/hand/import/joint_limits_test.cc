#include "core/hand/import/joint_limits.h"

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace graspbench {
namespace {

struct Case {
  bool slides;
  StatedLimits stated;
  double lower, upper;
  const char* repaired;
  const char* no_limits;
};
class SetLimitsTest : public testing::TestWithParam<Case> {};

TEST_P(SetLimitsTest, TakesWhatCanBeMeant) {
  const Case& c = GetParam();
  ForeignJoint joint;
  joint.kind = c.slides ? ForeignJoint::Kind::kPrismatic : ForeignJoint::Kind::kRevolute;
  EXPECT_EQ(SetLimits(c.stated, joint), c.repaired);
  EXPECT_EQ(joint.lower, c.lower);
  EXPECT_EQ(joint.upper, c.upper);
  EXPECT_EQ(joint.no_limits, c.no_limits);
}
INSTANTIATE_TEST_SUITE_P(
    All, SetLimitsTest,
    testing::Values(
        Case{false, {"", -0.5, 1.5}, -0.5, 1.5, "", ""},
        Case{false, {"", 1.5, -0.5}, -0.5, 1.5, ": the limits are reversed; exchanged", ""},
        Case{false, {"", 0.4, 0.4}, 0.4, 0.4, "", "has equal limits"},
        Case{false, {"<limit>", 0.0, 1.0}, -kPi, kPi, "", "has no <limit>"},
        Case{false, {"", 0.0, 7.0}, -kPi, kPi, "", "has a limit of 7, more than one turn"},
        Case{true, {"", 0.0, 30.0}, 0.0, 30.0, "", ""},  // of any unit yet
        Case{true, {"range", 0.0, 0.0}, 0.0, 0.0, "", "has no range"}));

TEST(FixUnlimitedTest, OneThatFollowsIsLedTheOtherIsFixed) {
  ForeignHand hand;
  hand.links.resize(4);
  hand.joints.resize(3);
  for (int j = 0; j < 3; ++j) {
    hand.joints[j].name = "j" + std::to_string(j);
    hand.joints[j].kind = ForeignJoint::Kind::kRevolute;
    hand.joints[j].parent = j;
    hand.joints[j].child = j + 1;
    hand.joints[j].lower = 0.0;
    hand.joints[j].upper = 1.0;
  }
  hand.joints[1].no_limits = "has no <limit>";
  hand.joints[1].mimic = ForeignMimic{0, -2.0, 0.25, false};
  hand.joints[2].no_limits = "has equal limits";
  hand.joints[2].axis = Eigen::Vector3d::UnitZ();
  hand.joints[2].lower = hand.joints[2].upper = 0.5;
  Diagnostics problems;
  FixUnlimited("h", problems, hand);
  EXPECT_EQ(hand.joints[1].lower, -1.75);  // 0.25 - 2 * 1
  EXPECT_EQ(hand.joints[1].upper, 0.25);
  EXPECT_EQ(hand.joints[2].kind, ForeignJoint::Kind::kFixed);
  EXPECT_NEAR(hand.joints[2].X_PJ.linear()(1, 0), std::sin(0.5), 1e-15);
  EXPECT_EQ(problems.entries().size(), 2u);
}

TEST(FinishStrokeTest, OfAHandInMetres) {
  ForeignJoint joint;
  joint.kind = ForeignJoint::Kind::kPrismatic;
  EXPECT_EQ(FinishStroke(joint), "");
  EXPECT_EQ(joint.upper, 0.05);
  joint.upper = 0.03;
  EXPECT_EQ(FinishStroke(joint), "");
  EXPECT_EQ(joint.upper, 0.03);
  joint.upper = 40.0;
  EXPECT_EQ(FinishStroke(joint), ": a limit exceeds 1 m; taken as 0 to 50 mm");
  EXPECT_EQ(joint.upper, 0.05);
}

// Radians in a file that MuJoCo reads as degrees, and the reverse.
TEST(StatedAnglesTest, LimitsOfAnotherUnitAreDoubted) {
  const auto doubt = [](double upper, bool in_degrees, int num_joints = 3) {
    StatedAngles angles;
    const double unit = in_degrees ? RadFromDeg(1.0) : 1.0;
    for (int j = 0; j < num_joints; ++j) angles.Add(-0.1 * upper, upper, unit, 7 + j);
    EXPECT_EQ(angles.first_line, 7);
    return angles.FindDoubt(in_degrees);
  };
  EXPECT_NE(doubt(1.57, true).find("no range of 3 joints goes beyond 1.57"), std::string::npos);
  EXPECT_NE(doubt(1.57, true).find("--angle rad"), std::string::npos);
  EXPECT_NE(doubt(90.0, false).find("of 3 of 3 joints go beyond one turn, up to 90"),
            std::string::npos);
  EXPECT_NE(doubt(90.0, false).find("--angle deg"), std::string::npos);
  EXPECT_EQ(doubt(90.0, true), "");
  EXPECT_EQ(doubt(1.57, false), "");
  EXPECT_EQ(doubt(1.57, true, 1), "");  // one joint may be stiff
}

}  // namespace
}  // namespace graspbench
