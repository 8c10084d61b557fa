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
};
class SetLimitsTest : public testing::TestWithParam<Case> {};

TEST_P(SetLimitsTest, TakesWhatCanBeMeant) {
  const Case& c = GetParam();
  ForeignJoint joint;
  joint.kind = c.slides ? ForeignJoint::Kind::kPrismatic : ForeignJoint::Kind::kRevolute;
  EXPECT_EQ(SetLimits(c.stated, joint), c.repaired);
  EXPECT_EQ(joint.lower, c.lower);
  EXPECT_EQ(joint.upper, c.upper);
}
INSTANTIATE_TEST_SUITE_P(
    All, SetLimitsTest,
    testing::Values(
        Case{false, {"", -0.5, 1.5}, -0.5, 1.5, ""},
        Case{false, {"", 1.5, -0.5}, -0.5, 1.5, ": the limits are reversed; exchanged"},
        Case{false, {"", 0.0, 0.0}, -kPi, kPi, " has no range; taken as half a turn each way"},
        Case{false,
             {"<limit>", 0.0, 1.0},
             -kPi,
             kPi,
             " has no <limit>; taken as half a turn each way"},
        Case{false,
             {"", 0.0, 7.0},
             -kPi,
             kPi,
             ": a limit exceeds one turn; taken as half a turn each way"},
        Case{true, {"", 0.0, 30.0}, 0.0, 30.0, ""},  // of any unit yet
        Case{true, {"range", 0.0, 0.0}, 0.0, 0.0, " has no range; taken as 0 to 50 mm"}));

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
