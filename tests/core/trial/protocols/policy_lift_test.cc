// The digits in the hands of a controller. The oracle is table_lift: a controller that asks for what
// the strategy asks for has its trial, to the last byte.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "core/arm/load_arm.h"
#include "core/arm/mounted_arm.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/render/scene.h"
#include "core/trial/policy/hand_policy.h"
#include "core/trial/protocols/protocol.h"
#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

/** Closes evenly and says done after some questions. */
class EvenClosing : public HandPolicy {
 public:
  explicit EvenClosing(int done_after) : done_after_(done_after) {}

  void Begin(const PolicyView& view) override {
    num_asked_ = 0;
    start_ = view.targets;
    target_ = view.targets;
    for (size_t i = 0; i < view.driven.size(); ++i) {
      target_[static_cast<Eigen::Index>(i)] = view.setup.grasp.q_target[view.driven[i]];
    }
  }
  PolicyAction Answer(const PolicyView& view) override {
    ++num_asked_;
    closing_ = num_asked_ == 1 ? 0.0 : closing_;
    closing_ =
        std::min(1.0, closing_ + view.setup.policy.period / view.setup.strategy.closure_time);
    times_.push_back(view.time);
    PolicyAction action;
    action.rows = (start_ + closing_ * (target_ - start_)).transpose();
    action.is_done = num_asked_ >= done_after_;
    return action;
  }
  const std::vector<double>& times() const { return times_; }

 private:
  int done_after_, num_asked_ = 0;
  double closing_ = 0.0;
  Eigen::VectorXd start_, target_;
  std::vector<double> times_;
};

TrialSetup MakePolicySetup(const char* hand, std::shared_ptr<HandPolicy> controller) {
  TrialSetup setup = MakeSetup(hand, "g2", MakeCube(0.0122, 0.5));
  setup.protocol = "policy_lift";
  setup.policy.command = "a test's";
  setup.controller = std::move(controller);
  return setup;
}

/** Of a result the JSON without what the controller did. */
std::string FormatWithoutPolicy(TrialResult result) {
  result.policy.reset();
  return ToJson(result).dump();
}

class PolicyLiftTest : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Hands, PolicyLiftTest, testing::Values("tum", "shadow"));

TEST_P(PolicyLiftTest, WhatTheStrategyAsksForGivesItsTrial) {
  TrialSetup plain = MakeSetup(GetParam(), "g2", MakeCube(0.0122, 0.5));
  plain.draw.joint_error.setConstant(0.003);
  const TrialResult expected = RunSetup(plain);
  ASSERT_TRUE(IsSuccess(expected.outcome)) << expected.reason;
  double closure = 0.0, lift = 0.0;
  for (const PhaseStart& phase : expected.phases) {
    if (phase.name == NameOf(Phase::kClosure)) closure = phase.time;
    if (phase.name == NameOf(Phase::kLiftOff)) lift = phase.time;
  }
  // The step in which closure begins is not the controller's.
  const int num_asked = static_cast<int>(std::lround((lift - closure) / plain.sim.step));
  TrialSetup setup = MakePolicySetup(GetParam(), std::make_shared<EvenClosing>(num_asked));
  setup.draw = plain.draw;
  setup.policy.period = setup.sim.step;
  const TrialResult result = RunSetup(setup);
  EXPECT_EQ(FormatWithoutPolicy(result), ToJson(expected).dump());
  ASSERT_TRUE(result.policy);
  EXPECT_EQ(result.policy->num_questions, num_asked);
  EXPECT_TRUE(result.policy->said_done);
  EXPECT_EQ(result.policy->num_cut, 0);
  ExpectSurvivesItsRecord(result);
}

