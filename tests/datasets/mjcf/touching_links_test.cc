#include "datasets/mjcf/touching_links.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

/** A palm and two digits of one link each, whose capsules lie along x at a height of their own. */
Hand MakeHand(double height_a, double height_b) {
  Hand hand;
  hand.links.resize(3);
  hand.digits.resize(2);
  const double heights[] = {0.0, height_a, height_b};
  for (int link = 0; link < 3; ++link) {
    if (link > 0) {
      hand.links[static_cast<size_t>(link)].parent = 0;
      hand.digits[static_cast<size_t>(link) - 1].links = {link};
    }
    LinkCapsule& capsule = hand.capsules.emplace_back();
    capsule.link = link;
    capsule.p_LA = {-0.05, 0.0, heights[link]};
    capsule.p_LB = {0.05, 0.0, heights[link]};
    capsule.radius = 0.01;
  }
  return hand;
}

TEST(TouchingLinks, AreThoseWhoseCapsulesMeetAtZero) {
  using Pairs = std::set<std::pair<int, int>>;
  EXPECT_EQ(FindLinksTouchingAtRest(MakeHand(0.0199, -0.0201)), (Pairs{{0, 1}}));
  EXPECT_EQ(FindLinksTouchingAtRest(MakeHand(0.0301, 0.0499)), (Pairs{{1, 2}}));
  EXPECT_EQ(FindLinksTouchingAtRest(MakeHand(0.03, -0.03)), Pairs{});
}

TEST(TouchingLinks, CrossedCapsulesMeetBetweenTheirEnds) {
  Hand hand = MakeHand(0.1, 0.119);
  hand.capsules[2].p_LA = {0.017, -0.05, 0.119};
  hand.capsules[2].p_LB = {0.017, 0.05, 0.119};
  EXPECT_EQ(FindLinksTouchingAtRest(hand).count({1, 2}), 1u);
}

TEST(TouchingLinks, ALinkOfTheSameDigitIsNone) {
  Hand hand = MakeHand(0.1, 0.11);
  hand.digits[0].links = {1, 2};
  hand.digits.resize(1);
  EXPECT_TRUE(FindLinksTouchingAtRest(hand).empty());
}

}  // namespace
}  // namespace graspbench
