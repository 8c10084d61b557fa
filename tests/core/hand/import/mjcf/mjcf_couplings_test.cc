#include "core/hand/import/mjcf/mjcf_couplings.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/hand/import/read_foreign_urdf.h"
#include "tests/core/hand/import/small_claw.h"

namespace graspbench {
namespace {

constexpr const char* kBends =
    "claw.xml: warning: no actuator moves \"THJ1\", and no other joint; each gets a drive of its "
    "own, as no joint is loose here";
constexpr const char* kEquality = "polycoef=\"0.1 0.8 0 0 0\"";

class MjcfCouplingsTest : public testing::Test {
 protected:
  /** The claw with one change. */
  void Read(const std::string& from = "", const std::string& to = "") {
    const std::string text = from.empty() ? kSmallClaw : ReplaceOnce(kSmallClaw, from, to);
    ASSERT_EQ(text == kSmallClaw, from.empty());
    problems_ = Diagnostics();
    hand_ = ReadForeignMjcf(text, "claw.xml", "no-such-folder", problems_);
    ASSERT_EQ(problems_.num_errors(), 0) << problems_.Format();
  }
  const ForeignJoint& Joint(const std::string& name) const {
    for (const ForeignJoint& joint : hand_.joints) {
      if (joint.name == name) return joint;
    }
    throw std::runtime_error("no joint " + name);
  }
  bool Tells(const std::string& text) const {
    return problems_.Format().find(text) != std::string::npos;
  }

