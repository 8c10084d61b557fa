// The digits in the hands of a controller. The oracle is table_lift: a controller that asks for what
// the strategy asks for has its trial, to the last byte.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

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

}  // namespace
}  // namespace graspbench
