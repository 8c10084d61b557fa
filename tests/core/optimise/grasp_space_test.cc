#include "core/optimise/grasp_space.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/random.h"
#include "core/base/units.h"
#include "core/hand/hand.h"
#include "core/hand/load_hand.h"
#include "core/optimise/grasp_optimiser.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

const GraspObject& Ball() {
  static const GraspObject ball = [] {
    GraspObject object;
    object.id = "ball";
    object.size = Vector3d::Constant(0.05);
    object.field = std::make_shared<const SignedDistanceField>(
        SignedDistanceField::Build(MakeSphere(0.025, 24)));
    return object;
  }();
  return ball;
}

struct Case {
  const char* hand;
  size_t grasp;
};

class GraspSpaceTest : public testing::TestWithParam<Case> {
 protected:
  GraspSpaceTest()
      : hand_(LoadHand(GetParam().hand)),
        grasp_(MakeObjectGrasp(hand_, Ball(), LoadStandardGrasps(hand_).at(GetParam().grasp),
                               "made")) {}

  std::unique_ptr<GraspSpace> Make(const std::string& name) const {
    return MakeGraspSpace(name, {hand_, Ball(), grasp_});
  }

  Hand hand_;
  Grasp grasp_;
};

TEST_P(GraspSpaceTest, TheStartIsTheGraspToTheBit) {
  for (const std::string& name : ListGraspSpaces()) {
    const auto space = Make(name);
    const Grasp same = space->MakeGrasp(space->box().start);
    EXPECT_EQ(same.q_pre, grasp_.q_pre) << name;
    EXPECT_EQ(same.q_target, grasp_.q_target) << name;
    EXPECT_EQ(same.placement->X_WH.matrix(), grasp_.placement->X_WH.matrix()) << name;
    EXPECT_EQ(space->box().size(), static_cast<int>(space->coordinates().size()));
  }
}

// Anywhere in the box: limits, 25 degrees, coupling, and only what the space may change.
TEST_P(GraspSpaceTest, KeepsTheRulesEverywhere) {
  RandomStream stream("rules", "test");
  for (const std::string& name : ListGraspSpaces()) {
    const auto space = Make(name);
    const SearchSpace& box = space->box();
    for (int k = 0; k < 50; ++k) {
      VectorXd genome = DrawUniformPoint(box, stream);
      if (k == 0) genome = box.lower;
      if (k == 1) genome = box.upper;
      const Grasp grasp = space->MakeGrasp(genome);
      EXPECT_EQ(grasp.q_pre, grasp_.q_pre) << name;
      VectorXd coupled = grasp.q_target;
      ApplyCoupling(hand_, coupled);
      EXPECT_EQ(coupled, grasp.q_target) << name;
      for (size_t d = 0; d < hand_.digits.size(); ++d) {
        const Digit& digit = hand_.digits[d];
        const bool grasps = std::count(grasp_.digits.begin(), grasp_.digits.end(), digit.id) > 0;
        const bool is_opposing = static_cast<int>(d) == FindOpposingDigit(hand_, grasp_);
        for (const int joint : FindDrivenJoints(hand_, digit)) {
          const HandJoint& limits = hand_.joints[joint];
          const double change = grasp.q_target[joint] - grasp_.q_target[joint];
          EXPECT_LE(std::abs(change), RadFromDeg(25.0) + 1e-12) << name;
          EXPECT_GE(grasp.q_target[joint], limits.lower - 1e-12) << name;
          EXPECT_LE(grasp.q_target[joint], limits.upper + 1e-12) << name;
          const bool may_change = name == "thumb" ? is_opposing : name != "hand-pose" && grasps;
          if (!may_change) {
            EXPECT_EQ(change, 0.0) << name << " " << limits.name;
          }
        }
      }
      EXPECT_EQ(grasp.placement->X_WH.isApprox(grasp_.placement->X_WH, 1e-9), name != "hand-pose");
    }
  }
}

// A shift and a turn of the hand about the ball's centre, in closed form, where nothing is in the
// way: away from the table and not towards the ball.
TEST_P(GraspSpaceTest, TheHandIsShiftedAndTurnedAboutTheObject) {
  const auto space = Make("hand-pose");
  ASSERT_EQ(space->coordinates()[2].name, "hand_z");
  VectorXd genome = VectorXd::Zero(6);
  genome[2] = 0.1;  // 4 mm up
  const Pose X_WH = grasp_.placement->X_WH;
  const Pose up = space->MakeGrasp(genome).placement->X_WH;
  EXPECT_LT((up.translation() - X_WH.translation() - Vector3d(0, 0, 0.004)).norm(), 1e-12);
  EXPECT_LT((up.linear() - X_WH.linear()).norm(), 1e-12);

  genome[5] = RadFromDeg(10.0);  // about the vertical
  const Pose turned = space->MakeGrasp(genome).placement->X_WH;
  const Vector3d p = X_WH.translation(), q = turned.translation();
  EXPECT_NEAR(q.x(), std::cos(genome[5]) * p.x() - std::sin(genome[5]) * p.y(), 1e-12);
  EXPECT_NEAR(q.y(), std::sin(genome[5]) * p.x() + std::cos(genome[5]) * p.y(), 1e-12);
  EXPECT_NEAR(Eigen::AngleAxisd(X_WH.linear().transpose() * turned.linear()).angle(), genome[5],
              1e-9);
}

