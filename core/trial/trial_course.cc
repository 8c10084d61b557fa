#include "core/trial/trial_course.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/hand/coupling.h"
#include "core/trial/judge.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** The simulation starts this long before the hand could first touch anything [s]. */
constexpr double kLeadTime = 0.06;
constexpr double kSafeGap = 0.004;  ///< [m]
/** Creep counts after this share of the hold, in which the swing of the lift dies away. */
constexpr double kSettlingShare = 0.5;
/** Steps between two looks at the gap of a digit that has not touched. */
constexpr int kGapInterval = 5;

}  // namespace

TrialCourse::TrialCourse(World& world, const TrialSetup& setup)
    : world_(world),
      setup_(setup),
      hand_(*setup.hand),
      placement_(CalcPlacement(hand_, setup.grasp, setup.object->size,
                               setup.object->mass_properties.p_OOcm)),
      strategy_(setup.strategy, setup.grasp.approach_distance),
      stability_(setup),
      events_(hand_, setup.sim.step) {
  for (const std::string& id : setup.grasp.digits) {
    for (size_t d = 0; d < hand_.digits.size(); ++d) {
      if (hand_.digits[d].id != id) continue;
      digits_.push_back(static_cast<int>(d));
      const bool opposes = static_cast<int>(d) == FindOpposingDigit(hand_, setup.grasp);
      result_.contacts.push_back({id, opposes, kUnset});
      result_.touches.emplace_back();
    }
  }
}

void TrialCourse::Start() {
  WorldState state;
  state.q = setup_.grasp.q_pre + setup_.draw.joint_error;
  for (size_t j = 0; j < hand_.joints.size(); ++j) {
    const auto joint = static_cast<Eigen::Index>(j);
    state.q[joint] = std::clamp(state.q[joint], hand_.joints[j].lower, hand_.joints[j].upper);
  }
  ApplyCoupling(hand_, state.q);
  state.u = Eigen::VectorXd::Zero(world_.dynamics().num_dofs());

  const GraspObject& object = *setup_.object;
  Pose X_WO = MakePose(Vector3d(setup_.draw.offset_x, setup_.draw.offset_y, 0.0));
  X_WO.rotate(Eigen::AngleAxisd(setup_.draw.offset_yaw, Vector3d::UnitZ()));
  X_WO.pretranslate(Vector3d(0.0, 0.0, -world_.collider().CalcLowestPoint(X_WO)));
  state.R_WO = X_WO.linear();
  state.p_WOcm = X_WO * object.mass_properties.p_OOcm;
  if (!X_WO.matrix().allFinite() || !state.q.allFinite()) {
    throw Error(ErrorKind::kRange, "the object's start pose or a joint error is not finite");
  }
  rest_height_ = X_WO.translation().z();
  rest_position_ = state.p_WOcm;

  // Skip the part of the placing in which nothing can touch.
  const double placing_time = setup_.strategy.placing_time;
  double before_arrival = 0.0;
  constexpr double kSearchStep = 0.01;
  for (; before_arrival < placing_time; before_arrival += kSearchStep) {
    Pose X_WH = placement_.X_WH;
    X_WH.pretranslate(-strategy_.CalcPlacingDistance(before_arrival) * placement_.approach_W);
    world_.dynamics().UpdatePositions(X_WH, state.q);
    if (world_.collider().CalcSmallestGap(world_.dynamics(), X_WO) > kSafeGap) break;
  }
  before_arrival = std::min(before_arrival + kLeadTime, placing_time);
  strategy_.StartPlacing(before_arrival);
  state.X_WH = placement_.X_WH;
  state.X_WH.pretranslate(-strategy_.CalcPlacingDistance(before_arrival) * placement_.approach_W);
  world_.Reset(state);
  rest_extent_ = CalcExtent();
}

WorldCommand TrialCourse::MakeCommand(const StrategyCommand& command) const {
  WorldCommand result;
  result.q = setup_.grasp.q_pre + command.closing * (setup_.grasp.q_target - setup_.grasp.q_pre) +
             setup_.draw.joint_error;
  // The object is lifted straight up, also when it was approached from the side.
  const bool is_lifting = strategy_.phase() >= Phase::kLiftOff;
  const Vector3d away_W = is_lifting ? Vector3d(Vector3d::UnitZ()) : -placement_.approach_W;
  result.X_WH = placement_.X_WH;
  result.X_WH.pretranslate(command.distance * away_W);
  result.v_WH = command.speed * away_W;
  return result;
}

