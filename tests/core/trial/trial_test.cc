#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/trial/trial_runner.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

class TrialTest : public testing::TestWithParam<const char*> {
 protected:
  static TrialSetup MakeCubeSetup(double mass = 0.0122, double mu = 0.5) {
    return MakeSetup(GetParam(), "g2", MakeCube(mass, mu));
  }
  /** Of the light cube, run once a hand. */
  static const TrialResult& FindHeld() {
    static std::map<std::string, TrialResult> held;
    const auto found = held.find(GetParam());
    return found != held.end() ? found->second
                               : held.emplace(GetParam(), RunSetup(MakeCubeSetup())).first->second;
  }
};

TEST_P(TrialTest, ALightCubeIsLiftedAndHeldWithoutCreep) {
  const TrialResult& result = FindHeld();
  EXPECT_EQ(result.outcome, Outcome::kSuccess) << result.reason;
  EXPECT_NEAR(result.lift_height, 0.1, 0.01);
  EXPECT_EQ(result.num_unconverged, 0);
  EXPECT_LT(result.end_speed, 1e-6);
  EXPECT_LT(std::abs(result.energy_residual), 0.01);
  ASSERT_EQ(result.snapshots.size(), 3u);
  EXPECT_EQ(result.snapshots[0].moment, Moment::kPreGrasp);
  EXPECT_EQ(result.snapshots[2].moment, Moment::kLifted);
  // Two digits: forming and opposing are the same.
  EXPECT_EQ(result.timing.gft, result.timing.got);
  EXPECT_GE(result.timing.gct, result.timing.gft);
  EXPECT_LT(result.hold_creep, 1e-6);
  // The Shadow Hand's flesh gives way within its depth, from where penetration counts.
  if (GetParam() == std::string("shadow")) {
    EXPECT_EQ(result.steady_penetration, 0.0);
  } else {
    EXPECT_GT(result.steady_penetration, 0.0);
  }
  EXPECT_LE(result.steady_penetration, result.worst_penetration);
  ExpectSurvivesItsRecord(result);
}

TEST_P(TrialTest, ATouchIsKeptWithTheHandAsItWas) {
  const TrialResult& result = FindHeld();
  const TrialSetup setup = MakeCubeSetup();
  ASSERT_EQ(result.touches.size(), result.contacts.size());
  for (size_t i = 0; i < result.touches.size(); ++i) {
    const DigitTouch& touch = result.touches[i];
    // Closing is linear in time from the start of closure on.
    EXPECT_NEAR(touch.closing, result.contacts[i].time / setup.strategy.closure_time,
                1.5 * setup.sim.step);
    EXPECT_EQ(touch.smallest_gap, 0.0);
    // The joints of that digit lag a little behind what was asked.
    ASSERT_EQ(touch.q.size(), setup.hand->num_joints());
    const Eigen::VectorXd asked =
        setup.grasp.q_pre + touch.closing * (setup.grasp.q_target - setup.grasp.q_pre);
    EXPECT_LT((touch.q - asked).cwiseAbs().maxCoeff(), RadFromDeg(10.0));
  }
}

// The record of events and the times of first contact are kept apart and must agree.
TEST_P(TrialTest, EventsBeginWithTheFirstTouches) {
  const TrialResult& result = FindHeld();
  for (const DigitContact& contact : result.contacts) {
    double first = kUnset;
    for (const ContactEvent& event : result.contact_events) {
      if (event.digit == contact.digit) first = std::fmin(first, event.time);
    }
    // A graze shorter than 10 ms is a first contact, but no event.
    EXPECT_GE(first, contact.time - 1e-9) << contact.digit;
    EXPECT_LT(first, contact.time + 0.2) << contact.digit;
  }
  const char* const names[] = {"closure", "stabilisation", "lift-off", "hold", "done"};
  ASSERT_EQ(result.phases.size(), 5u);
  for (size_t i = 0; i < 5; ++i) EXPECT_EQ(result.phases[i].name, names[i]);
  EXPECT_EQ(result.phases[0].time, 0.0);
  const StrategyConfig strategy;
  EXPECT_NEAR(result.phases[3].time - result.phases[2].time, strategy.lift_time, 0.0021);
  EXPECT_NEAR(result.phases[4].time - result.phases[3].time, strategy.hold_time, 0.0021);
}

TEST_P(TrialTest, StabilityIsThatOfAHeldCube) {
  const Stability& stability = FindHeld().stability;
  EXPECT_EQ(stability.sigma, stability.hold.sigma);
  EXPECT_EQ(stability.sigma_proposed, stability.stabilisation.sigma_proposed);
  EXPECT_EQ(stability.stabilisation.num_samples, 20);
  EXPECT_EQ(stability.lift.num_samples, 10);
  EXPECT_EQ(stability.hold.num_samples, 10);
  for (const StabilityPart& part : {stability.stabilisation, stability.lift, stability.hold}) {
    EXPECT_GT(part.sigma, 0.0);
    EXPECT_LT(part.sigma, part.normal_force);
    EXPECT_GT(part.sigma_proposed, 0.0);
    EXPECT_LE(part.sigma_proposed, 10.0);
    EXPECT_GT(part.quality, 0.0);
    EXPECT_NEAR(part.opposition, 1.0, 1e-12);
  }
  EXPECT_LT(stability.hold.slip_speed, 1e-3);
}

