/** @file
The trial of table_lift whose digits a controller closes: the hand is placed by the grasp, in whose
pre-grasp posture control begins. From the start of closure the controller is asked every control
period; when it says done, or after policy.time_s, the hand is lifted as in table_lift. Closure ends
for the record as there; the drives hold what was asked for last. Answers take effect after the
latency of the settings, and may be lost; both are drawn from the trial's stream. The drives' errors
of the draw are added to what the controller asks for, as to the strategy's commands. */

#include <cmath>
#include <deque>

#include "core/base/random.h"
#include "core/trial/policy/hand_policy.h"
#include "core/trial/protocols/table_lift.h"

namespace graspbench {
namespace {

std::vector<int> ListDrivenJoints(const Hand& hand) {
  std::vector<int> driven;
  for (int joint = 0; joint < hand.num_joints(); ++joint) {
    if (hand.joints[static_cast<size_t>(joint)].coupled_to < 0) driven.push_back(joint);
  }
  return driven;
}

class PolicyLift : public TableLift {
 public:
  PolicyLift(std::unique_ptr<World> world, const TrialSetup& setup, WristCamera* camera)
      : TableLift(std::move(world), setup, camera),
        driven_(ListDrivenJoints(*setup.hand)),
        steps_per_row_(std::max(1L, std::lround(setup.policy.period / setup.sim.step))),
        link_(std::to_string(setup.policy_seed), "controller link") {
    if (!setup.controller) {
      throw PolicyLost(
          "the trial is that of a controller (policy.command), and there is neither "
          "one here nor a record of its actions; start it with graspbench run");
    }
    record_.object_pose = setup.policy.object_pose;
    targets_.resize(static_cast<Eigen::Index>(driven_.size()));
    for (size_t i = 0; i < driven_.size(); ++i) {
      targets_[static_cast<Eigen::Index>(i)] = setup.grasp.q_pre[driven_[i]];
    }
    in_effect_ = targets_;
  }

  void Begin() override {
    TableLift::Begin();
    believed_X_WO_ = CalcBelievedPose();
    try {
      setup_.controller->Begin(MakeView());
    } catch (const PolicyFault& fault) {
      Fail(fault);
    }
  }

  TrialResult End() override {
    TrialResult result = TableLift::End();
    result.policy = record_;
    return result;
  }

 protected:
  StrategyObservation FindObservation() override {
    StrategyObservation observation = TableLift::FindObservation();
    const bool controls = phase() == Phase::kClosure || phase() == Phase::kStabilisation;
    if (controls && !is_done_ && notes_.policy_fault.empty()) Control();
    observation.lifts = is_done_;
    return observation;
  }

  WorldCommand MakeCommand(const StrategyCommand& command) const override {
    WorldCommand result = TableLift::MakeCommand(command);
    for (size_t i = 0; i < driven_.size(); ++i) {
      const int joint = driven_[i];
      result.q[joint] = in_effect_[static_cast<Eigen::Index>(i)] + setup_.draw.joint_error[joint];
    }
    return result;
  }

  /** Where the digit is asked to be as the strategy would have it: there is no other s. */
  double FindClosing(size_t digit) const override {
    const double closing = TableLift::FindClosing(digit);
    const Grasp& grasp = setup_.grasp;
    for (const int joint :
         FindDrivenJoints(*setup_.hand, setup_.hand->digits[static_cast<size_t>(digits_[digit])])) {
      const double asked = grasp.q_pre[joint] +
                           closing * (grasp.q_target[joint] - grasp.q_pre[joint]) +
                           setup_.draw.joint_error[joint];
      if (notes_.command.q[joint] != asked) return kUnset;
    }
    return closing;
  }

 private:
  PolicyView MakeView() {
    return {setup_,
            driven_,
            *world_,
            notes_.report,
            hand_contacts_,
            notes_.sensors ? &*notes_.sensors : nullptr,
            targets_,
            believed_X_WO_,
            static_cast<double>(num_steps_) * setup_.sim.step,
            phase(),
            notes_.strategy.time_in_phase(),
            record_.num_questions};
  }

  void Fail(const PolicyFault& fault) { record_.fault = notes_.policy_fault = fault.what(); }

  /** Before a step of the physics that the controller decides on. */
  void Control() {
    if (num_steps_ % steps_per_row_ == 0 && !record_.said_done) {
      try {
        if (next_row_ >= std::min<long>(action_.rows.rows(), setup_.policy.execute_steps)) Ask();
        TakeRow();
      } catch (const PolicyFault& fault) {
        Fail(fault);
      }
    }
    while (!pending_.empty() && pending_.front().due <= num_steps_) {
      in_effect_ = pending_.front().targets;
      is_done_ = pending_.front().is_done;
      pending_.pop_front();
    }
    ++num_steps_;
    if (static_cast<double>(num_steps_) * setup_.sim.step >= setup_.policy.time) is_done_ = true;
  }

  void Ask() {
    ++record_.num_questions;
    action_ = setup_.controller->Answer(MakeView());
    next_row_ = 0;
    const PolicyConfig& policy = setup_.policy;
    const double latency = policy.latency + policy.latency_jitter * link_.NextUnit();
    latency_steps_ = std::lround(latency / setup_.sim.step);
    is_lost_ = link_.NextUnit() < policy.dropout;
    if (action_.rows.rows() > 0) return;
    action_.rows = targets_.transpose();  // done at once
    action_.are_increments = false;
  }

  void TakeRow() {
    const Eigen::VectorXd row = action_.rows.row(next_row_).transpose();
    const Eigen::VectorXd asked = action_.are_increments ? Eigen::VectorXd(targets_ + row) : row;
    record_.rows.push_back({asked, next_row_ == 0});
    ++next_row_;
    if (is_lost_) return;
    for (size_t i = 0; i < driven_.size(); ++i) {
      const HandJoint& joint = setup_.hand->joints[static_cast<size_t>(driven_[i])];
      double& target = targets_[static_cast<Eigen::Index>(i)];
      target = std::clamp(asked[static_cast<Eigen::Index>(i)], joint.lower, joint.upper);
      if (target != asked[static_cast<Eigen::Index>(i)]) ++record_.num_cut;
    }
    record_.said_done = action_.is_done;
    const long after = pending_.empty() ? 0 : pending_.back().due;  // answers keep their order
    pending_.push_back({std::max(after, num_steps_ + latency_steps_), targets_, action_.is_done});
  }

  struct PendingRow {
    long due;  // step of control
    Eigen::VectorXd targets;
    bool is_done;
  };

  const std::vector<int> driven_;
  const long steps_per_row_;
  Pose believed_X_WO_ = Pose::Identity();
  RandomStream link_;          // latency and loss of each answer
  Eigen::VectorXd targets_;    // of the driven joints, the last that were asked for
  Eigen::VectorXd in_effect_;  // of the driven joints
  std::deque<PendingRow> pending_;
  long latency_steps_ = 0;  // of the last answer
  bool is_lost_ = false;    // it is
  PolicyAction action_;
  long next_row_ = 0;   // of it
  long num_steps_ = 0;  // of control
  bool is_done_ = false;
  PolicyRecord record_;
};

}  // namespace

const Protocol& GetPolicyLift() {
  static const Protocol protocol = {
      "policy_lift", "that of table_lift, with digits that a controller of somebody else closes",
      TablePresence::kPresent,
      [](std::unique_ptr<World> world, const TrialSetup& setup,
         WristCamera* camera) -> std::unique_ptr<TrialCourse> {
        return std::make_unique<PolicyLift>(std::move(world), setup, camera);
      }};
  return protocol;
}

}  // namespace graspbench