bool TrialCourse::IsTouching(int digit) const {
  const std::vector<int>& links = hand_.digits[digit].links;
  return std::any_of(links.begin(), links.end(),
                     [&](int link) { return report_.link_touches_object[link]; });
}

double TrialCourse::CalcGap(int digit) const {
  const std::vector<int>& links = hand_.digits[digit].links;
  const Pose X_OW = world_.CalcObjectPose().inverse();
  const std::vector<Pose> X_HL = CalcLinkPoses(hand_, world_.state().q);
  double gap = std::numeric_limits<double>::infinity();
  for (const ContactSphere& sphere : hand_.contact_spheres) {
    if (std::find(links.begin(), links.end(), sphere.link) == links.end()) continue;
    const Vector3d p_OS = X_OW * (world_.state().X_WH * (X_HL[sphere.link] * sphere.p_LS));
    gap = std::min(gap, setup_.object->field->Query(p_OS).distance - sphere.radius);
  }
  return gap;
}

Pose TrialCourse::CalcObjectInPalm() const {
  const WorldState& state = world_.state();
  return CalcPalmPose(hand_, state).inverse() * MakePose(state.R_WO, state.p_WOcm);
}

void TrialCourse::Observe(const StepReport& report, double closing) {
  report_ = report;
  time_ += setup_.sim.step;
  ++result_.num_steps;
  if (!report.converged) {
    ++result_.num_unconverged;
    unconverged_time_ += setup_.sim.step;
  } else {
    unconverged_time_ = 0.0;
  }
  result_.worst_penetration = std::max(result_.worst_penetration, report.worst_penetration);
  if (report.grip_force > 0.0) last_touch_ = time_;
  ObserveTouches(closing);
  world_.FindHandContacts(hand_contacts_);
  events_.Observe(time_, hand_contacts_);
  stability_.Observe(world_, strategy_.phase(), strategy_.time_in_phase());
  if (strategy_.phase() == Phase::kHold && !settled_at_ &&
      strategy_.time_in_phase() >= kSettlingShare * setup_.strategy.hold_time) {
    settled_at_ = CalcObjectInPalm();
  }
}

void TrialCourse::ObserveTouches(double closing) {
  const bool is_closing =
      strategy_.phase() == Phase::kClosure || strategy_.phase() == Phase::kStabilisation;
  for (size_t d = 0; d < digits_.size(); ++d) {
    if (!std::isnan(result_.contacts[d].time)) continue;
    DigitTouch& touch = result_.touches[d];
    if (IsTouching(digits_[d])) {
      result_.contacts[d].time = time_;
      touch = {closing, world_.state().q, 0.0};
    } else if (is_closing && result_.num_steps % kGapInterval == 0) {
      touch.smallest_gap = std::fmin(touch.smallest_gap, CalcGap(digits_[d]));
    }
  }
}

void TrialCourse::EnterPhase(Phase phase) {
  result_.phases.push_back({NameOf(phase), time_});
  switch (phase) {
    case Phase::kClosure:
      closure_start_ = time_;
      TakeSnapshot("pregrasp");
      break;
    case Phase::kLiftOff:
      result_.grip_force = report_.grip_force;
      TakeSnapshot("closed");
      break;
    case Phase::kHold:
      held_at_ = world_.state().X_WH.inverse() * world_.state().p_WOcm;
      break;
    case Phase::kPreGrasp:
    case Phase::kPlacing:
    case Phase::kStabilisation:
    case Phase::kDone:
      break;
  }
}

void TrialCourse::TakeSnapshot(const char* name) {
  SceneSnapshot snapshot;
  snapshot.name = name;
  snapshot.time = time_;
  snapshot.X_WH = world_.state().X_WH;
  snapshot.X_WO = world_.CalcObjectPose();
  snapshot.q = world_.state().q;
  result_.snapshots.push_back(snapshot);
}

