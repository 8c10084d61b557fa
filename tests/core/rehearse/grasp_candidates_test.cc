#include "core/rehearse/grasp_candidates.h"

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "core/grasp/predict_grasp.h"
#include "core/hand/load_hand.h"
#include "tests/core/rehearse/made_objects.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

TEST(GraspCandidates, ThePrincipalYawIsThatOfTheBar) {
  for (const double yaw_deg : {-60.0, -10.0, 0.0, 35.0, 80.0}) {
    const double yaw = RadFromDeg(yaw_deg);
    EXPECT_NEAR(CalcPrincipalYaw(MakeTurnedBar(kBar, yaw)), yaw, 1e-6) << yaw_deg;
  }
  EXPECT_EQ(CalcPrincipalYaw(MakeTurnedBar(Vector3d(0.04, 0.04, 0.05), 0.3)), 0.0);
}

// The rule sees the box about the turned bar; in the bar's own axes the hand stands as it stands to
// a bar that was never turned, turned with it.
TEST(GraspCandidates, TurnedByTheYawTheHandStandsAsItStandsToTheUnturned) {
  const Hand hand = LoadHand("tum");
  const double yaw = RadFromDeg(35.0);
  const GraspObject straight = MakeTurnedBar(kBar, 0.0), turned = MakeTurnedBar(kBar, yaw);
  for (const Approach approach : {Approach::kAbove, Approach::kSide}) {
    Grasp grasp = LoadStandardGrasps(hand)[1];
    grasp.approach = approach;
    const Placement own = CalcPlacement(hand, grasp, straight);
    const Placement other = CalcPlacement(hand, grasp, turned, {yaw, 0.0, 0.0});
    const Pose X_WV = MakePose(MakeRotationRpy(0.0, 0.0, yaw), Vector3d::Zero());
    // Stopped by a distance field on another grid.
    EXPECT_LT(((X_WV * own.X_WH).matrix() - other.X_WH.matrix()).cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_LT((X_WV.linear() * own.approach_W - other.approach_W).norm(), 1e-12);
    EXPECT_NEAR(own.closing_at_contact, other.closing_at_contact, 0.005 + 1e-12);
    EXPECT_EQ(own.reaches_object, other.reaches_object);
  }
}

TEST(GraspCandidates, AChangeOfPlaceMovesTheHandByIt) {
  const Hand hand = LoadHand("tum");
  const GraspObject bar = MakeTurnedBar(Vector3d(0.15, 0.025, 0.08), 0.0);
  Grasp grasp = LoadStandardGrasps(hand)[1];
  grasp.approach = Approach::kAbove;
  const double yaw = kPi;
  const Vector3d start = CalcPlacement(hand, grasp, bar, {yaw, 0.0, 0.0}).X_WH.translation();
  const Vector3d moved = CalcPlacement(hand, grasp, bar, {yaw, 0.01, 0.02}).X_WH.translation();
  // Of the axes turned by half a circle the first points back.
  EXPECT_NEAR((moved - start - Vector3d(-0.02, 0.0, 0.01)).norm(), 0.0, 1e-9);
}

TEST(GraspCandidates, TheFirstRoundIsThatOfTheRule) {
  const Hand hand = LoadHand("tum");
  const GraspObject bar = MakeTurnedBar(kBar, 0.0);
  const std::vector<Grasp> grasps = LoadStandardGrasps(hand);
  const CandidateMaker maker(hand, grasps, bar);
  const auto candidates = maker.ListByRule();
  ASSERT_EQ(candidates.size(), grasps.size());
  for (const Grasp& grasp : grasps) {
    const Grasp fitted = FitGrasp(hand, grasp, bar);
    const Grasp made = maker.Make({grasp.id, Approach::kAutomatic, {}, 0.0});
    EXPECT_EQ(made.q_pre, fitted.q_pre) << grasp.id;
    EXPECT_EQ(made.placement->X_WH.matrix(), CalcPlacement(hand, fitted, bar).X_WH.matrix());
    EXPECT_EQ(made.object, "bar");
  }
  GraspRank last{9, true, 9, 9.0};
  for (const GraspCandidate& candidate : candidates) {
    const Grasp made = maker.Make(candidate);
    const GraspRank rank = RankGrasp(made, PredictGrasp(hand, made, bar));
    EXPECT_FALSE(rank > last) << candidate.standard;
    last = rank;
  }
}

TEST(GraspCandidates, AnObjectThatSaysFromWhereIsObeyed) {
  const Hand hand = LoadHand("tum");
  GraspObject bar = MakeTurnedBar(kBar, 0.5);
  bar.approach = Approach::kAbove;
  const CandidateMaker maker(hand, LoadStandardGrasps(hand), bar);
  const auto turned = maker.ListByYaw();
  ASSERT_FALSE(turned.empty());
  for (const auto& candidates : {maker.ListByApproach(), turned}) {
    for (const GraspCandidate& candidate : candidates) {
      EXPECT_EQ(candidate.approach, Approach::kAbove);
    }
  }
}

}  // namespace
}  // namespace graspbench