TEST_P(PolicyLiftTest, ItsRecordRepeatsItWithoutTheController) {
  TrialSetup setup = MakePolicySetup(GetParam(), std::make_shared<EvenClosing>(90));
  const TrialResult result = RunSetup(setup);
  setup.controller = MakeRecordedPolicy(*result.policy);
  EXPECT_EQ(ToJson(RunSetup(setup)), ToJson(result));
  EXPECT_EQ(ToJson(RunSetup(setup)), ToJson(result)) << "and once more";
}

TEST_P(PolicyLiftTest, IsAskedEveryControlPeriodUntilItsTimeIsOver) {
  const auto controller = std::make_shared<EvenClosing>(1000000);
  TrialSetup setup = MakePolicySetup(GetParam(), controller);
  setup.policy.time = 0.9;
  const TrialResult result = RunSetup(setup);
  ASSERT_EQ(controller->times().size(), 45u);
  for (size_t i = 0; i < 45; ++i) EXPECT_NEAR(controller->times()[i], 0.02 * double(i), 1e-12);
  EXPECT_FALSE(result.policy->said_done);
  EXPECT_EQ(result.policy->num_questions, 45);
}

/** Answers with rows as a test wants them. */
class FixedAnswer : public HandPolicy {
 public:
  std::function<PolicyAction(const PolicyView&)> answer;
  void Begin(const PolicyView&) override {}
  PolicyAction Answer(const PolicyView& view) override { return answer(view); }
};

TEST_P(PolicyLiftTest, WhatIsBeyondLimitsIsCutAndCounted) {
  const auto controller = std::make_shared<FixedAnswer>();
  int num_asked = 0;
  controller->answer = [&](const PolicyView& view) {
    PolicyAction action;
    action.rows = Eigen::MatrixXd::Constant(3, view.targets.size(), 0.0);
    action.rows(0, 0) = 100.0;
    action.are_increments = true;
    action.is_done = ++num_asked == 2;
    return action;
  };
  TrialSetup setup = MakePolicySetup(GetParam(), controller);
  setup.policy.execute_steps = 2;
  const TrialResult result = RunSetup(setup);
  EXPECT_EQ(result.policy->rows.size(), 3u) << "two of the first answer, then done";
  EXPECT_EQ(result.policy->num_cut, 2);
  setup.controller = MakeRecordedPolicy(*result.policy);
  EXPECT_EQ(ToJson(RunSetup(setup)), ToJson(result));
}

TEST_P(PolicyLiftTest, LatencyLossAndNoiseAreOfTheDraw) {
  const auto make = [&](double latency, double jitter, double dropout) {
    TrialSetup setup = MakePolicySetup(GetParam(), std::make_shared<EvenClosing>(90));
    setup.policy.latency = latency;
    setup.policy.latency_jitter = jitter;
    setup.policy.dropout = dropout;
    return setup;
  };
  const auto find_touch = [](const TrialResult& result) {
    double first = INFINITY;
    for (const DigitContact& contact : result.contacts) first = std::fmin(first, contact.time);
    return first;
  };
  const TrialResult prompt = RunSetup(make(0.0, 0.0, 0.0));
  const TrialResult late = RunSetup(make(0.1, 0.0, 0.0));
  EXPECT_NEAR(find_touch(late) - find_touch(prompt), 0.1, 0.004);
  EXPECT_EQ(late.policy->num_questions, 90) << "it goes on being asked meanwhile";
  TrialSetup rough = make(0.01, 0.05, 0.3);
  const TrialResult first = RunSetup(rough), again = RunSetup(rough);
  EXPECT_EQ(ToJson(first), ToJson(again));
  rough.policy_seed = 1;
  EXPECT_NE(ToJson(RunSetup(rough)), ToJson(first));
  rough.policy_seed = 0;
  rough.controller = MakeRecordedPolicy(*first.policy);
  EXPECT_EQ(ToJson(RunSetup(rough)), ToJson(first));
}

