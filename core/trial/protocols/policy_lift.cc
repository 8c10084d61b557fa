/** @file
The trial of table_lift with a controller. From the start of closure the controller is asked every
control period; when it says done, or after policy.time_s, the hand is lifted as in table_lift.
Closure ends for the record as there; the drives hold the last targets. Answers take effect
after the latency of the settings, and may be lost; both are drawn from the trial's stream. The
drives' errors of the draw are added to what the controller asks for, as to the strategy's commands.

policy.moves: `digits` begin in the pre-grasp posture where the grasp places the hand.
`hand-and-digits` begin at the pre-grasp position, the grasp's distance before it. A commanded pose
is reached evenly within a control period, at most as fast as the settings say. Table and hand do
not touch in the physics: the command is raised so that no part of the hand comes lower than
kTableClearance. `digits-until-touch` begin as digits; with the action "hold" the regulator of the
strategy takes over (GripRegulator::TakeOver), and decides when the hand is lifted. */

#include <cmath>
#include <deque>

#include "core/base/random.h"
#include "core/grasp/placement.h"
#include "core/trial/policy/hand_policy.h"
#include "core/trial/protocols/table_lift.h"
#include "core/vision/hand_picture.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

std::vector<int> ListDrivenJoints(const Hand& hand) {
  std::vector<int> driven;
  for (int joint = 0; joint < hand.num_joints(); ++joint) {
    if (hand.joints[static_cast<size_t>(joint)].coupled_to < 0) driven.push_back(joint);
  }
  return driven;
}

/** With the firm grip under which a controller closes the digits. */
GripRegulator MakeFirmGrip(TrialSetup setup, const std::vector<int>& digits) {
  setup.strategy.grip = RowOf(kGripModes, GripMode::kPosture).name;
  return GripRegulator(setup, digits);
}

/** The lowest point of the hand [m]. */
double FindLowest(const Hand& hand, const VectorXd& q, const Pose& X_WH) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  double lowest = std::numeric_limits<double>::infinity();
  for (const ContactSphere& sphere : hand.contact_spheres) {
    const Vector3d p_WS = X_WH * (X_HL[static_cast<size_t>(sphere.link)] * sphere.p_LS);
    lowest = std::min(lowest, p_WS.z() - sphere.radius);
  }
  return lowest;
}

/** Part of the way from one pose to another: at most so far, turned at most by so much. */
Pose GoTowards(const Pose& from, const Pose& to, double share, double distance, double angle) {
  const Vector3d way = to.translation() - from.translation();
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(to.linear() * from.linear().transpose()));
  const auto limit = [share](double whole, double most) {
    return whole > 0.0 ? std::min(share, most / whole) : 1.0;
  };
  const double moved = limit(way.norm(), distance), turned = limit(turn.angle(), angle);
  Pose reached = to;
  if (moved < 1.0) reached.translation() = from.translation() + moved * way;
  if (turned < 1.0) {
    reached.linear() = Eigen::AngleAxisd(turned * turn.angle(), turn.axis()) * from.linear();
  }
  return reached;
}

