#include "core/trial/judge/judge.h"

#include <gtest/gtest.h>

#include "core/quality/grasp_quality.h"
#include "core/trial/measures/stability.h"
#include "tests/core/trial/test_pinch.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kPinchForce = 3.0, kPinchMu = 0.4, kPinchMass = 0.05;
const Vector3d kDown(0.0, 0.0, -kStandardGravity);

// Across the line of the fingers friction gives mu F at each; the weight counts. (Friction along a
// finger has a small lever about its pivot, which the closed form leaves out.)
TEST(Judge, APinchBreaksWhereFrictionEnds) {
  const TestPinch pinch(kPinchForce, kPinchMass, kPinchMu, kDown);
  const HeldObject held = pinch.MakeHeldObject();
  const double friction = 2.0 * kPinchMu * kPinchForce, weight = kPinchMass * kStandardGravity;
  EXPECT_NEAR(FindBreakingForce(held, Vector3d::UnitY()).load,
              std::sqrt(friction * friction - weight * weight), 0.03 * friction);
  EXPECT_NEAR(FindBreakingForce(held, -Vector3d::UnitZ()).load, friction - weight, 0.03 * friction);
  EXPECT_NEAR(FindBreakingForce(held, Vector3d::UnitZ()).load, friction + weight, 0.03 * friction);
  EXPECT_TRUE(FindBreakingForce(held, Vector3d::UnitZ()).is_broken);
}

// Along that line both drives are springs, k / L^2 each, until the object has moved by 20 mm.
TEST(Judge, AlongTheFingersTheDrivesGiveWay) {
  const TestPinch pinch(kPinchForce, kPinchMass, kPinchMu, Vector3d::Zero());
  const HeldObject held = pinch.MakeHeldObject();
  const double spring = 2.0 * TestPinch::kStiffness / (TestPinch::kLength * TestPinch::kLength);
  EXPECT_NEAR(FindBreakingForce(held, Vector3d::UnitX()).load, 0.02 * spring, 0.1 * 0.02 * spring);
}

// About that line the soft pads resist by mu F r each.
TEST(Judge, ATwistBreaksWhereTorsionEnds) {
  const TestPinch pinch(kPinchForce, kPinchMass, kPinchMu, Vector3d::Zero());
  const HeldObject held = pinch.MakeHeldObject();
  const double torsion = 2.0 * kPinchMu * kPinchForce * TestPinch::kTorsionRadius;
  const std::vector<BreakingLoad> loads = JudgeGrasp(held, {}).loads;
  for (const size_t i : {6, 7}) {
    EXPECT_EQ(loads[i].direction, i == 6 ? "moment +x" : "moment -x");
    EXPECT_NEAR(loads[i].load, torsion, 0.03 * torsion);
  }
}

TEST(Judge, TheSmallestOfSixIsTheBreakingForce) {
  TestPinch pinch(kPinchForce, kPinchMass, kPinchMu, kDown);
  const StabilityMeter meter(pinch.setup());
  const Judgement judgement =
      JudgeGrasp(pinch.MakeHeldObject(), meter.MakeInstant(pinch.world()).grasp.contacts);
  ASSERT_EQ(judgement.loads.size(), 12u);
  double smallest = 1e9;
  for (int i = 0; i < 6; ++i) smallest = std::min(smallest, judgement.loads[i].load);
  EXPECT_EQ(judgement.breaking_force, smallest);
  EXPECT_EQ(FindWeakestForce(pinch.MakeHeldObject()), smallest);
  EXPECT_EQ(judgement.loads[5].direction, "force -z");
  EXPECT_EQ(judgement.epsilons.size(), ListQualityConventions().size());
  EXPECT_GT(judgement.volume, 0.0);
  EXPECT_EQ(judgement.verdicts.size(), ListVerdictRules().size());
  const std::string text = RecordToJson(judgement).dump();
  Judgement back;
  ReadRecord(Json::parse(text), back);
  EXPECT_EQ(RecordToJson(back).dump(), text);
}