TEST_P(PolicyLiftTest, AWrongAnswerIsAnOutcomeAndALostControllerNone) {
  const auto controller = std::make_shared<FixedAnswer>();
  controller->answer = [](const PolicyView&) -> PolicyAction { throw PolicyFault("nonsense"); };
  TrialSetup setup = MakePolicySetup(GetParam(), controller);
  const TrialResult result = RunSetup(setup);
  EXPECT_EQ(result.outcome, Outcome::kWrongAnswer);
  EXPECT_EQ(result.reason, "nonsense");
  ExpectSurvivesItsRecord(result);
  setup.controller = MakeRecordedPolicy(*result.policy);
  EXPECT_EQ(ToJson(RunSetup(setup)), ToJson(result));
  controller->answer = [](const PolicyView&) -> PolicyAction { throw PolicyLost("gone"); };
  setup.controller = controller;
  EXPECT_THROW(RunSetup(setup), PolicyLost);
  setup.controller = nullptr;
  EXPECT_THROW(RunSetup(setup), PolicyLost);
}

/** Of the hand: asked to move as a test wants it; then it says done. */
struct MovedHand {
  std::vector<Pose> X_WH;  // at each question
  TrialResult result;

  Eigen::Vector3d CalcShift() const { return X_WH.back().translation() - X_WH[0].translation(); }
};

MovedHand MoveHand(const char* hand, int num_questions,
                   const std::function<PolicyAction(const PolicyView&)>& act) {
  const auto controller = std::make_shared<FixedAnswer>();
  MovedHand moved;
  controller->answer = [&](const PolicyView& view) {
    moved.X_WH.push_back(view.world.state().X_WH);
    PolicyAction action = act(view);
    action.is_done = static_cast<int>(moved.X_WH.size()) == num_questions;
    return action;
  };
  TrialSetup setup = MakePolicySetup(hand, controller);
  setup.policy.moves = "hand-and-digits";
  moved.result = RunSetup(setup);
  setup.controller = MakeRecordedPolicy(*moved.result.policy);
  EXPECT_EQ(ToJson(RunSetup(setup)), ToJson(moved.result));
  ExpectSurvivesItsRecord(moved.result);
  return moved;
}

constexpr double kArmLag = 2e-4;  // of the arm's springs [m], [rad]

TEST_P(PolicyLiftTest, TheHandStaysBeforeTheGraspWhereNothingIsAsked) {
  std::optional<Pose> placed;
  const MovedHand moved = MoveHand(GetParam(), 11, [&](const PolicyView& view) {
    placed = view.placed_X_WH;
    return PolicyAction();
  });
  EXPECT_LT(moved.CalcShift().norm(), kArmLag);
  const double away = (moved.X_WH[0].translation() - placed->translation()).norm();
  EXPECT_NEAR(away, MakePolicySetup(GetParam(), nullptr).grasp.approach_distance, kArmLag);
  EXPECT_EQ(moved.result.outcome, Outcome::kNoContact) << moved.result.reason;
  EXPECT_EQ(*moved.result.policy->num_hand_cut, 0);
}

TEST_P(PolicyLiftTest, ATwistMovesTheHandAsFarAsSpeedTimesTime) {
  const MovedHand moved = MoveHand(GetParam(), 21, [](const PolicyView&) {
    PolicyAction action;
    action.twists.resize(1, 6);
    action.twists << 0.1, -0.05, 0.02, 0.0, 0.0, 0.5;
    return action;
  });
  EXPECT_LT((moved.CalcShift() - 0.4 * Eigen::Vector3d(0.1, -0.05, 0.02)).norm(), kArmLag);
  const Eigen::AngleAxisd turn(
      Eigen::Matrix3d(moved.X_WH.back().linear() * moved.X_WH[0].linear().transpose()));
  EXPECT_NEAR(turn.angle() * turn.axis().z(), 0.4 * 0.5, 10 * kArmLag);
  EXPECT_EQ(*moved.result.policy->num_hand_cut, 0);
}

