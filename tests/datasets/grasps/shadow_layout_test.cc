#include "datasets/grasps/shadow_layout.h"

#include <gtest/gtest.h>

#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

std::vector<int> FindJoints(const Hand& hand) {
  std::vector<int> joints;
  for (const std::string& name : ListDexgraspbenchJoints()) joints.push_back(hand.FindJoint(name));
  return joints;
}

TEST(ShadowLayout, OurShadowHandIsThatOfMenagerie) {
  const Hand hand = LoadHand("shadow");
  EXPECT_LT(CalcShadowDifference(hand, FindJoints(hand)), 7e-6);
}

TEST(ShadowLayout, SeesALinkThatIsLongerAndAnAxisThatIsReversed) {
  Hand hand = LoadHand("shadow");
  hand.links[static_cast<size_t>(hand.FindLink("ffdistal"))].X_PJ.translation().z() += 0.003;
  EXPECT_NEAR(CalcShadowDifference(hand, FindJoints(hand)), 0.003, 1e-5);
  hand = LoadHand("shadow");
  hand.links[static_cast<size_t>(hand.FindLink("ffknuckle"))].axis *= -1.0;
  EXPECT_GT(CalcShadowDifference(hand, FindJoints(hand)), 0.02);
}

TEST(ShadowLayout, NamesOfDexgraspnetAreOneLess) {
  const std::vector<DexgraspnetJoint>& joints = ListDexgraspnetJoints();
  ASSERT_EQ(joints.size(), 22u);
  EXPECT_EQ(joints[0].name, "robot0:FFJ3");
  EXPECT_EQ(joints[0].maker, "FFJ4");
  EXPECT_EQ(joints[0].sign, -1.0);
  EXPECT_EQ(joints[8].sign, 1.0);  // RFJ4
  EXPECT_EQ(joints[12].name, "robot0:LFJ4");
  EXPECT_EQ(joints[12].maker, "LFJ5");
  EXPECT_EQ(joints[21].name, "robot0:THJ0");
}

}  // namespace
}  // namespace graspbench
