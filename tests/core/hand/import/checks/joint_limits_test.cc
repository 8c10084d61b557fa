#include "core/hand/import/checks/joint_limits.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

/** A finger: links of 95, 45 and 25 mm, a ball at its end, in units of `unit`. */
ForeignHand MakeFinger(double unit) {
  ForeignHand hand;
  hand.links.resize(4);
  for (int i = 0; i < 3; ++i) {
    ForeignJoint& joint = hand.joints.emplace_back();
    joint.kind = ForeignJoint::Kind::kRevolute;
    joint.upper = 1.5;
    joint.parent = i;
    joint.child = i + 1;
    joint.X_PJ = MakePose(Eigen::Vector3d(0.0, 0.0, std::vector{0.095, 0.045, 0.025}[i] / unit));
  }
  ForeignShape& shape = hand.links[3].collisions.emplace_back();
  shape.size.setConstant(0.02 / unit);
  shape.X_LS = MakePose(Eigen::Vector3d(0.0, 0.0, 0.01 / unit));
  hand.links[3].inertia.emplace();
  hand.links[3].inertia->mass = 0.02;
  hand.links[3].inertia->X_LI = shape.X_LS;
  hand.links[3].inertia->I_I.setIdentity();
  return hand;
}

TEST(SetLengthUnitTest, ScalesEveryLengthAndNoAngle) {
  for (const double unit : {0.01, 0.001, 0.0254}) {
    ForeignHand hand = MakeFinger(unit);
    Diagnostics problems;
    SetLengthUnit(unit, "h", problems, hand);
    EXPECT_EQ(problems.Format(), "");
    EXPECT_NEAR(hand.joints[1].X_PJ.translation().z(), 0.045, 1e-12);
    EXPECT_EQ(hand.joints[1].upper, 1.5);
    EXPECT_NEAR(hand.links[3].collisions[0].size.x(), 0.02, 1e-12);
    EXPECT_NEAR(hand.links[3].collisions[0].X_LS.translation().z(), 0.01, 1e-12);
    EXPECT_NEAR(hand.links[3].inertia->X_LI.translation().z(), 0.01, 1e-12);
    EXPECT_NEAR(hand.links[3].inertia->I_I(0, 0), unit * unit, 1e-12);
    EXPECT_EQ(hand.links[3].inertia->mass, 0.02);
  }
}

TEST(SetLengthUnitTest, TellsWhichUnitItInfersAndWhy) {
  const std::pair<double, std::string> cases[] = {
      {1.0, ""},
      {0.01,
       "h: warning: the joints lie typically 4.5 apart: the description is taken to be in "
       "centimetres, where that is 45 mm, as in a finger; inches would be 114 mm (--unit in)"},
      {0.1,
       "h: warning: the joints lie typically 0.45 apart: the description is taken to be in "
       "decimetres, where that is 45 mm, as in a finger; if it is not, say its unit with --unit"},
      {0.001,
       "h: warning: the joints lie typically 45 apart: the description is taken to be in "
       "millimetres, where that is 45 mm, as in a finger; if it is not, say its unit with --unit"},
      {0.0254,
       "h: warning: the joints lie typically 1.77 apart: the description is taken to be in "
       "inches, where that is 45 mm, as in a finger; centimetres would be 17.7 mm (--unit cm)"},
      {0.0045,
       "h: error: the joints lie typically 10 apart, which is a hand neither in metres nor in "
       "centimetres nor in millimetres; say its unit with --unit"}};
  for (const auto& [unit, told] : cases) {
    ForeignHand hand = MakeFinger(unit);
    Diagnostics problems;
    SetLengthUnit(0.0, "h", problems, hand);
    EXPECT_EQ(problems.Format(), told);
    if (problems.num_errors() == 0) {
      EXPECT_NEAR(hand.joints[0].X_PJ.translation().z(), 0.095, 1e-12);
    }
  }
}

// Jaws may begin anywhere along their slides.
TEST(SetLengthUnitTest, SlidesSayNothing) {
  ForeignHand hand = MakeFinger(1.0);
  ForeignHand jaws = MakeFinger(0.1);
  for (ForeignJoint& joint : jaws.joints) {
    joint.kind = ForeignJoint::Kind::kPrismatic;
    joint.upper = 0.05;
  }
  Diagnostics problems;
  SetLengthUnit(0.0, "h", problems, jaws);
  EXPECT_EQ(problems.Format(), "");
  EXPECT_NEAR(jaws.joints[1].X_PJ.translation().z(), 0.45, 1e-12);
  hand.joints[1].kind = ForeignJoint::Kind::kPrismatic;
  EXPECT_EQ(CalcLinkLengths(hand), (std::vector<double>{0.095, 0.0, 0.025, 0.025}));
  EXPECT_EQ(CalcLinkLengths(jaws), (std::vector<double>{0.0, 0.0, 0.0, 0.0}));
}

TEST(CalcLinkLengthsTest, ToTheFarthestJointOrFromTheOneBefore) {
  EXPECT_EQ(CalcLinkLengths(MakeFinger(1.0)), (std::vector<double>{0.095, 0.045, 0.025, 0.025}));
  ForeignHand hub = MakeFinger(1.0);  // the next joint lies where its own does
  hub.joints[1].X_PJ = Pose::Identity();
  EXPECT_EQ(CalcLinkLengths(hub), (std::vector<double>{0.095, 0.0, 0.025, 0.025}));
}

}  // namespace
}  // namespace graspbench