TEST_P(PolicyLiftTest, AFarPoseIsNearedAtTheLargestSpeed) {
  std::optional<Pose> start;
  const MovedHand moved = MoveHand(GetParam(), 11, [&](const PolicyView& view) {
    if (!start) start = view.world.state().X_WH;
    PolicyAction action;
    action.poses = {*start};
    action.poses[0].translation().z() += 1.0;
    return action;
  });
  EXPECT_NEAR(moved.CalcShift().z(), 0.2 * 0.5, kArmLag);
  EXPECT_EQ(*moved.result.policy->num_hand_cut, 11);
}

TEST(PolicyLiftArm, AHandThatIsTakenOutOfReachEndsTheTrialWithTheJointNearestItsLimit) {
  const auto controller = std::make_shared<FixedAnswer>();
  controller->answer = [](const PolicyView&) {
    PolicyAction action;
    action.twists.resize(1, 6);
    action.twists << 0.4, 0.0, 0.0, 0.0, 0.0, 0.0;  // away from the arm, for 2.4 m
    return action;
  };
  TrialSetup setup = MakePolicySetup("tum", controller);
  setup.policy.moves = "hand-and-digits";
  setup.policy.time = 6.0;
  const auto arm = std::make_shared<const Arm>(LoadArm("puma560"));
  setup.arm = std::make_shared<const MountedArm>(MountArm(ArmConfig(), arm, *setup.hand));
  const TrialResult result = RunSetup(setup);
  EXPECT_EQ(result.outcome, Outcome::kNoStraightPath);
  EXPECT_EQ(result.reason.find("the arm cannot follow the hand "), 0u) << result.reason;
  ASSERT_TRUE(result.arm);
  const auto joint = std::find_if(arm->joints.begin(), arm->joints.end(),
                                  [&](const ArmJoint& j) { return j.name == result.arm->joint; });
  ASSERT_NE(joint, arm->joints.end());
  const std::string named = "; joint " + std::to_string(joint - arm->joints.begin() + 1) + " (" +
                            joint->name + ") is " + FormatFixed(DegFromRad(result.arm->margin), 1) +
                            " deg from its limit";
  EXPECT_NE(result.reason.find(named), std::string::npos) << result.reason;
  EXPECT_GT(result.arm->margin, 0.0);
  ExpectSurvivesItsRecord(result);
}

TEST_P(PolicyLiftTest, TheHandIsKeptAboveTheTable) {
  double lowest = INFINITY;
  const MovedHand moved = MoveHand(GetParam(), 60, [&](const PolicyView& view) {
    const std::vector<Pose> X_HL = CalcLinkPoses(*view.setup.hand, view.world.state().q);
    for (const ContactSphere& sphere : view.setup.hand->contact_spheres) {
      const Eigen::Vector3d p_WS =
          view.world.state().X_WH * (X_HL[static_cast<size_t>(sphere.link)] * sphere.p_LS);
      lowest = std::min(lowest, p_WS.z() - sphere.radius);
    }
    PolicyAction action;
    action.twists.setZero(1, 6);
    action.twists.col(2).setConstant(-0.4);
    action.twists.col(0).setConstant(-0.2);  // beside the object
    return action;
  });
  EXPECT_GT(lowest, -1e-3);
  EXPECT_LT(lowest, 2e-3);
  EXPECT_GT(*moved.result.policy->num_hand_cut, 10);
}

TEST_P(PolicyLiftTest, AHandThatIsMovedToTheGraspHolds) {
  EvenClosing closing(1000);
  int num_asked = 0;
  const MovedHand moved = MoveHand(GetParam(), 110, [&](const PolicyView& view) {
    PolicyAction action;
    if (++num_asked == 1) closing.Begin(view);
    if (num_asked > 20) action = closing.Answer(view);
    action.poses = {view.placed_X_WH};
    return action;
  });
  EXPECT_TRUE(IsSuccess(moved.result.outcome)) << moved.result.reason;
}

