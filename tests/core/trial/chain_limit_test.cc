#include "core/trial/chain_limit.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/physics/contact.h"
#include "core/physics/known_answers/small_scenes.h"
#include "core/trial/protocols/free_space.h"

namespace graspbench {
namespace {

Hand MakeChain(int num_joints) {
  Hand hand = MakeBareHand();
  for (int i = 0; i < num_joints; ++i) {
    AddRodLink(hand, i, Pose::Identity(), Eigen::Vector3d::UnitX(), 0.01, 0.02);
    hand.contact_spheres.push_back({i + 1, Eigen::Vector3d::Zero(), 0.005});
  }
  return hand;
}

TEST(DemandShortChains, TakesWhatTheSolverHolds) {
  EXPECT_NO_THROW(DemandShortChains(MakeChain(ContactPoint::kMaxChain)));
  EXPECT_THROW(DemandShortChains(MakeChain(ContactPoint::kMaxChain + 1)), Error);
}

// Where a grasp of such a hand is judged, that is its result.
TEST(DemandShortChains, IsAResultOfAFreeGrasp) {
  const int num_joints = ContactPoint::kMaxChain + 1;
  const ProfiledScene scene{std::make_shared<const Hand>(MakeChain(num_joints)),
                            std::make_shared<const GraspObject>(MakeBlock(0.1)),
                            Pose::Identity(),
                            {{"grasp", Pose::Identity(), Eigen::VectorXd::Zero(num_joints)}},
                            0,
                            ""};
  const FreeSpaceResult result = RunFreeSpace(scene, FreeSpaceProfile());
  EXPECT_FALSE(result.passed);
  EXPECT_TRUE(result.is_numerical);
  EXPECT_NE(result.reason.find("at most"), std::string::npos) << result.reason;
}

}  // namespace
}  // namespace graspbench