INSTANTIATE_TEST_SUITE_P(Hands, GraspSpaceTest,
                         testing::Values(Case{"tum-evolved", 0}, Case{"tum-evolved", 1},
                                         Case{"tum-evolved", 2}, Case{"shadow", 0},
                                         Case{"shadow", 1}, Case{"shadow", 4}),
                         [](const auto& test) {
                           const std::string hand = test.param.hand;
                           return hand.substr(0, hand.find('-')) + std::to_string(test.param.grasp);
                         });

TEST(GraspSpace, SynergiesAreTheDirectionsInWhichThePosturesDiffer) {
  const Hand hand = LoadHand("tum-evolved");
  const std::vector<Grasp> all = LoadStandardGrasps(hand);
  const Grasp start = MakeObjectGrasp(hand, Ball(), all.at(2), "made");
  const auto space = MakeGraspSpace("synergy", {hand, Ball(), start});
  // Each posture minus the mean of all lies in their span; so does every direction of the space
  // that starts within all limits.
  std::vector<VectorXd> postures;
  for (const Grasp& grasp : all) {
    if (grasp.digits.size() < 3) continue;
    postures.push_back(grasp.q_pre);
    postures.push_back(grasp.q_target);
  }
  Eigen::MatrixXd span(hand.num_joints(), postures.size());
  VectorXd mean = VectorXd::Zero(hand.num_joints());
  for (const VectorXd& q : postures) mean += q / static_cast<double>(postures.size());
  for (size_t k = 0; k < postures.size(); ++k) {
    span.col(static_cast<Eigen::Index>(k)) = postures[k] - mean;
  }
  constexpr double kStep = 1e-3;
  for (int k = 0; k < space->box().size(); ++k) {
    VectorXd genome = VectorXd::Zero(space->box().size());
    genome[k] = kStep;
    const VectorXd change = space->MakeGrasp(genome).q_target - start.q_target;
    EXPECT_NEAR(change.cwiseAbs().maxCoeff(), kStep, 1e-9);
    const VectorXd weights = span.completeOrthogonalDecomposition().solve(change);
    EXPECT_LT((span * weights - change).norm(), 1e-9) << k;
  }
}

TEST(GraspSpace, RefusesSynergiesOfTooFewPostures) {
  const Hand hand = LoadHand("tum-original");  // it can do one grasp only
  const Grasp grasp = MakeObjectGrasp(hand, Ball(), LoadStandardGrasps(hand).front(), "made");
  try {
    MakeGraspSpace("synergy", {hand, Ball(), grasp});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kUnsupported);
    EXPECT_EQ(std::string(e.what()),
              "the synergies of \"tum-original\" need 4 postures of its standard grasps in which "
              "the same digits grasp, it has 2; search another space, or develop more grasps "
              "(graspbench hand develop)");
  }
}

// Delays, and nothing else, of the digits that grasp; what they are at the start stays within.
TEST(ClosingSpace, ChangesWhenDigitsClose) {
  const Hand hand = LoadHand("tum");
  Grasp grasp = MakeObjectGrasp(hand, Ball(), LoadStandardGrasps(hand).at(2), "made");
  grasp.closing["FF"] = {0.6, 1.5};
  const auto space = MakeGraspSpace("closing", {hand, Ball(), grasp});
  EXPECT_EQ(space->box().size(), static_cast<int>(grasp.digits.size()));
  EXPECT_EQ(space->MakeGrasp(space->box().start).closing, grasp.closing);
  const Grasp late = space->MakeGrasp(space->box().upper);
  for (const std::string& digit : grasp.digits) {
    EXPECT_NEAR(late.closing.at(digit).delay, digit == "FF" ? 0.6 : 0.5 * RadFromDeg(25.0), 1e-12);
  }
  EXPECT_EQ(late.closing.at("FF").speed, 1.5);
  EXPECT_EQ(late.q_target, grasp.q_target);
  EXPECT_EQ(space->MakeGrasp(space->box().lower).closing.at("FF").delay, 0.0);
}

}  // namespace
}  // namespace graspbench
