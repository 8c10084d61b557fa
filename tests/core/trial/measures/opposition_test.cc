#include "core/trial/measures/opposition.h"

#include <gtest/gtest.h>

#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

class OppositionTest : public ::testing::Test {
 protected:
  HandContact Make(const char* link, const Vector3d& nhat_L, double force) const {
    HandContact contact;
    contact.link = hand_.FindLink(link);
    contact.nhat_W = X_WL_[static_cast<size_t>(contact.link)].linear() * nhat_L;
    contact.normal_force = force;
    return contact;
  }
  Opposition Find(const std::vector<HandContact>& contacts) const {
    return FindOpposition(hand_, X_WL_, contacts);
  }

  const Hand hand_ = LoadHand("shadow");
  const std::vector<Pose> X_WL_ =
      CalcLinkPoses(hand_, Eigen::VectorXd::Constant(hand_.num_joints(), 0.3));
  // In a finger's links x runs along the axis of flexion, and -y out of the pad.
  const Vector3d pad_ = -Vector3d::UnitY(), side_ = Vector3d::UnitX();
};

TEST_F(OppositionTest, PadsAgainstEachOther) {
  EXPECT_EQ(Find({Make("thdistal", pad_, 1.0), Make("ffdistal", pad_, 1.0)}), Opposition::kPad);
  EXPECT_EQ(Find({Make("thmiddle", pad_, 1.0), Make("ffproximal", pad_, 1.0)}), Opposition::kPad);
}

// Thumb against the index's side, and the sides of two fingers.
TEST_F(OppositionTest, ASideThatBears) {
  EXPECT_EQ(Find({Make("thdistal", pad_, 1.0), Make("ffmiddle", side_, 1.0)}), Opposition::kSide);
  EXPECT_EQ(Find({Make("ffdistal", -side_, 1.0), Make("mfdistal", side_, 1.0)}), Opposition::kSide);
  // 40 and 50 degrees from the axis, and a side that hardly presses.
  for (const double angle : {40.0, 50.0}) {
    const Vector3d oblique =
        std::cos(RadFromDeg(angle)) * side_ + std::sin(RadFromDeg(angle)) * pad_;
    EXPECT_EQ(Find({Make("thdistal", pad_, 1.0), Make("ffdistal", oblique, 1.0)}),
              angle < 45.0 ? Opposition::kSide : Opposition::kPad);
  }
  EXPECT_EQ(Find({Make("thdistal", pad_, 1.0), Make("ffdistal", pad_, 1.0),
                  Make("mfdistal", side_, 0.9)}),
            Opposition::kPad);
}

TEST_F(OppositionTest, ThePalmFromATenthOn) {
  const auto with_palm = [&](double force) {
    return Find(
        {Make("palm", pad_, force), Make("thdistal", pad_, 1.0), Make("ffdistal", pad_, 1.0)});
  };
  EXPECT_EQ(with_palm(0.23), Opposition::kPalm);
  EXPECT_EQ(with_palm(0.21), Opposition::kPad);
}

}  // namespace
}  // namespace graspbench
