#include "core/hand/import/weld_links.h"

#include <gtest/gtest.h>

#include "core/hand/import/checks/find_hand.h"
#include "core/hand/import/read_foreign_urdf.h"
#include "core/hand/import/select_hand.h"
#include "tests/core/hand/import/small_gripper.h"

namespace graspbench {
namespace {

ImportedHand Weld(const std::string& urdf, Diagnostics& problems, const std::string& palm = "") {
  ForeignHand foreign = ReadForeignUrdf(urdf, "g.urdf", problems);
  const int palm_link = SelectHand(
      palm, [](const ForeignLink&) { return false; }, "g.urdf", problems, foreign);
  if (palm_link < 0) return {};
  const HandSource source = MakeSourceWithoutMeshes();
  ShapeLoader loader(source, problems);
  std::vector<LoadedShapes> shapes;
  for (const ForeignLink& link : foreign.links) shapes.push_back(loader.Load(link));
  return WeldLinks(foreign, palm_link, shapes, "g.urdf", problems);
}

TEST(WeldLinksTest, FixedPartsBecomeOneLinkNamedAfterItsBody) {
  Diagnostics problems;
  const ImportedHand imported = Weld(kSmallGripper, problems);
  const Hand& hand = imported.hand;
  ASSERT_EQ(hand.links.size(), 3u);
  EXPECT_EQ(hand.links[0].name, "the hand");
  EXPECT_EQ(hand.palm_link, 0);
  EXPECT_EQ(hand.links[0].mass, 0.7);
  // In the frame of "the hand", not of the world it hangs from.
  EXPECT_LT((hand.links[1].X_PJ.translation() - Eigen::Vector3d(0, 0, 0.06)).norm(), 1e-12);
  EXPECT_LT((imported.shapes[0].X_LS.translation() - Eigen::Vector3d(0, 0, 0.03)).norm(), 1e-12);
  EXPECT_TRUE(hand.joints[1].is_mimic);
  EXPECT_EQ(hand.joints[1].coupled_to, 0);
}

TEST(WeldLinksTest, TheMassesOfWeldedPartsAddAboutTheCommonCentre) {
  // Two balls of one mass, 0.1 m apart, behind a turned fixed joint: a dumb-bell.
  const std::string urdf = ReplaceOnce(kSmallGripper, "<link name=\"world\"/>",
                                       R"(<link name="world"><inertial><mass value="0.7"/>
    <origin xyz="0 0 1.1"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.0025" iyz="0" izz="0.0017"/>
    </inertial></link>)");
  Diagnostics problems;
  const HandLink palm = Weld(urdf, problems).hand.links[0];
  EXPECT_NEAR(palm.mass, 1.4, 1e-12);
  EXPECT_LT((palm.p_LLcm - Eigen::Vector3d(0, 0, -0.05)).norm(), 1e-12);
  EXPECT_NEAR(palm.I_LLcm(0, 0), 0.002 + 1.4 * 0.05 * 0.05, 1e-12);
  EXPECT_NEAR(palm.I_LLcm(2, 2), 0.0034, 1e-12);
}

TEST(WeldLinksTest, ReplacesWhatNoBodyHas) {
  const auto told = [](const std::string& from, const std::string& to) {
    Diagnostics problems;
    Weld(ReplaceOnce(kSmallGripper, from, to), problems);
    return problems.entries().empty() ? "" : problems.entries()[0].text;
  };
  const std::string kept =
      "link \"right\": no <inertial>; replaced: mass of its volume at 1200 "
      "kg/m^3, inertia of its volume, 19.8 g";
  EXPECT_EQ(told("nothing", "changed"), kept);
  const std::string left = "link \"left\": ";
  EXPECT_EQ(told("<mass value=\"0.015\"/>", "<mass value=\"0.05\"/>"),
            kept);  // heavy, but a body may have it
  // A ball of 100 g of 20,000 kg/m^3 has a radius of 10.6 mm and moments of 4.5e-6 kg m^2.
  EXPECT_EQ(
      told("<mass value=\"0.015\"/>", "<mass value=\"0.1\"/>"),
      left +
          "an inertia of 2.4e-06 kg m^2 for 100 g, less than a ball of the densest metal has; "
          "replaced: published mass, inertia of its volume, 100 g");
  EXPECT_EQ(told("<mass value=\"0.015\"/>", "<mass value=\"5\"/>"),
            left +
                "a mass of 5 kg in bounds of 16.5 cm^3, denser than any metal: its mass or the "
                "size of its shapes is wrong; replaced: mass "
                "of its volume at 1200 kg/m^3, inertia of its volume, 19.8 g");
  EXPECT_EQ(
      told("<mass value=\"0.015\"/>", "<mass value=\"50\"/>"),
      "its links weigh 50.7 kg in all, \"left\" alone 50 kg; a hand weighs 10 kg at most. Are "
      "these grams, or parts of a scene? Give kilograms, or name the palm with --palm");
}

TEST(WeldLinksTest, LimitsOfADriverAreThoseOfItsFollowersToo) {
  Diagnostics problems;
  std::string urdf = ReplaceOnce(kSmallGripper, "<mimic joint=\"slide_left\"/>",
                                 "<mimic joint=\"slide_left\" multiplier=\"1.25\"/>");
  EXPECT_NEAR(Weld(urdf, problems).hand.joints[0].upper, 0.032, 1e-12);
}

/** The gripper on an arm of `num_joints` turning joints. */
std::string MakeArm(int num_joints) {
  std::string chain, link = "world";
  for (int j = 0; j < num_joints; ++j) {
    const std::string next = "arm" + std::to_string(j);
    chain += "<link name=\"" + next +
             "\"><collision><geometry><sphere radius=\"0.05\"/></geometry></collision></link>"
             "<joint name=\"j" +
             std::to_string(j) + "\" type=\"revolute\"><parent link=\"" + link +
             "\"/><child link=\"" + next +
             "\"/><origin xyz=\"0 0 0.1\"/><limit lower=\"-1\" upper=\"1\"/></joint>";
    link = next;
  }
  return ReplaceOnce(
      ReplaceOnce(kSmallGripper, "<parent link=\"world\"/>", "<parent link=\"" + link + "\"/>"),
      "</robot>", chain + "</robot>");
}

TEST(WeldLinksTest, AnArmIsLeftOutAndAWristStays) {
  Diagnostics problems;
  const ImportedHand with_wrist = Weld(MakeArm(2), problems);
  EXPECT_EQ(with_wrist.hand.num_joints(), 4);
  EXPECT_EQ(with_wrist.hand.links[0].name, "world");
  EXPECT_EQ(with_wrist.hand.links[with_wrist.hand.palm_link].name, "arm1");
  Diagnostics others;
  const ImportedHand cut = Weld(MakeArm(6), others);
  EXPECT_EQ(cut.hand.num_joints(), 2);
  EXPECT_NE(others.Format().find("the 6 joints above"), std::string::npos) << others.Format();
}

TEST(WeldLinksTest, AFixedJawIsADigitWhereItAloneIsFixedToThePalm) {
  const std::string vise = ReplaceOnce(kSmallGripper, "slide_right\" type=\"prismatic\"",
                                       "slide_right\" type=\"fixed\"");
  Diagnostics problems;
  const Hand hand = Weld(vise, problems).hand;
  EXPECT_EQ(problems.num_errors(), 0) << problems.Format();
  EXPECT_NE(problems.Format().find("link \"right\" is fixed to \"the hand\": the jaw on which "
                                   "\"left\" closes, taken as a digit"),
            std::string::npos)
      << problems.Format();
  ASSERT_EQ(hand.num_joints(), 1);
  const int jaw = hand.FindLink("right");
  ASSERT_GE(jaw, 0);
  EXPECT_EQ(hand.links[jaw].joint, -1);
  EXPECT_EQ(hand.links[jaw].parent, hand.palm_link);

  Diagnostics others;
  Weld(ReplaceOnce(vise, "</robot>",
                   "<link name=\"camera\"><visual><geometry><sphere radius=\"0.01\"/></geometry>"
                   "</visual></link><joint name=\"screws\" type=\"fixed\"><parent "
                   "link=\"the hand\"/><child link=\"camera\"/></joint></robot>"),
       others);
  EXPECT_NE(others.Format().find("one may be a fixed jaw, the only link"), std::string::npos)
      << others.Format();
}

TEST(WeldLinksTest, WithoutDigitsThereIsNoHand) {
  const auto told = [](const std::string& urdf, const std::string& palm = "") {
    Diagnostics problems;
    Weld(urdf, problems, palm);
    EXPECT_EQ(problems.num_errors(), 1);
    return problems.entries().back().text;
  };
  std::string fixed = kSmallGripper;
  for (const char* joint : {"left", "right"}) {
    fixed = ReplaceOnce(fixed, std::string("slide_") + joint + "\" type=\"prismatic\"",
                        std::string("slide_") + joint + "\" type=\"fixed\"");
  }
  EXPECT_EQ(told(fixed),
            "no joint moves anything that could touch: this is not a hand description");
  const std::string arm =
      ReplaceOnce(kSmallGripper, "<parent link=\"the hand\"/><child link=\"right",
                  "<parent link=\"left\"/><child link=\"right");
  EXPECT_EQ(told(arm),
            "the joints form one chain without digits: an arm, one finger, or one jaw. A hand has "
            "two digits at least; one may be a fixed jaw, the only link with a shape that is fixed "
            "to the palm");
  EXPECT_EQ(told(kSmallGripper, "hand"),
            "no link \"hand\" for the palm. Known: world, the hand, left, right");
}

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
  HandCandidate Find(const std::string& palm = "") {
    return FindHand(hand, MakeForeignTree(hand), std::vector<bool>(hand.links.size(), true), palm,
                    "rig.urdf", problems);
  }
  ForeignHand hand;
  Diagnostics problems;
};

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

}  // namespace
}  // namespace graspbench