// Without friction nothing can be lifted; nothing is glued.
TEST_P(TrialTest, WithoutFrictionTheCubeStaysBehind) {
  const TrialResult result = RunSetup(MakeCubeSetup(0.0122, 0.0));
  EXPECT_NE(result.outcome, Outcome::kSuccess);
  EXPECT_NE(result.outcome, Outcome::kNumericalFailure) << result.reason;
  EXPECT_LT(result.lift_height, 0.02);
  EXPECT_FALSE(result.reason.empty());
  EXPECT_EQ(result.stability.sigma, 0.0);
  EXPECT_TRUE(std::isnan(result.hold_creep));
  EXPECT_TRUE(std::isnan(result.steady_penetration));
}

TEST_P(TrialTest, ADigitThatCannotReachKeepsItsSmallestGap) {
  TrialSetup setup = MakeCubeSetup();
  setup.grasp.q_target = setup.grasp.q_pre;
  const TrialResult result = RunSetup(setup);
  EXPECT_EQ(result.outcome, Outcome::kNoContact);
  for (const DigitTouch& touch : result.touches) {
    EXPECT_TRUE(std::isnan(touch.closing));
    EXPECT_EQ(touch.q.size(), 0);
    EXPECT_GT(touch.smallest_gap, 0.0);
    EXPECT_LT(touch.smallest_gap, 0.1);
  }
}

// A pinch carries at most mu F of weight: 20 kg cannot be lifted by a few newton.
TEST_P(TrialTest, ATooHeavyCubeStaysBehind) {
  const TrialResult result = RunSetup(MakeCubeSetup(20.0));
  EXPECT_NE(result.outcome, Outcome::kSuccess);
  EXPECT_LT(0.5 * result.grip_force, 20.0 * kStandardGravity);
}

// Held: the judge's own smallest pull. Never lifted: the whole weight was not borne; no part of it
// that is not there.
TEST_P(TrialTest, StrengthIsTheWeakestPullOrTheWeightThatWasNotBorne) {
  TrialSetup setup = MakeCubeSetup();
  TrialRunner runner(setup.hand, setup.object);
  EXPECT_FALSE(runner.Run(setup).strength.has_value());
  setup.finds_strength = true;
  const JudgedTrial held = runner.Judge(setup);
  ASSERT_TRUE(held.judgement.has_value());
  EXPECT_EQ(held.result.strength, held.judgement->breaking_force);
  setup.grasp.q_target = setup.grasp.q_pre;
  EXPECT_DOUBLE_EQ(runner.Run(setup).strength.value(), -0.0122 * kStandardGravity);
}

TEST_P(TrialTest, AnObjectThatIsLostWhileLiftedIsWorthTheTimeItWasHeld) {
  TrialSetup setup = MakeCubeSetup();
  setup.finds_strength = true;
  const Eigen::VectorXd open = setup.grasp.q_pre;
  std::vector<double> strengths;
  for (const double time : {3.0, 3.5}) {  // the hand opens in lift-off, or later
    setup.drives.clear();
    for (size_t j = 0; j < setup.hand->joints.size(); ++j) {
      const HandJoint& joint = setup.hand->joints[j];
      if (joint.coupled_to < 0) {
        const int index = static_cast<int>(j);
        setup.drives.push_back({time, index, open[index]});
      }
    }
    strengths.push_back(RunSetup(setup).strength.value());
  }
  EXPECT_GT(strengths[0], -0.0122 * kStandardGravity);
  EXPECT_LT(strengths[0], strengths[1]);
  EXPECT_LT(strengths[1], 0.0);
}

TEST_P(TrialTest, AnImpossibleStateIsANumericalFailureWithItsReason) {
  TrialSetup setup = MakeCubeSetup();
  setup.draw.offset_x = std::nan("");
  const TrialResult result = RunSetup(setup);
  EXPECT_EQ(result.outcome, Outcome::kNumericalFailure);
  EXPECT_FALSE(result.reason.empty());
}

// A bottle that would end inside the palm is held as a real hand could, or not at all.
TEST(TrialRunner, TallThingsAreNeverHeldFromWithin) {
  for (const char* id : {"tum", "shadow"}) {
    const auto hand = std::make_shared<const Hand>(LoadHand(id));
    for (double height : {0.16, 0.25}) {
      const double z = 0.5 * height;
      GraspObject bottle = MakeSolid(
          MakeRevolution({{0.0, -z}, {0.025, -z}, {0.025, z}, {0.0, z}}, 48), 0.3, 0.5, 0.45);
      bottle.id = "bottle";
      const auto object = std::make_shared<const GraspObject>(bottle);
      TrialRunner runner(hand, object);
      for (const char* grasp : {"g1", "g5"}) {
        const TrialResult result = runner.Run(MakeSetup(hand, grasp, object));
        EXPECT_LT(result.worst_penetration, 0.001) << id << ' ' << grasp << ' ' << height;
        EXPECT_LT(result.grip_force, 200.0) << id << ' ' << grasp << ' ' << height;
        EXPECT_LT(std::abs(result.energy_residual), 0.001) << id << ' ' << grasp << ' ' << height;
      }
    }
  }
}

TEST(TrialRunner, RefusesAChainOfTooManyJoints) {
  Hand hand = MakeBareHand();
  hand.id = "snake";
  for (int i = 0; i < 13; ++i) {
    AddRodLink(hand, i, MakePose(Eigen::Vector3d(0, 0, 0.02)), Eigen::Vector3d::UnitX(), 0.01,
               0.02);
  }
  try {
    TrialRunner(std::make_shared<const Hand>(hand), MakeCube(0.1, 0.5));
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kUnsupported);
    EXPECT_STREQ(
        e.what(),
        "hand \"snake\" has 13 joints between its root and link \"link13\"; the simulation "
        "takes at most 12");
  }
}

INSTANTIATE_TEST_SUITE_P(Hands, TrialTest, testing::Values("tum", "shadow"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace graspbench
