#include "core/hand/import/foreign_hand.h"

#include <gtest/gtest.h>

#include "core/base/text/json.h"
#include "core/base/units.h"
#include "core/hand/import/checks/joint_limits.h"
#include "core/hand/load_hand.h"
#include "core/hand/xml_text.h"
#include "tests/core/hand/import/small_gripper.h"

namespace graspbench {
namespace {

// A turn of 90 deg about z, and a slide along x that follows it: 0.01 m + 0.02 m/rad.
TEST(FixJointTest, HoldsTheJointAndThoseThatFollow) {
  ForeignHand hand;
  hand.joints.resize(2);
  hand.joints[0].kind = ForeignJoint::Kind::kRevolute;
  hand.joints[0].axis = Eigen::Vector3d::UnitZ();
  hand.joints[0].X_PJ = MakePose({1.0, 0.0, 0.0});
  hand.joints[1].kind = ForeignJoint::Kind::kPrismatic;
  hand.joints[1].mimic.emplace();
  hand.joints[1].mimic->joint = 0;
  hand.joints[1].mimic->ratio = 0.02;
  hand.joints[1].mimic->offset = 0.01;
  FixJoint(hand, 0, 0.5 * kPi);
  const Eigen::Vector3d x = hand.joints[0].X_PJ * Eigen::Vector3d::UnitX();
  EXPECT_LT((x - Eigen::Vector3d(1.0, 1.0, 0.0)).norm(), 1e-15);
  EXPECT_NEAR(hand.joints[1].X_PJ.translation().x(), 0.01 + 0.01 * kPi, 1e-15);
  for (const ForeignJoint& joint : hand.joints) {
    EXPECT_EQ(joint.kind, ForeignJoint::Kind::kFixed);
    EXPECT_FALSE(joint.mimic);
  }
}

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

/** world - palm - (hinge) finger - nail, "-" fixed, each with a picture. */
ForeignHand MakeFinger() {
  ForeignHand hand;
  for (const char* name : {"world", "palm", "finger", "nail"}) {
    ForeignLink& link = hand.links.emplace_back();
    link.name = name;
    link.line = static_cast<int>(hand.links.size());
    link.visuals.emplace_back();
  }
  for (int child = 1; child < 4; ++child) {
    ForeignJoint& joint = hand.joints.emplace_back();
    joint.parent = child - 1;
    joint.child = child;
    if (child == 2) joint.kind = ForeignJoint::Kind::kRevolute;
  }
  return hand;
}

TEST(DecorationTest, IsAPictureFixedToALinkThatSaysWhatTouches) {
  ForeignHand hand = MakeFinger();
  hand.links[1].collisions.emplace_back();
  hand.links[2].collisions.emplace_back();
  Diagnostics problems;
  FindDecoration("h.urdf", problems, hand);
  EXPECT_EQ(problems.Format(),
            "h.urdf:1: warning: link \"world\" has a picture and no collision shape, and \"palm\", "
            "to which it is fixed, has some: its picture is decoration, left out of contact and "
            "mass\n"
            "h.urdf:4: warning: link \"nail\" has a picture and no collision shape, and "
            "\"finger\", to which it is fixed, has some: its picture is decoration, left out of "
            "contact and mass");
  EXPECT_TRUE(hand.links[0].is_decoration);
  EXPECT_FALSE(hand.links[1].is_decoration);
  EXPECT_TRUE(hand.links[3].is_decoration);
}

// Drawn axes of 150 mm on the frame that carries a gripper of 0.7, 0.015 and (by its volume of
// 0.02 x 0.015 x 0.055 m^3, as its balls have it) some 0.02 kg.
TEST(DecorationTest, NeitherTouchesNorWeighsInAnImport) {
  std::string text = kSmallGripper;
  const auto import = [](const std::string& of) {
    Diagnostics problems;
    ImportedFiles imported = ImportHand(of, MakeSourceWithoutMeshes(), "", problems);
    EXPECT_EQ(problems.num_errors(), 0) << problems.Format();
    Diagnostics of_loading;
    return std::pair(
        ParseHand(imported.files.at("hand.urdf"), imported.files.at("hand.yaml"), ".", of_loading),
        problems.Format());
  };
  const auto [plain, plain_problems] = import(text);
  text.replace(text.find("<link name=\"world\"/>"), 20, R"(<link name="world">
    <inertial><mass value="1e-6"/>
      <inertia ixx="1e-9" iyy="1e-9" izz="1e-9" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><origin xyz="0 0 0.075"/>
      <geometry><cylinder radius="0.004" length="0.15"/></geometry></visual></link>)");
  const auto [decorated, problems] = import(text);
  EXPECT_NE(problems.find("link \"world\" has a picture and no collision shape"), problems.npos)
      << problems;
  EXPECT_EQ(decorated.contact_spheres.size(), plain.contact_spheres.size());
  double mass = 0.0, plain_mass = 0.0;
  for (const HandLink& link : decorated.links) mass += link.mass;
  for (const HandLink& link : plain.links) plain_mass += link.mass;
  EXPECT_NEAR(mass, plain_mass + 1e-6, 1e-8);
}

TEST(ParseNumbersTest, BlanksCommasAndSigns) {
  EXPECT_EQ(ParseNumbers(" 1 -2.5,+3e-1\n"), (std::vector<double>{1.0, -2.5, 0.3}));
  EXPECT_EQ(ParseNumbers(""), std::vector<double>());
  for (const char* text : {"1 two", "nan", "inf", "1e9", "1..2", "0x10", "1;2"}) {
    EXPECT_FALSE(ParseNumbers(text)) << text;
  }
}

}  // namespace
}  // namespace graspbench
