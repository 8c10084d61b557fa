#include "core/trial/judge/judge.h"

#include <gtest/gtest.h>

#include "core/quality/quality_convention.h"
#include "core/trial/judge/verdicts.h"
#include "core/trial/measures/stability_meter.h"
#include "tests/core/trial/test_pinch.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kForce = 3.0, kMu = 0.4, kMass = 0.05;
const Vector3d kDown(0.0, 0.0, -kStandardGravity);

// Across the line of the fingers friction gives mu F at each; the weight counts. (Friction along a
// finger has a small lever about its pivot, which the closed form leaves out.)
TEST(Judge, APinchBreaksWhereFrictionEnds) {
  const TestPinch pinch(kForce, kMass, kMu, kDown);
  const HeldObject held = pinch.MakeHeldObject();
  const double friction = 2.0 * kMu * kForce, weight = kMass * kStandardGravity;
  EXPECT_NEAR(FindBreakingForce(held, Vector3d::UnitY()).load,
              std::sqrt(friction * friction - weight * weight), 0.03 * friction);
  EXPECT_NEAR(FindBreakingForce(held, -Vector3d::UnitZ()).load, friction - weight, 0.03 * friction);
  EXPECT_NEAR(FindBreakingForce(held, Vector3d::UnitZ()).load, friction + weight, 0.03 * friction);
  EXPECT_TRUE(FindBreakingForce(held, Vector3d::UnitZ()).is_broken);
}

// Along that line both drives are springs, k / L^2 each, until the object has moved by 20 mm.
TEST(Judge, AlongTheFingersTheDrivesGiveWay) {
  const TestPinch pinch(kForce, kMass, kMu, Vector3d::Zero());
  const HeldObject held = pinch.MakeHeldObject();
  const double spring = 2.0 * TestPinch::kStiffness / (TestPinch::kLength * TestPinch::kLength);
  EXPECT_NEAR(FindBreakingForce(held, Vector3d::UnitX()).load, 0.02 * spring, 0.1 * 0.02 * spring);
}

// About that line the soft pads resist by mu F r each.
TEST(Judge, ATwistBreaksWhereTorsionEnds) {
  const TestPinch pinch(kForce, kMass, kMu, Vector3d::Zero());
  const HeldObject held = pinch.MakeHeldObject();
  const double torsion = 2.0 * kMu * kForce * TestPinch::kTorsionRadius;
  const std::vector<BreakingLoad> loads = JudgeGrasp(held, {}).loads;
  for (const size_t i : {6, 7}) {
    EXPECT_EQ(loads[i].direction, i == 6 ? "moment +x" : "moment -x");
    EXPECT_NEAR(loads[i].load, torsion, 0.03 * torsion);
  }
}

TEST(Judge, TheSmallestOfSixIsTheBreakingForce) {
  TestPinch pinch(kForce, kMass, kMu, kDown);
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
    TestPinch pinch(force, kMass, kMu, kDown);
    const StabilityPart part =
        CalcStabilityPart({StabilityMeter(pinch.setup()).MakeInstant(pinch.world())});
    EXPECT_NEAR(part.normal_force, 2.0 * force, 0.02 * force);
    const double breaking = FindBreakingForce(pinch.MakeHeldObject(), -Vector3d::UnitZ()).load;
    EXPECT_NEAR(part.sigma, breaking, 0.05 * breaking);
  }
}

}  // namespace
}  // namespace graspbench