TEST_P(PolicyLiftTest, TheRegulatorTakesTheGripOver) {
  const auto controller = std::make_shared<FixedAnswer>();
  EvenClosing closing(1000);
  int num_asked = 0;
  controller->answer = [&](const PolicyView& view) {
    if (++num_asked == 1) closing.Begin(view);
    PolicyAction action = closing.Answer(view);
    if (view.report.grip_force > 0.0) action.hold = GripMode::kForce;
    return action;
  };
  TrialSetup setup = MakePolicySetup(GetParam(), controller);
  setup.policy.moves = "digits-until-touch";
  setup.strategy.grip_force = 1.5;
  const TrialResult result = RunSetup(setup);
  EXPECT_TRUE(IsSuccess(result.outcome)) << result.reason;
  ASSERT_TRUE(result.grip);
  for (const DigitGripRecord& digit : result.grip->digits) {
    if (digit.opposes) continue;
    EXPECT_NEAR(digit.asked, 1.5, 1e-6);
  }
  EXPECT_NEAR(result.grip->held / result.grip->asked, 1.0, 0.1);
  EXPECT_EQ(result.policy->rows.back().hold, "force");
  ExpectSurvivesItsRecord(result);
  setup.controller = MakeRecordedPolicy(*result.policy);
  EXPECT_EQ(ToJson(RunSetup(setup)), ToJson(result));
}

TEST_P(PolicyLiftTest, WhatItsMovesDoNotHaveIsAWrongAnswer) {
  const auto controller = std::make_shared<FixedAnswer>();
  TrialSetup setup = MakePolicySetup(GetParam(), controller);
  const auto expect_reason = [&](const char* part) {
    const TrialResult result = RunSetup(setup);
    EXPECT_EQ(result.outcome, Outcome::kWrongAnswer);
    EXPECT_NE(result.reason.find(part), std::string::npos) << result.reason;
  };
  controller->answer = [](const PolicyView& view) {
    PolicyAction action;
    action.poses = {view.placed_X_WH};
    return action;
  };
  expect_reason("expected hand-and-digits");
  controller->answer = [](const PolicyView&) {
    PolicyAction action;
    action.hold = GripMode::kMargin;
    return action;
  };
  expect_reason("expected digits-until-touch");
}

// At rest a drive's torque, its share of the stiffness times the error, bears the fingers' weight as
// the equations of motion have it.
TEST_P(PolicyLiftTest, AShareOfTheStiffnessBearsTheWeightAtRest) {
  const auto hang = [&](double share, double expected_share) {
    Eigen::VectorXd torque, weight;
    // In the pre-grasp posture of tum's g2 more than weight acts on the drives.
    const bool bears_more = std::string(GetParam()) == "tum";
    const MovedHand moved =
        MoveHand(bears_more ? "tum-evolved" : GetParam(), 200, [&](const PolicyView& view) {
          HandDynamics& dynamics = view.world.dynamics();
          const WorldState& state = view.world.state();
          dynamics.UpdatePositions(state.X_WH, state.q);
          Eigen::VectorXd bias(dynamics.num_speeds());
          dynamics.CalcBias(Eigen::VectorXd::Zero(dynamics.num_speeds()), state.gravity_W, bias);
          torque = weight = Eigen::VectorXd::Zero(view.targets.size());
          for (size_t i = 0; i < view.driven.size(); ++i) {
            const int joint = view.driven[i];
            const HandJoint& driven = view.setup.hand->joints[static_cast<size_t>(joint)];
            const double q = state.q[joint];
            if (q < driven.lower + 1e-3 || q > driven.upper - 1e-3) continue;  // a stop bears it
            const auto at = static_cast<Eigen::Index>(i);
            torque[at] = expected_share * driven.drive.stiffness *
                         (view.targets[at] - CalcDrivePosition(*view.setup.hand, state, joint));
            weight[at] = bias[dynamics.dof_of_joint(joint)];
          }
          PolicyAction action;
          action.stiffness = Eigen::MatrixXd::Constant(1, view.targets.size(), share);
          return action;
        });
    EXPECT_GT(weight.cwiseAbs().maxCoeff(), 1e-3);
    EXPECT_LT((torque - weight).cwiseAbs().maxCoeff(), 0.01 * weight.cwiseAbs().maxCoeff());
    return moved.result.policy->num_cut / static_cast<int>(torque.size());
  };
  EXPECT_EQ(hang(1.0, 1.0), 0);
  EXPECT_EQ(hang(0.5, 0.5), 0);
  EXPECT_EQ(hang(1.5, 1.0), 200) << "what is above 1 is cut";
}

