#include "core/develop/posture_changes.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

class PostureChangesTest : public testing::Test {
 protected:
  PostureChangesTest()
      : hand_(LoadHand("tum-evolved")), grasp_(LoadStandardGrasps(hand_).front()) {}

  double Change(const Grasp& changed, const char* joint) const {
    const int j = hand_.FindJoint(joint);
    return DegFromRad(changed.q_target[j] - grasp_.q_target[j]);
  }

  Hand hand_;
  Grasp grasp_;
};

// Three joints of the thumb and three that both fingers share, before and after closing, and the
// tilt.
TEST_F(PostureChangesTest, FingersOfOneBuildChangeTogether) {
  const PostureChanges changes(hand_, grasp_);
  const SearchSpace space = changes.MakeSpace();
  ASSERT_EQ(space.size(), 13);
  const Grasp same = changes.Apply(space.start);
  EXPECT_LT((same.q_pre - grasp_.q_pre).norm() + (same.q_target - grasp_.q_target).norm(), 1e-9);
  int num_shared = 0, num_single = 0;
  for (int g = 6; g < 12; ++g) {
    Eigen::VectorXd x = space.start;
    x[g] = RadFromDeg(3.0);
    const Grasp changed = changes.Apply(x);
    EXPECT_LT((changed.q_pre - grasp_.q_pre).norm(), 1e-9);
    for (const char* joint : {"q1", "q2", "q3"}) {
      const double of_index = Change(changed, ("FF" + std::string(joint)).c_str());
      const double of_thumb = Change(changed, ("TH" + std::string(joint)).c_str());
      EXPECT_NEAR(of_index, Change(changed, ("MF" + std::string(joint)).c_str()), 1e-9);
      num_shared += std::abs(of_index - 3.0) < 1e-9;
      num_single += std::abs(of_thumb - 3.0) < 1e-9;
    }
  }
  EXPECT_EQ(num_shared, 3);
  EXPECT_EQ(num_single, 3);
}

TEST_F(PostureChangesTest, MirroredJointsChangeAgainstEachOther) {
  hand_.joints[hand_.FindJoint("FFq2")].lower = -1.0;
  hand_.joints[hand_.FindJoint("FFq2")].upper = 0.2;
  hand_.joints[hand_.FindJoint("MFq2")].lower = -0.2;
  hand_.joints[hand_.FindJoint("MFq2")].upper = 1.0;
  grasp_.q_target.setZero();
  const PostureChanges changes(hand_, grasp_);
  bool is_found = false;
  for (int g = 0; g < 13; ++g) {
    Eigen::VectorXd x = changes.MakeSpace().start;
    x[g] = RadFromDeg(3.0);
    const double of_index = Change(changes.Apply(x), "FFq2");
    if (std::abs(of_index) < 1.0) continue;
    is_found = true;
    EXPECT_NEAR(Change(changes.Apply(x), "MFq2"), -of_index, 1e-9);
  }
  EXPECT_TRUE(is_found);
}

}  // namespace
}  // namespace graspbench