  ForeignHand hand_;
  Diagnostics problems_;
};

TEST_F(MjcfCouplingsTest, AnEqualityIsALine) {
  Read();
  const auto& mimic = Joint("MFJ1").mimic;
  ASSERT_TRUE(mimic);
  EXPECT_EQ(hand_.joints[static_cast<size_t>(mimic->joint)].name, "MFJ2");
  EXPECT_EQ(mimic->ratio, 0.8);
  EXPECT_EQ(mimic->offset, 0.1);
  EXPECT_FALSE(mimic->is_distal);
}

// x^2 on 0 .. pi/2: its best line has the slope pi/2; sampled, the error at the ends is a sixth of
// the square of the range.
TEST_F(MjcfCouplingsTest, APolynomialBecomesItsNearestLine) {
  Read(kEquality, "polycoef=\"0 0 1 0 0\"");
  const double range = 0.5 * kPi;
  EXPECT_NEAR(Joint("MFJ1").mimic->ratio, range, 1e-9);
  EXPECT_NEAR(Joint("MFJ1").mimic->offset, -range * range / 6.0, 0.02);
  EXPECT_TRUE(Tells("a polynomial; the line nearest to it is taken, off by 23."))
      << problems_.Format();
}

TEST_F(MjcfCouplingsTest, AnEqualityOfOneJointFixesIt) {
  Read("joint1=\"MFJ1\" joint2=\"MFJ2\" polycoef=\"0.1 0.8 0 0 0\"",
       "joint1=\"MFJ1\" polycoef=\"0.3\"");
  EXPECT_EQ(Joint("MFJ1").kind, ForeignJoint::Kind::kFixed);
}

// -0.0015 <= 0.0071 q1 - 0.0083 q2 <= 0.0005: q1 = (8.3 q2 - 0.5) / 7.1, with a play of 1 / 7.1 rad.
// Of 0.0071 times a quarter turn, 0.0112, these limits are 18 %; of +-0.006 they would be a stop.
TEST_F(MjcfCouplingsTest, NarrowLimitsOfATendonTieTwoJoints) {
  const std::string equality =
      "<equality>\n    <joint joint1=\"MFJ1\" joint2=\"MFJ2\" polycoef=\"0.1 0.8 0 0 0\"/>";
  const auto tendon = [](const std::string& range) {
    return "<tendon><fixed name=\"pull\" limited=\"true\" range=\"" + range +
           "\"><joint joint=\"MFJ1\" coef=\"0.0071\"/>"
           "<joint joint=\"MFJ2\" coef=\"-0.0083\"/></fixed></tendon><equality>";
  };
  Read(equality, tendon("-0.0015 0.0005"));
  const auto& mimic = Joint("MFJ1").mimic;
  ASSERT_TRUE(mimic) << problems_.Format();
  EXPECT_EQ(hand_.joints[static_cast<size_t>(mimic->joint)].name, "MFJ2");
  EXPECT_NEAR(mimic->ratio, 8.3 / 7.1, 1e-12);
  EXPECT_NEAR(mimic->offset, -0.5 / 7.1, 1e-12);
  EXPECT_TRUE(Tells("the play of " + std::string("8.07 deg each way"))) << problems_.Format();
  Read(equality, tendon("-0.006 0.006"));
  EXPECT_FALSE(Joint("MFJ1").mimic);
  EXPECT_TRUE(Tells("tendon \"pull\" of \"MFJ1\", \"MFJ2\": no actuator pulls it"));
}

// With positions from `ref`: 0.0071 (q1 + 5 deg) - 0.0083 (q2 - 4 deg) = -0.0005.
TEST_F(MjcfCouplingsTest, LimitsOfATendonCountFromRef) {
  std::string text =
      ReplaceOnce(kSmallClaw, "<joint name=\"MFJ2\"", "<joint ref=\"-4\" name=\"MFJ2\"");
  text = ReplaceOnce(text, "<joint name=\"MFJ1\"", "<joint ref=\"5\" name=\"MFJ1\"");
  text = ReplaceOnce(
      text, "<equality>\n    <joint joint1=\"MFJ1\" joint2=\"MFJ2\" polycoef=\"0.1 0.8 0 0 0\"/>",
      "<tendon><fixed name=\"pull\" limited=\"true\" range=\"-0.0015 0.0005\">"
      "<joint joint=\"MFJ1\" coef=\"0.0071\"/><joint joint=\"MFJ2\" coef=\"-0.0083\"/></fixed>"
      "</tendon><equality>");
  hand_ = ReadForeignMjcf(text, "claw.xml", "no-such-folder", problems_);
  const auto& mimic = Joint("MFJ1").mimic;
  ASSERT_TRUE(mimic) << problems_.Format();
  const double offset = (-0.0005 - 0.0083 * RadFromDeg(4.0)) / 0.0071 - RadFromDeg(5.0);
  EXPECT_NEAR(mimic->offset, offset, 1e-12);
  EXPECT_TRUE(Tells("to 1.17 times \"MFJ2\" plus -13.71 deg; the play")) << problems_.Format();
}

TEST_F(MjcfCouplingsTest, AnInactiveEqualityTiesNothing) {
  Read(kEquality, "active=\"false\"");
  EXPECT_FALSE(Joint("MFJ1").mimic);
}

// 2 q1 + 1 q2 = 0.5: q2 = 0.5 - 2 q1.
TEST_F(MjcfCouplingsTest, AnEqualityOfATendonOfTwoJoints) {
  Read("<joint joint1=\"MFJ1\" joint2=\"MFJ2\" polycoef=\"0.1 0.8 0 0 0\"/>\n  </equality>",
       "<tendon tendon1=\"t\" polycoef=\"0.5\"/></equality><tendon><fixed name=\"t\">"
       "<joint joint=\"MFJ1\" coef=\"1\"/><joint joint=\"MFJ2\" coef=\"2\"/></fixed></tendon>");
  EXPECT_EQ(Joint("MFJ1").mimic->ratio, -2.0);
  EXPECT_EQ(Joint("MFJ1").mimic->offset, 0.5);
}

TEST_F(MjcfCouplingsTest, ADriveOfTwoJointsOfAFingerIsTheCouplingRule) {
  Read();
  const auto& mimic = Joint("FFJ1").mimic;
  ASSERT_TRUE(mimic);
  EXPECT_TRUE(mimic->is_distal);
  EXPECT_EQ(hand_.joints[static_cast<size_t>(mimic->joint)].name, "FFJ2");
  EXPECT_TRUE(Tells("\"FFJ1\" follows \"FFJ2\" by the hand's coupling rule"));
  Read("joint=\"FFJ1\" coef=\"1\"", "joint=\"FFJ1\" coef=\"0.5\"");
  EXPECT_FALSE(Joint("FFJ1").mimic->is_distal);
  EXPECT_EQ(Joint("FFJ1").mimic->ratio, 0.5);
}

// The tendon's length is q2 + 0.5 q1 = 1.25 q2; force times arm, stiffness times its square.
TEST_F(MjcfCouplingsTest, DrivesAreAtTheJoint) {
  Read();
  EXPECT_EQ(Joint("FFJ3").drive.stiffness, 2.0);
  EXPECT_EQ(Joint("FFJ3").drive.effort, 0.8);
  EXPECT_EQ(Joint("FFJ3").drive.damping, 0.02);
  EXPECT_EQ(Joint("FFJ2").drive.stiffness, 1.0);
  EXPECT_EQ(Joint("MFJ3").drive.stiffness, 8.0);
  EXPECT_EQ(Joint("MFJ3").drive.effort, 1.6);
  EXPECT_EQ(Joint("MFJ2").drive.stiffness, 0.0);
  EXPECT_EQ(Joint("MFJ2").drive.effort, 1.0);
  EXPECT_EQ(Joint("THJ3").drive.stiffness, 900.0);
  EXPECT_EQ(Joint("THJ3").drive.damping, 30.02);
  EXPECT_EQ(Joint("THJ3").drive.effort, 25.0);
  EXPECT_EQ(Joint("THJ2").drive.effort, 0.6);
  EXPECT_TRUE(Tells(kBends));
  Read("joint=\"FFJ1\" coef=\"1\"", "joint=\"FFJ1\" coef=\"0.5\"");
  EXPECT_EQ(Joint("FFJ2").drive.stiffness, 1.5625);
  EXPECT_EQ(Joint("FFJ2").drive.effort, 1.0);
}

}  // namespace
}  // namespace graspbench