class PolicyLift : public TableLift {
 public:
  PolicyLift(std::unique_ptr<World> world, const TrialSetup& setup, WristCamera* camera)
      : TableLift(std::move(world), setup, camera),
        driven_(ListDrivenJoints(*setup.hand)),
        steps_per_row_(std::max(1L, std::lround(setup.policy.period / setup.sim.step))),
        moves_(RowFromName(kPolicyMoves, setup.policy.moves, "moves").value),
        placed_X_WH_(placement_.X_WH),
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
    in_effect_.targets = targets_;
    if (moves_ == PolicyMoves::kUntilTouch) notes_.grip = MakeFirmGrip(setup, digits_);
    if (moves_ == PolicyMoves::kHandAndDigits) {
      notes_.palm = PalmApproach(false);  // the controller moves the hand
      placement_.X_WH.pretranslate(-setup.grasp.approach_distance * placement_.approach_W);
      placement_.reaches_object = true;
      hand_target_ = placement_.X_WH;
      record_.num_hand_cut = 0;
    }
    if (setup.policy.picture > 0) {
      take_picture_ = [this] { return TakePicture(); };
    }
    Tell(camera);
  }

  void Begin() override {
    TableLift::Begin();
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
    const bool was_regulated = notes_.grip.is_regulated();
    const bool controls = phase() == Phase::kClosure || phase() == Phase::kStabilisation;
    hand_speeds_.setZero();
    if (controls && !is_done_ && !was_regulated && notes_.policy_fault.empty()) Control();
    StrategyObservation observation = TableLift::FindObservation();
    if (!notes_.grip.is_regulated()) {
      observation.lifts = is_done_;
    } else if (!was_regulated) {
      observation.is_closing = true;  // the longest time of stabilisation begins here
    }
    return observation;
  }

  WorldCommand MakeCommand(const StrategyCommand& command) const override {
    WorldCommand result = TableLift::MakeCommand(command);
    for (size_t i = 0; i < driven_.size(); ++i) {
      const int joint = driven_[i];
      if (is_gripping_.empty() || !is_gripping_[static_cast<size_t>(joint)]) {
        result.q[joint] =
            in_effect_.targets[static_cast<Eigen::Index>(i)] + setup_.draw.joint_error[joint];
      }
    }
    if (in_effect_.stiffness.size() > 0) {
      result.stiffness = VectorXd::Ones(setup_.hand->num_joints());
      for (size_t i = 0; i < driven_.size(); ++i) {
        result.stiffness[driven_[i]] = in_effect_.stiffness[static_cast<Eigen::Index>(i)];
      }
    }
    result.w_WH = hand_speeds_.head<3>();
    result.v_WH += hand_speeds_.tail<3>();
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
  /** A row of an action, within limits. */
  struct Row {
    long due = 0;  // step of control
    VectorXd targets;
    VectorXd stiffness = {};        // empty: of all joints 1
    std::optional<Pose> hand = {};  // X_WH
    std::optional<GripMode> hold = {};
    bool is_done = false;
  };

  PolicyView MakeView() {
    return {setup_,
            driven_,
            *world_,
            notes_.report,
            hand_contacts_,
            notes_.sensors ? &*notes_.sensors : nullptr,
            targets_,
            stiffness_,
            told_X_WO_,
            placed_X_WH_,
            take_picture_,
            static_cast<double>(num_steps_) * setup_.sim.step,
            phase(),
            notes_.strategy.time_in_phase(),
            record_.num_questions};
  }

  /** Decides which pose of the object the controller gets. */
  void Tell(WristCamera* camera) {
    switch (RowFromName(kPolicyObjectPoses, setup_.policy.object_pose, "object pose").value) {
      case PolicyObjectPose::kNone:
      case PolicyObjectPose::kTrue:
        return;
      case PolicyObjectPose::kNominal:
        told_X_WO_ = CalcRestPose(0.0, 0.0, 0.0);
        break;
      case PolicyObjectPose::kBelieved:
        told_X_WO_ = CalcBelievedPose();
        break;
      case PolicyObjectPose::kCamera: {
        const Sighting seen = Look(camera);
        if (!seen.is_found) {
          notes_.not_seen = seen.reason;
          return;
        }
        told_X_WO_ = CalcRestPose(seen.pose.x, seen.pose.y, seen.pose.yaw);
        break;
      }
    }
    record_.told_X_WO = told_X_WO_;
  }

  Image TakePicture() {
    RandomStream noise(
        std::to_string(setup_.policy_seed) + "/" + std::to_string(record_.num_questions),
        "controller picture");
    const WorldState& state = world_->state();
    return TakeHandPicture(setup_.hand, setup_.object, setup_.camera, setup_.policy.picture,
                           state.X_WH, state.q, world_->CalcObjectPose(), noise.NextBits());
  }

  void Fail(const PolicyFault& fault) { record_.fault = notes_.policy_fault = fault.what(); }

  /** Before a step of the physics that the controller decides on. */
  void Control() {
    if (num_steps_ == 0) hand_command_ = notes_.command.X_WH;
    if (num_steps_ % steps_per_row_ == 0 && !record_.said_done) {
      try {
        if (next_row_ >= std::min<long>(action_.rows.rows(), setup_.policy.execute_steps)) Ask();
        TakeRow();
      } catch (const PolicyFault& fault) {
        Fail(fault);
      }
    }
    while (!pending_.empty() && pending_.front().due <= num_steps_) {
      in_effect_ = std::move(pending_.front());
      pending_.pop_front();
      is_done_ = in_effect_.is_done;
      hand_steps_left_ = steps_per_row_;
      if (in_effect_.hold) {
        TakeOver();
        return;
      }
    }
    if (moves_ == PolicyMoves::kHandAndDigits && !is_done_) MoveHand();
    ++num_steps_;
    if (static_cast<double>(num_steps_) * setup_.sim.step >= setup_.policy.time) is_done_ = true;
  }

  void Ask() {
    ++record_.num_questions;
    action_ = setup_.controller->Answer(MakeView());
    next_row_ = 0;
    CheckAction();
    const PolicyConfig& policy = setup_.policy;
    const double latency = policy.latency + policy.latency_jitter * link_.NextUnit();
    latency_steps_ = std::lround(latency / setup_.sim.step);
    is_lost_ = link_.NextUnit() < policy.dropout;
  }

  /** @throws PolicyFault for what these moves do not have. */
  void CheckAction() {
    const bool moves_hand = !action_.poses.empty() || action_.twists.rows() > 0;
    if (moves_hand && moves_ != PolicyMoves::kHandAndDigits) {
      throw PolicyFault("the answer moves the hand, and policy.moves is " + setup_.policy.moves +
                        "; expected hand-and-digits");
    }
    if (action_.hold && moves_ != PolicyMoves::kUntilTouch) {
      throw PolicyFault("the answer says hold, and policy.moves is " + setup_.policy.moves +
                        "; expected digits-until-touch");
    }
    if (action_.hold == GripMode::kMargin && !(setup_.object->surface.friction_dynamic > 0.0)) {
      throw PolicyFault("hold: a margin needs an object with friction; expected force");
    }
    if (action_.rows.rows() > 0) return;
    // The digits stay as they are.
    const auto num_rows =
        std::max<Eigen::Index>({1, static_cast<Eigen::Index>(action_.poses.size()),
                                action_.twists.rows(), action_.stiffness.rows()});
    action_.rows = targets_.transpose().replicate(num_rows, 1);
    action_.are_increments = false;
  }

  /** X_WH that the next row asks for. */
  std::optional<Pose> FindAskedPose() const {
    if (!action_.poses.empty()) return action_.poses[static_cast<size_t>(next_row_)];
    if (action_.twists.rows() == 0) return std::nullopt;
    const Eigen::Matrix<double, 6, 1> moved = static_cast<double>(steps_per_row_) *
                                              setup_.sim.step *
                                              action_.twists.row(next_row_).transpose();
    const Vector3d turn = moved.tail<3>();
    Pose asked = hand_target_;
    asked.translation() += moved.head<3>();
    if (turn.norm() > 0.0) {
      asked.linear() = Eigen::AngleAxisd(turn.norm(), turn.normalized()) * asked.linear();
    }
    return asked;
  }

  void TakeRow() {
    const VectorXd row = action_.rows.row(next_row_).transpose();
    const VectorXd asked = action_.are_increments ? VectorXd(targets_ + row) : row;
    const VectorXd stiffness = action_.stiffness.rows() > 0
                                   ? VectorXd(action_.stiffness.row(next_row_).transpose())
                                   : stiffness_;
    const std::optional<Pose> hand = FindAskedPose();
    PolicyRow& recorded = record_.rows.emplace_back();
    recorded.targets = asked;
    recorded.begins = next_row_ == 0;
    recorded.hand = hand;
    recorded.stiffness = stiffness;
    if (action_.hold) recorded.hold = RowOf(kGripModes, *action_.hold).name;
    ++next_row_;
    if (is_lost_) return;
    const auto cut = [&](double value, double lower, double upper) {
      const double within = std::clamp(value, lower, upper);
      if (within != value) ++record_.num_cut;
      return within;
    };
    for (size_t i = 0; i < driven_.size(); ++i) {
      const HandJoint& joint = setup_.hand->joints[static_cast<size_t>(driven_[i])];
      const auto at = static_cast<Eigen::Index>(i);
      targets_[at] = cut(asked[at], joint.lower, joint.upper);
    }
    stiffness_ = stiffness;
    for (double& share : stiffness_) share = cut(share, 0.0, 1.0);
    if (hand) CutHand(*hand);
    record_.said_done = action_.is_done || action_.hold;
    const long after = pending_.empty() ? 0 : pending_.back().due;  // answers keep their order
    pending_.push_back({std::max(after, num_steps_ + latency_steps_), targets_, stiffness_,
                        hand ? std::optional<Pose>(hand_target_) : std::nullopt, action_.hold,
                        action_.is_done && !action_.hold});
  }

  /** Moves the target as far as a control period lets it. */
  void CutHand(const Pose& asked) {
    const PolicyConfig& policy = setup_.policy;
    const double period = static_cast<double>(steps_per_row_) * setup_.sim.step;
    constexpr double kRounding = 1.0 + 1e-9;
    hand_target_ = GoTowards(hand_target_, asked, 1.0, kRounding * policy.hand_speed * period,
                             kRounding * policy.hand_turn_rate * period);
    is_hand_cut_ = !hand_target_.isApprox(asked, 1e-12);
    if (is_hand_cut_) ++*record_.num_hand_cut;
  }

  void MoveHand() {
    const double step = setup_.sim.step;
    const Pose before = hand_command_;
    const Pose target = in_effect_.hand.value_or(before);
    const double share = 1.0 / static_cast<double>(std::max(1L, hand_steps_left_--));
    hand_command_ = GoTowards(before, target, share, setup_.policy.hand_speed * step,
                              setup_.policy.hand_turn_rate * step);
    const double lowest = FindLowest(*setup_.hand, world_->state().q, hand_command_);
    if (lowest < kTableClearance) {
      hand_command_.pretranslate(Vector3d(0.0, 0.0, kTableClearance - lowest));
      if (!is_hand_cut_) ++*record_.num_hand_cut;
      is_hand_cut_ = true;
    }
    const Eigen::AngleAxisd turn(
        Eigen::Matrix3d(hand_command_.linear() * before.linear().transpose()));
    hand_speeds_ << turn.angle() / step * turn.axis(),
        (hand_command_.translation() - before.translation()) / step;
    placement_.X_WH = hand_command_;
  }

  /** The regulator gets the grip, and the drives their own stiffness. */
  void TakeOver() {
    VectorXd asked = VectorXd::Zero(setup_.hand->num_joints());
    for (size_t i = 0; i < driven_.size(); ++i) {
      asked[driven_[i]] = in_effect_.targets[static_cast<Eigen::Index>(i)];
    }
    notes_.grip = notes_.grip.TakeOver(*in_effect_.hold, asked);
    in_effect_.stiffness.resize(0);
    is_gripping_.assign(static_cast<size_t>(setup_.hand->num_joints()), false);
    for (const int digit : digits_) {
      for (const int joint :
           FindDrivenJoints(*setup_.hand, setup_.hand->digits[static_cast<size_t>(digit)])) {
        is_gripping_[static_cast<size_t>(joint)] = true;
      }
    }
  }

  const std::vector<int> driven_;
  const long steps_per_row_;
  const PolicyMoves moves_;
  const Pose placed_X_WH_;  // where the grasp places the hand
  Pose told_X_WO_ = Pose::Identity();
  std::function<Image()> take_picture_;
  RandomStream link_;                     // latency and loss of each answer
  VectorXd targets_;                      // last of the driven joints
  VectorXd stiffness_;                    // last of the driven joints
  Pose hand_target_ = Pose::Identity();   // X_WH, last target
  Pose hand_command_ = Pose::Identity();  // X_WH, in the last step
  Eigen::Matrix<double, 6, 1> hand_speeds_ = Eigen::Matrix<double, 6, 1>::Zero();  // w_WH, v_WH
  long hand_steps_left_ = 0;  // of the row that is in effect
  bool is_hand_cut_ = false;  // the last row's pose
  Row in_effect_;
  std::deque<Row> pending_;
  long latency_steps_ = 0;  // of the last answer
  bool is_lost_ = false;    // it is
  PolicyAction action_;
  long next_row_ = 0;   // of it
  long num_steps_ = 0;  // of control
  bool is_done_ = false;
  std::vector<bool> is_gripping_;  // by joint: the regulator has it; empty: none
  PolicyRecord record_;
};

}  // namespace

const Protocol& GetPolicyLift() {
  static const Protocol protocol = {
      "policy_lift",
      "that of table_lift, with digits, and a hand, that a controller of somebody else moves",
      TablePresence::kPresent,
      [](std::unique_ptr<World> world, const TrialSetup& setup,
         WristCamera* camera) -> std::unique_ptr<TrialCourse> {
        return std::make_unique<PolicyLift>(std::move(world), setup, camera);
      }};
  return protocol;
}

}  // namespace graspbench
