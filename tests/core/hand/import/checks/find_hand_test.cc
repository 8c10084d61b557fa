#include "core/hand/import/checks/find_hand.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

/** Links by name, each with a shape, that hang on the one named before them, 30 mm along x times
`step`. */
class TreeBuilder {
 public:
  int Add(const std::string& name, int parent, bool moves, const Eigen::Vector3d& at) {
    ForeignLink& link = hand.links.emplace_back();
    link.name = name;
    link.collisions.emplace_back();
    const int child = static_cast<int>(hand.links.size()) - 1;
    if (parent < 0) return child;
    ForeignJoint& joint = hand.joints.emplace_back();
    joint.kind = moves ? ForeignJoint::Kind::kRevolute : ForeignJoint::Kind::kFixed;
    joint.parent = parent;
    joint.child = child;
    joint.X_PJ = MakePose(at);
    return child;
  }
  void AddClaw(const std::string& name, int parent, const Eigen::Vector3d& at) {
    const int palm = Add(name, parent, false, at);
    Add(name + "_a", palm, true, {0.03, 0, 0});
    Add(name + "_b", palm, true, {-0.03, 0, 0});
  }
  HandCandidate Find(const std::string& palm = "") {
    return FindHand(hand, MakeForeignTree(hand), std::vector<bool>(hand.links.size(), true), palm,
                    "rig.urdf", problems);
  }
  ForeignHand hand;
  Diagnostics problems;
};

TEST(FindHandTest, OneHandIsItsOwn) {
  TreeBuilder rig;
  rig.AddClaw("claw", -1, {0, 0, 0});
  const HandCandidate place = rig.Find();
  EXPECT_EQ(place.palm, 0);
  EXPECT_EQ(place.top, 0);
  EXPECT_EQ(rig.problems.Format(), "");
}

/** A claw fixed to a pole with a foot. */
TreeBuilder MakeClawOnPole(double mass) {
  TreeBuilder rig;
  const int foot = rig.Add("foot", -1, false, {0, 0, 0});
  const int pole = rig.Add("pole", foot, false, {0, 0, 0.5});
  rig.AddClaw("claw", pole, {0, 0, 0.5});
  for (ForeignLink& link : rig.hand.links) link.inertia.emplace().mass = 0.1;
  rig.hand.links[static_cast<size_t>(pole)].inertia->mass = mass;
  return rig;
}

TEST(FindHandTest, ANamedPalmIsCutFromWhatCarriesIt) {
  TreeBuilder rig = MakeClawOnPole(2.0);
  const HandCandidate place = rig.Find("claw");
  EXPECT_EQ(rig.hand.links[place.palm].name, "claw");
  ASSERT_GE(place.carrier, 0);
  EXPECT_EQ(rig.hand.links[place.carrier].name, "pole");
  EXPECT_EQ(rig.hand.links[place.root].name, "claw");
  // A table beside it on a mere frame.
  TreeBuilder scene;
  const int world = scene.Add("world", -1, false, {0, 0, 0});
  const int table = scene.Add("table", world, false, {0, 0, -0.1});
  scene.AddClaw("claw", world, {0, 0, 0.5});
  for (ForeignLink& link : scene.hand.links) link.inertia.emplace().mass = 0.1;
  scene.hand.links[static_cast<size_t>(table)].inertia->mass = 20.0;
  scene.hand.links[static_cast<size_t>(world)] = {};
  EXPECT_EQ(scene.Find("claw").carrier, table);
  // A part of a palm that digits hang on carries nothing.
  TreeBuilder two_parts;
  const int base = two_parts.Add("base", -1, false, {0, 0, 0});
  two_parts.Add("thumb", base, true, {0.02, 0, 0});
  two_parts.AddClaw("claw", base, {0, 0, 0.02});
  EXPECT_EQ(two_parts.Find("claw").carrier, -1);
}

// By masses of the builder: 0.1 kg of each link of the claw, 0.3 in all.
TEST(FindHandTest, WhatOutweighsTheHandThatIsFixedToItIsReported) {
  TreeBuilder rig = MakeClawOnPole(2.0);
  const HandCandidate place = rig.Find();
  EXPECT_EQ(place.carrier, -1) << "it may be a part of the palm";
  EXPECT_EQ(rig.problems.Format(),
            "rig.urdf: warning: link \"pole\" weighs 2 kg and is fixed to \"claw\", which weighs "
            "0.3 kg with its digits; taken as a part of the palm. If it carries the hand, say "
            "--palm claw");
  TreeBuilder light = MakeClawOnPole(0.2);
  light.Find();
  EXPECT_EQ(light.problems.Format(), "");
}

TEST(FindHandTest, TwoHandsAreListedAndOneIsChosen) {
  TreeBuilder rig;
  const int root = rig.Add("rig", -1, false, {0, 0, 0});
  rig.AddClaw("left", root, {0, 0.2, 0});
  rig.AddClaw("right", root, {0, -0.2, 0});
  EXPECT_EQ(rig.Find().palm, -1);
  EXPECT_EQ(rig.problems.Format(),
            "rig.urdf: error: found 2 hands, with the palms \"left\", \"right\"; choose one with "
            "--palm");
  const HandCandidate place = rig.Find("right");
  EXPECT_EQ(rig.hand.links[place.palm].name, "right");
  EXPECT_EQ(rig.hand.links[place.top].name, "right");
}

// A moving metacarpal with two fingers beside three other digits, as some hands have: no hand in a
// hand.
TEST(FindHandTest, APartWithTwoFingersNearTheOthersIsNoHandOfItsOwn) {
  TreeBuilder rig;
  const int palm = rig.Add("palm", -1, false, {0, 0, 0});
  rig.Add("thumb", palm, true, {0.03, 0, 0});
  rig.Add("index", palm, true, {0, 0, 0.09});
  const int part = rig.Add("metacarpal", palm, true, {0, 0.03, 0.02});
  rig.Add("ring", part, true, {0, 0, 0.07});
  rig.Add("little", part, true, {0, 0.02, 0.06});
  EXPECT_EQ(rig.Find().palm, palm);
}

TEST(FindHandTest, ThingsOfAWorldAreNoDigits) {
  TreeBuilder scene;
  const int world = scene.Add("world", -1, false, {0, 0, 0});
  scene.hand.links[0].collisions.clear();
  scene.hand.world = world;
  scene.Add("door", world, true, {1, 0, 0});
  scene.Add("drawer", world, true, {0, 1, 0});
  EXPECT_EQ(scene.Find().palm, -1);
  EXPECT_NE(scene.problems.Format().find("found \"door\", \"drawer\", each on its own"),
            std::string::npos);
  scene.AddClaw("claw", world, {0, 0, 0});
  scene.problems = {};
  EXPECT_EQ(scene.hand.links[scene.Find().palm].name, "claw");
  EXPECT_NE(scene.problems.Format().find("\"door\", \"drawer\": not of the hand at \"claw\""),
            std::string::npos);
}

}  // namespace
}  // namespace graspbench
