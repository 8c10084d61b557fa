#include "core/hand/import/decoration.h"

#include <gtest/gtest.h>

#include "core/base/text/json.h"
#include "core/hand/load_hand.h"
#include "tests/core/hand/import/small_gripper.h"

namespace graspbench {
namespace {

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

// What moves by itself touches with its pictures where nothing else of it is described.
TEST(DecorationTest, IsNotABodyOfPicturesAlone) {
  ForeignHand hand = MakeFinger();
  hand.links[1].collisions.emplace_back();
  Diagnostics problems;
  FindDecoration("h.urdf", problems, hand);
  EXPECT_TRUE(hand.links[0].is_decoration);
  EXPECT_FALSE(hand.links[2].is_decoration);
  EXPECT_FALSE(hand.links[3].is_decoration);
  ForeignHand without_collisions = MakeFinger();
  Diagnostics nothing;
  FindDecoration("h.urdf", nothing, without_collisions);
  EXPECT_EQ(nothing.Format(), "");
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

}  // namespace
}  // namespace graspbench