double TrialCourse::CalcExtent() const {
  const Pose X_WO = world_.CalcObjectPose();
  Pose upside_down = Pose::Identity();
  upside_down.rotate(Eigen::AngleAxisd(kPi, Vector3d::UnitX()));
  return -world_.collider().CalcLowestPoint(upside_down * X_WO) -
         world_.collider().CalcLowestPoint(X_WO);
}

TrialFacts TrialCourse::MakeFacts() const {
  TrialFacts facts;
  facts.phase = strategy_.phase();
  facts.time = time_;
  facts.time_in_phase = strategy_.time_in_phase();
  facts.lift_time = setup_.strategy.lift_time;
  facts.lift_distance = setup_.grasp.approach_distance;
  facts.is_finite = report_.is_finite;
  facts.unconverged_time = unconverged_time_;
  facts.grip_force = report_.grip_force;
  facts.closed_grip_force = result_.grip_force;
  facts.table_force = report_.table_force;
  facts.last_touch = last_touch_;
  facts.displacement = (world_.state().p_WOcm - rest_position_).head<2>().norm();
  facts.rise = CalcRise();
  facts.relative_speed = (world_.state().v_WOcm - world_.state().v_WH).norm();
  return facts;
}

void TrialCourse::Finish() {
  TrialFacts facts = MakeFacts();
  facts.extent = CalcExtent();
  facts.rest_extent = rest_extent_;
  facts.contacts = result_.contacts;
  const OutcomeReason outcome = FindOutcome(facts);
  result_.outcome = outcome.outcome;
  result_.reason = outcome.reason;
  TakeSnapshot("lifted");
  result_.lift_height = facts.rise;
  result_.end_speed = facts.relative_speed;
  if (held_at_) {
    result_.hold_slip = (world_.state().X_WH.inverse() * world_.state().p_WOcm - *held_at_).norm();
  }
  if (facts.phase == Phase::kDone) {
    result_.steady_penetration = report_.worst_penetration;
    if (settled_at_) {
      const Pose moved = settled_at_->inverse() * CalcObjectInPalm();
      result_.hold_creep =
          moved.translation().norm() +
          CalcObjectRadius(*setup_.object) * Eigen::AngleAxisd(moved.linear()).angle();
    }
  }
  result_.stability = stability_.Calc();
  is_held_ = facts.phase == Phase::kDone && IsHeld(facts);
  Stability& stability = result_.stability;
  stability.sigma = is_held_ ? stability.hold.sigma : 0.0;
  stability.sigma_proposed = is_held_ ? stability.stabilisation.sigma_proposed : 0.0;
  result_.simulated_time = time_;
  result_.energy_residual = world_.CalcEnergyResidual();
  for (DigitContact& contact : result_.contacts) contact.time -= closure_start_;
  for (PhaseStart& phase : result_.phases) phase.time -= closure_start_;
  result_.contact_events = events_.MakeEvents();
  for (ContactEvent& event : result_.contact_events) event.time -= closure_start_;
  result_.timing = CalcContactTiming(result_.contacts, 0.0);
}

TrialResult TrialCourse::Run() {
  Start();
  Phase phase = strategy_.phase();
  while (!IsDecided(MakeFacts())) {
    StrategyObservation observation;
    observation.grip_force = report_.grip_force;
    observation.all_digits_touched =
        std::all_of(result_.contacts.begin(), result_.contacts.end(),
                    [](const DigitContact& contact) { return !std::isnan(contact.time); });
    const StrategyCommand command = strategy_.Step(setup_.sim.step, observation);
    if (strategy_.phase() != phase) {
      phase = strategy_.phase();
      EnterPhase(phase);
      if (phase == Phase::kDone) break;
      if (phase == Phase::kLiftOff && report_.grip_force == 0.0) break;
    }
    command_ = MakeCommand(command);
    Observe(world_.Step(command_), command.closing);
  }
  Finish();
  return result_;
}

Judgement TrialCourse::Judge() const {
  return JudgeGrasp(HeldObject(world_, command_, setup_),
                    stability_.MakeInstant(world_).grasp.contacts);
}

}  // namespace graspbench
