#include "core/trial/judge/verdicts.h"

#include <gtest/gtest.h>

#include "tests/core/trial/test_pinch.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kMu = 0.4, kMass = 0.05;
const Vector3d kDown(0.0, 0.0, -kStandardGravity);

std::vector<Verdict> JudgeAll(const HeldObject& held) {
  std::vector<Verdict> verdicts;
  for (const VerdictRule& rule : ListVerdictRules()) verdicts.push_back(rule.judge(held));
  return verdicts;
}

TEST(Verdicts, AFirmPinchPassesAll) {
  const TestPinch pinch(3.0, kMass, kMu, kDown);
  for (const Verdict& verdict : JudgeAll(pinch.MakeHeldObject())) {
    EXPECT_TRUE(verdict.passed) << verdict.rule;
  }
}

// Friction of 0.47 N under a weight of 0.49 N: held in free fall only. DexGraspBench pulls with
// 0.5 N along six axes, of which the fingers stop two.
TEST(Verdicts, AWeakPinchFailsThoseThatLoadIt) {
  const double force = 0.47 / (2.0 * kMu);
  const TestPinch pinch(force, kMass, kMu, Vector3d::Zero());
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
  const TestPinch pinch(1.0, kMass, kMu, kDown);
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
    const TestPinch pinch(force, kMass, kMu, kDown);
    const std::vector<Verdict> verdicts = JudgeAll(pinch.MakeHeldObject());
    for (size_t i = 0; i < scores.size(); ++i) {
      EXPECT_GE(verdicts[i].score, scores[i]) << verdicts[i].rule << " at " << force << " N";
      scores[i] = verdicts[i].score;
    }
  }
}

// The pull that the fingers' friction stands on top of the weight, in closed form.
TEST(Verdicts, TheNistPullIsFrictionLessWeight) {
  for (const double force : {1.0, 2.0, 4.0}) {
    const TestPinch pinch(force, kMass, kMu, kDown);
    const double friction = 2.0 * kMu * force;
    EXPECT_NEAR(JudgeAll(pinch.MakeHeldObject()).back().score, friction - kMass * kStandardGravity,
                0.03 * friction);
  }
}

}  // namespace
}  // namespace graspbench
