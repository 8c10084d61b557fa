#include "core/hand/self_contact.h"

#include <gtest/gtest.h>

#include "core/base/random.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

Vector3d DrawPoint(RandomStream& stream) {
  return {stream.NextUniform(-1, 1), stream.NextUniform(-1, 1), stream.NextUniform(-1, 1)};
}

TEST(ClosestPointsTest, NoOtherPairIsCloser) {
  RandomStream stream("1", "segments");
  for (int trial = 0; trial < 50; ++trial) {
    const Vector3d a0 = DrawPoint(stream), a1 = trial % 7 ? DrawPoint(stream) : a0;
    const Vector3d b0 = DrawPoint(stream), b1 = trial % 5 ? DrawPoint(stream) : b0;
    const ClosestPoints found = FindClosestPoints(a0, a1, b0, b1);
    const double distance = (found.on_a - found.on_b).norm();
    double nearest = 1e9;
    constexpr int kSteps = 100;
    for (int i = 0; i <= kSteps; ++i) {
      for (int k = 0; k <= kSteps; ++k) {
        const Vector3d a = a0 + (a1 - a0) * i / kSteps, b = b0 + (b1 - b0) * k / kSteps;
        nearest = std::min(nearest, (a - b).norm());
      }
    }
    EXPECT_LE(distance, nearest + 1e-12) << trial;
    EXPECT_GE(distance, nearest - 0.04) << trial;
  }
}

/** A palm and two fingers of one link each, which stand along z. */
Hand MakeHand() {
  Hand hand;
  hand.links.resize(3);
  for (const int finger : {1, 2}) {
    hand.links[static_cast<size_t>(finger)].parent = 0;
    hand.links[static_cast<size_t>(finger)].X_PJ =
        MakePose(Vector3d(finger == 1 ? 0.03 : -0.03, 0, 0.02));
    Digit digit;
    digit.links = {finger};
    hand.digits.push_back(digit);
    hand.capsules.push_back({finger, Vector3d::Zero(), Vector3d(0, 0, 0.05), 0.008});
  }
  return hand;
}

TEST(CapsulePairsTest, FingersMeetButNotThemselvesNorWhatTheyAreBuiltOn) {
  Hand hand = MakeHand();
  ASSERT_EQ(FindCapsulePairs(hand).size(), 1u);
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::VectorXd());
  EXPECT_NEAR(CalcCapsuleGap(hand, FindCapsulePairs(hand).front(), X_HL), 0.06 - 0.016, 1e-12);
  hand.capsules.push_back({1, Vector3d(0, 0.05, 0), Vector3d(0, 0.05, 0.05), 0.008});
  EXPECT_EQ(FindCapsulePairs(hand).size(), 2u);  // each of the first finger with the second
  // A palm that the fingers stand in.
  hand.capsules.push_back({0, Vector3d(-0.05, 0, 0.02), Vector3d(0.05, 0, 0.02), 0.01});
  EXPECT_EQ(FindCapsulePairs(hand).size(), 3u);  // and with what stands free of it
}

}  // namespace
}  // namespace graspbench