// Sigma predicts the pull that breaks the pinch before anybody pulls.
TEST(Judge, SigmaPredictsIt) {
  for (const double force : {1.5, 3.0, 6.0}) {
    TestPinch pinch(force, kPinchMass, kPinchMu, kDown);
    const StabilityPart part =
        CalcStabilityPart({StabilityMeter(pinch.setup()).MakeInstant(pinch.world())});
    EXPECT_NEAR(part.normal_force, 2.0 * force, 0.02 * force);
    const double breaking = FindBreakingForce(pinch.MakeHeldObject(), -Vector3d::UnitZ()).load;
    EXPECT_NEAR(part.sigma, breaking, 0.05 * breaking);
  }
}

std::vector<Verdict> JudgeAll(const HeldObject& held) {
  std::vector<Verdict> verdicts;
  for (const VerdictRule& rule : ListVerdictRules()) verdicts.push_back(rule.judge(held));
  return verdicts;
}

// Friction of 0.47 N under a weight of 0.49 N: held in free fall only. DexGraspBench pulls with
// 0.5 N along six axes, of which the fingers stop two.
TEST(Verdicts, AWeakPinchFailsThoseThatLoadIt) {
  const double force = 0.47 / (2.0 * kPinchMu);
  const TestPinch pinch(force, kPinchMass, kPinchMu, Vector3d::Zero());
  const std::vector<Verdict> verdicts = JudgeAll(pinch.MakeHeldObject());
  ASSERT_EQ(verdicts.size(), 5u);
  EXPECT_TRUE(verdicts[0].passed);
  EXPECT_FALSE(verdicts[1].passed);
  EXPECT_EQ(verdicts[1].score, 2.0);
  EXPECT_TRUE(verdicts[2].passed);  // it turns nothing where there is no gravity
  EXPECT_FALSE(verdicts[3].passed);
  EXPECT_LT(verdicts[3].score, 6.0);
  EXPECT_FALSE(verdicts[4].passed);
  EXPECT_NEAR(verdicts[4].score, 0.47, 0.02);
}

TEST(Verdicts, AnEmptyHandFailsAll) {
  const Judgement judgement = MakeEmptyHandJudgement();
  EXPECT_EQ(judgement.breaking_force, 0.0);
  ASSERT_EQ(judgement.verdicts.size(), ListVerdictRules().size());
  for (const Verdict& verdict : judgement.verdicts) EXPECT_FALSE(verdict.passed);
}

// What a rule does to the object is done to its own copy.
TEST(Verdicts, LeaveTheHeldObjectAlone) {
  const TestPinch pinch(1.0, kPinchMass, kPinchMu, kDown);
  const HeldObject held = pinch.MakeHeldObject();
  const WorldState before = held.world().state();
  const std::vector<Verdict> first = JudgeAll(held), second = JudgeAll(held);
  EXPECT_EQ(held.world().state().p_WOcm, before.p_WOcm);
  EXPECT_EQ(held.world().state().gravity_W, before.gravity_W);
  EXPECT_EQ(held.time(), 0.0);
  for (size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].score, second[i].score);
}

TEST(Verdicts, AFirmerPinchScoresNoLessUnderAnyRule) {
  std::vector<double> scores(ListVerdictRules().size(), 0.0);
  for (const double force : {0.65, 0.8, 1.5, 3.0}) {
    const TestPinch pinch(force, kPinchMass, kPinchMu, kDown);
    const std::vector<Verdict> verdicts = JudgeAll(pinch.MakeHeldObject());
    for (size_t i = 0; i < scores.size(); ++i) {
      EXPECT_GE(verdicts[i].score, scores[i]) << verdicts[i].rule << " at " << force << " N";
      EXPECT_TRUE(verdicts[i].passed || force < 3.0) << verdicts[i].rule;
      scores[i] = verdicts[i].score;
    }
  }
}

// The pull that the fingers' friction stands on top of the weight, in closed form.
TEST(Verdicts, TheNistPullIsFrictionLessWeight) {
  for (const double force : {1.0, 2.0, 4.0}) {
    const TestPinch pinch(force, kPinchMass, kPinchMu, kDown);
    const double friction = 2.0 * kPinchMu * force;
    EXPECT_NEAR(JudgeAll(pinch.MakeHeldObject()).back().score,
                friction - kPinchMass * kStandardGravity, 0.03 * friction);
  }
}

}  // namespace
}  // namespace graspbench