TEST_P(PolicyLiftTest, IsToldOfTheObjectsPoseAsTheSettingSays) {
  const auto controller = std::make_shared<FixedAnswer>();
  Pose told;
  controller->answer = [&](const PolicyView& view) {
    told = view.told_X_WO;
    PolicyAction action;
    action.is_done = true;
    return action;
  };
  TrialSetup setup = MakePolicySetup(GetParam(), controller);
  setup.draw.offset_x = 0.012;
  setup.draw.offset_y = -0.008;
  setup.positioning = Positioning::kTrue;
  const auto ask = [&](const char* choice) {
    setup.policy.object_pose = choice;
    const TrialResult result = RunSetup(setup);
    EXPECT_EQ(result.policy->object_pose, choice);
    ExpectSurvivesItsRecord(result);
    return result.policy->told_X_WO;
  };
  EXPECT_FALSE(ask("none"));
  EXPECT_FALSE(ask("true")) << "it is in the trial's trajectory";
  EXPECT_NEAR(ask("nominal")->translation().head<2>().norm(), 0.0, 1e-12);
  EXPECT_TRUE(told.isApprox(*ask("believed")));
  EXPECT_NEAR((told.translation().head<2>() - Eigen::Vector2d(0.012, -0.008)).norm(), 0.0, 1e-12);
  ASSERT_TRUE(setup.hand->camera);
  const std::optional<Pose> seen = ask("camera");
  ASSERT_TRUE(seen);
  EXPECT_NEAR((seen->translation().head<2>() - Eigen::Vector2d(0.012, -0.008)).norm(), 0.0, 2e-3);
}

TEST_P(PolicyLiftTest, APictureShowsWhatTheHandsCameraSees) {
  const auto controller = std::make_shared<FixedAnswer>();
  std::vector<Image> pictures;
  controller->answer = [&](const PolicyView& view) {
    pictures.push_back(view.take_picture());
    EXPECT_EQ(view.take_picture().rgb, pictures.back().rgb) << "of one question";
    PolicyAction action;
    action.twists.setZero(1, 6);
    action.twists(0, 2) = 0.5;
    action.is_done = pictures.size() == 6;
    return action;
  };
  TrialSetup setup = MakePolicySetup(GetParam(), controller);
  setup.policy.moves = "hand-and-digits";
  setup.policy.picture = 64;
  setup.camera.noise = setup.camera.blur = 0.0;
  RunSetup(setup);
  ASSERT_EQ(pictures.size(), 6u);
  EXPECT_EQ(pictures[0].rgb.size(), 64u * 64u * 3u);
  const auto count_table = [](const Image& image) {  // pixels of about its magenta
    int count = 0;
    for (size_t i = 0; i < image.rgb.size(); i += 3) {
      count += image.rgb[i] > 150 && image.rgb[i + 1] < 110 && image.rgb[i + 2] > 120;
    }
    return count;
  };
  EXPECT_GT(count_table(pictures[0]), 100);
  EXPECT_NE(pictures[0].rgb, pictures[5].rgb);
}

}  // namespace
}  // namespace graspbench
