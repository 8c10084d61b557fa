#include "core/trial/protocols/table_lift.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/hand/hand.h"
#include "core/trial/judge/judge.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** Creep counts after this share of the hold, in which the swing of the lift dies away. */
constexpr double kSettlingShare = 0.5;
/** Steps between two looks at the gap of a digit that has not touched. */
constexpr int kGapInterval = 5;

/** The times of the grasp's course replace those of placing. */
StrategyConfig FindStrategy(const TrialSetup& setup) {
  StrategyConfig strategy = setup.strategy;
  const GraspCourse& course = setup.grasp.course;
  if (course.is_set()) {
    strategy.placing_time = course.duration();
    strategy.closure_lead = course.duration() - course.closure_start;
  }
  return strategy;
}

/** @throws Error(kUnsupported) for sensed touch of a hand that feels nothing. */
GripRegulator MakeRegulator(const TrialSetup& setup, const std::vector<int>& digits) {
  if (setup.touch == TouchSense::kSensed && !setup.hand->skin) {
    throw Error(ErrorKind::kUnsupported, "the hand \"" + setup.hand->id +
                                             "\" has no tactile.yaml, so that it feels nothing");
  }
  return GripRegulator(setup, digits);
}

}  // namespace

TableLift::TableLift(std::unique_ptr<World> world, const TrialSetup& setup, WristCamera* camera)
    : TrialCourse(std::move(world)),
      setup_(setup),
      placement_(CalcPlacement(*setup.hand, setup.grasp, *setup.object)),
      digits_(ListGraspingDigits(*setup.hand, setup.grasp)),
      notes_{GraspStrategy(FindStrategy(setup), setup.grasp.approach_distance),
             StabilityMeter(setup),
             ContactEventRecorder(*setup.hand),
             LoadRecorder(setup_, digits_),
             MakeRegulator(setup_, digits_),
             PalmApproach(setup.grasp.seeks_palm)},
      hand_(*setup.hand),
      object_radius_(CalcObjectRadius(*setup.object)) {
  for (const int digit : digits_) {
    const bool opposes = digit == FindOpposingDigit(hand_, setup.grasp);
    notes_.result.contacts.push_back(
        {hand_.digits[static_cast<size_t>(digit)].id, opposes, kUnset});
    notes_.result.touches.emplace_back();
  }
  notes_.strategy.SetClosureTime(notes_.grip.CalcClosureTime());
  if (setup.touch == TouchSense::kSensed) {
    notes_.sensors.emplace(hand_, setup.sensors, FormatDraw());
  }
  Position(camera);
}

WorldCommand TableLift::MakeCommand(const StrategyCommand& command) const {
  WorldCommand result;
  result.q = setup_.grasp.q_pre + command.closing * (setup_.grasp.q_target - setup_.grasp.q_pre) +
             setup_.draw.joint_error;
  notes_.grip.Command(result);
  for (const DriveCommand& drive : setup_.drives) {
    // Half a step less, so that the times of steps need no exact sums.
    if (notes_.time < drive.time - 0.5 * setup_.sim.step) break;
    result.q[drive.joint] = drive.position + setup_.draw.joint_error[drive.joint];
  }
  // The object is lifted straight up, also when it was approached from the side.
  const bool is_lifting = notes_.strategy.phase() >= Phase::kLiftOff;
  const Vector3d away_W = is_lifting ? Vector3d(Vector3d::UnitZ()) : -placement_.approach_W;
  result.X_WH = placement_.X_WH;
  result.X_WH.pretranslate(command.distance * away_W +
                           notes_.palm.offset() * placement_.approach_W);
  result.v_WH = command.speed * away_W + notes_.palm.speed() * placement_.approach_W;
  if (setup_.grasp.course.is_set() && notes_.strategy.phase() < Phase::kStabilisation) {
    const double time = notes_.grip.course_time();
    result.X_WH = placement_.X_WH * MakePose(CalcHandAway(setup_.grasp.course, time));
    result.v_WH = placement_.X_WH.linear() * CalcHandSpeed(setup_.grasp.course, time);
  }
  return result;
}

bool TableLift::IsTouching(int digit) const {
  const std::vector<int>& links = hand_.digits[digit].links;
  return std::any_of(links.begin(), links.end(),
                     [&](int link) { return notes_.report.link_touches_object[link]; });
}

double TableLift::CalcGap(const std::vector<int>* links) const {
  const Pose X_OW = world_->CalcObjectPose().inverse();
  const std::vector<Pose> X_HL = CalcLinkPoses(hand_, world_->state().q);
  double gap = std::numeric_limits<double>::infinity();
  for (const ContactSphere& sphere : hand_.contact_spheres) {
    if (links && std::find(links->begin(), links->end(), sphere.link) == links->end()) continue;
    const Vector3d p_OS = X_OW * (world_->state().X_WH * (X_HL[sphere.link] * sphere.p_LS));
    gap = std::min(gap, setup_.object->field->Query(p_OS).distance - sphere.radius);
  }
  return gap;
}

SeatMeter::Place TableLift::FindPlace() const {
  const WorldState& state = world_->state();
  const Pose X_WPalm = CalcPalmPose(hand_, state);
  return {X_WPalm.inverse() * MakePose(state.R_WO, state.p_WOcm),
          state.p_WOcm.z() - X_WPalm.translation().z()};
}

void TableLift::Observe(const StepReport& report) {
  const double duration = notes_.command.num_steps * setup_.sim.step;
  notes_.report = report;
  notes_.time += duration;
  ++notes_.result.num_steps;
  if (!report.converged) {
    ++notes_.result.num_unconverged;
    notes_.unconverged_time += duration;
  } else {
    notes_.unconverged_time = 0.0;
  }
  notes_.result.worst_penetration =
      std::max(notes_.result.worst_penetration, report.worst_penetration);
  if (report.grip_force > 0.0) {
    notes_.last_touch = notes_.time;
    if (!notes_.seat.has_begun()) notes_.seat.Begin(FindPlace());
  }
  if (report.arm_joint >= 0) ObserveArm();
  ObserveTouches();
  world_->FindHandContacts(hand_contacts_);
  if (notes_.strategy.phase() < Phase::kLiftOff) {
    notes_.seat.Observe(hand_contacts_, duration);
  } else {
    notes_.steady.Observe(hand_contacts_, report.table_force,
                          CalcSlipSpeed(world_->state(), object_radius_), duration);
  }
  notes_.events.Observe(notes_.time, duration, hand_contacts_);
  notes_.loads.Observe(notes_.time, duration, *world_, notes_.command, report, hand_contacts_);
  if (notes_.sensors) notes_.sensors->Observe(notes_.time, hand_contacts_, world_->dynamics());
  notes_.grip.Observe(notes_.strategy.phase(), *world_, notes_.command, hand_contacts_,
                      notes_.sensors ? &*notes_.sensors : nullptr, duration);
  notes_.stability.Observe(*world_, notes_.strategy.phase(), notes_.strategy.time_in_phase(),
                           notes_.command.num_steps);
  if (notes_.strategy.phase() == Phase::kHold && !notes_.settled_at &&
      notes_.strategy.time_in_phase() >= kSettlingShare * setup_.strategy.hold_time) {
    notes_.settled_at = FindPlace().X_PalmOcm;
  }
}

/** The time at which a digit's first link touched in the step that has just ended [s]. */
double TableLift::CalcTouchTime(int digit) const {
  double ago = 0.0;
  for (int link : hand_.digits[digit].links) {
    if (!notes_.report.touch_age.empty()) ago = std::max(ago, notes_.report.touch_age[link]);
  }
  return notes_.time - ago;
}

/** What touches when the object is being lifted takes no part in the closure. */
void TableLift::ObserveTouches() {
  if (notes_.strategy.phase() >= Phase::kLiftOff) return;
  const bool is_closing = notes_.strategy.phase() == Phase::kClosure ||
                          notes_.strategy.phase() == Phase::kStabilisation;
  for (size_t d = 0; d < digits_.size(); ++d) {
    if (!std::isnan(notes_.result.contacts[d].time)) continue;
    DigitTouch& touch = notes_.result.touches[d];
    if (IsTouching(digits_[d])) {
      notes_.result.contacts[d].time = CalcTouchTime(digits_[d]);
      touch = {FindClosing(d), world_->state().q, 0.0};
    } else if (is_closing && notes_.result.num_steps % kGapInterval == 0) {
      touch.smallest_gap = std::fmin(touch.smallest_gap, CalcGap(&hand_.digits[digits_[d]].links));
    }
  }
}

void TableLift::EnterPhase(Phase phase) {
  notes_.result.phases.push_back({NameOf(phase), notes_.time});
  if (phase == Phase::kClosure) {
    notes_.closure_start = notes_.time;
    notes_.result.snapshots.push_back(TakeSnapshot(Moment::kPreGrasp));
  } else if (phase == Phase::kLiftOff) {
    notes_.result.grip_force = notes_.report.grip_force;
    notes_.seat.End(FindPlace(), notes_.result);
    notes_.result.snapshots.push_back(TakeSnapshot(Moment::kClosed));
  } else if (phase == Phase::kHold) {
    notes_.held_at = world_->state().X_WH.inverse() * world_->state().p_WOcm;
  }
}

SceneSnapshot TableLift::TakeSnapshot(Moment moment) const {
  SceneSnapshot snapshot;
  snapshot.moment = moment;
  snapshot.time = notes_.time;
  snapshot.X_WH = world_->state().X_WH;
  snapshot.X_WO = world_->CalcObjectPose();
  snapshot.q = world_->state().q;
  return snapshot;
}

double TableLift::CalcExtent() const {
  const Pose X_WO = world_->CalcObjectPose();
  Pose upside_down = Pose::Identity();
  upside_down.rotate(Eigen::AngleAxisd(kPi, Vector3d::UnitX()));
  return -world_->collider().CalcLowestPoint(upside_down * X_WO) -
         world_->collider().CalcLowestPoint(X_WO);
}

TrialFacts TableLift::MakeFacts() const {
  TrialFacts facts;
  facts.phase = notes_.strategy.phase();
  facts.time = notes_.time;
  facts.time_in_phase = notes_.strategy.time_in_phase();
  facts.lift_time = setup_.strategy.lift_time;
  facts.lift_distance = setup_.grasp.approach_distance;
  facts.not_seen = notes_.not_seen;
  facts.policy_fault = notes_.policy_fault;
  facts.arm_fault = notes_.arm_fault;
  facts.arm_reason = notes_.arm_reason;
  facts.is_reachable = placement_.reaches_object;
  facts.start_gap = notes_.start_gap;
  facts.report = notes_.report;
  facts.unconverged_time = notes_.unconverged_time;
  facts.closed_grip_force = notes_.result.grip_force;
  facts.last_touch = notes_.last_touch;
  facts.displacement = (world_->state().p_WOcm - notes_.rest_position).head<2>().norm();
  facts.rise = CalcRise();
  facts.relative_speed = CalcSlipSpeed(world_->state(), object_radius_);
  facts.arm_force_limit = setup_.sim.arm_force_limit;
  facts.arm_moment_limit = setup_.sim.arm_moment_limit;
  if (setup_.arm && notes_.report.arm_joint >= 0) {
    facts.arm_joint = &setup_.arm->arm->joints[static_cast<size_t>(notes_.report.arm_joint)];
  }
  return facts;
}

double TableLift::CalcCreep() const {
  const Pose moved = notes_.settled_at->inverse() * FindPlace().X_PalmOcm;
  return moved.translation().norm() + object_radius_ * Eigen::AngleAxisd(moved.linear()).angle();
}

TrialResult TableLift::End() {
  GRASPBENCH_DEMAND(notes_.is_over, "the trial goes on");
  TrialFacts facts = MakeFacts();
  facts.extent = CalcExtent();
  facts.rest_extent = notes_.rest_extent;
  facts.contacts = notes_.result.contacts;
  facts.contact_force_limit = CalcContactForceLimit(hand_, setup_.sim.arm_force_limit);
  facts.energy_residual = world_->CalcEnergyResidual();
  TrialResult result = notes_.result;
  const OutcomeReason outcome = FindOutcome(facts);
  result.outcome = outcome.outcome;
  result.reason = outcome.reason;
  result.snapshots.push_back(TakeSnapshot(Moment::kLifted));
  result.weight = world_->mass_properties().mass * setup_.sim.gravity;
  result.object_height = notes_.rest_extent;
  result.lift_height = facts.rise;
  result.end_speed = facts.relative_speed;
  if (notes_.held_at) {
    result.hold_slip =
        (world_->state().X_WH.inverse() * world_->state().p_WOcm - *notes_.held_at).norm();
  }
  if (facts.phase == Phase::kDone) {
    result.steady_penetration = notes_.report.worst_penetration;
    if (notes_.settled_at) result.hold_creep = CalcCreep();
  }
  if (is_held()) result.opposition = FindHeldOpposition();
  result.stability = notes_.stability.Calc();
  Stability& stability = result.stability;
  stability.sigma = is_held() ? stability.hold.sigma : 0.0;
  stability.sigma_proposed = is_held() ? stability.stabilisation.sigma_proposed : 0.0;
  result.simulated_time = notes_.time;
  result.energy_residual = facts.energy_residual;
  for (DigitContact& contact : result.contacts) contact.time -= notes_.closure_start;
  for (PhaseStart& phase : result.phases) phase.time -= notes_.closure_start;
  if (notes_.grip.is_regulated()) result.grip = notes_.grip.MakeRecord();
  if (notes_.sensors) result.touch = notes_.sensors->record();
  result.contact_events = notes_.events.MakeEvents();
  for (ContactEvent& event : result.contact_events) event.time -= notes_.closure_start;
  result.timing = CalcContactTiming(result.contacts, 0.0);
  result.diagnosis = FindDiagnosis(result, notes_.loads.samples(), notes_.closure_start);
  return result;
}

std::optional<Opposition> TableLift::FindHeldOpposition() const {
  std::vector<HandContact> contacts;
  world_->FindHandContacts(contacts);
  if (contacts.empty()) return std::nullopt;
  std::vector<Pose> X_WL = CalcLinkPoses(hand_, world_->state().q);
  for (Pose& pose : X_WL) pose = world_->state().X_WH * pose;
  return FindOpposition(hand_, X_WL, contacts);
}

bool TableLift::is_held() const {
  return notes_.is_over && notes_.phase == Phase::kDone && IsHeld(MakeFacts());
}

StrategyObservation TableLift::FindObservation() {
  StrategyObservation observation;
  observation.is_regulated = notes_.grip.is_regulated();
  observation.is_in_band = notes_.grip.is_in_band();
  observation.is_closing = notes_.grip.is_closing();
  if (notes_.sensors) {
    observation.grip_force = notes_.sensors->CalcFeltForce();
    observation.all_digits_touched = notes_.grip.have_all_touched();
    return observation;
  }
  observation.grip_force = notes_.report.grip_force;
  observation.all_digits_touched =
      std::all_of(notes_.result.contacts.begin(), notes_.result.contacts.end(),
                  [](const DigitContact& contact) { return !std::isnan(contact.time); });
  return observation;
}

/** Sensors and a person's drives ask for something in every step. Simbody's integrator fails at the
jumps of a grip that is regulated in long steps. */
int TableLift::ChooseNumSteps() const {
  const Phase phase = notes_.strategy.phase();
  const int num_steps = CalcSteadySteps(setup_.sim);
  const int num_clear = num_steps > 1 ? 2 * num_steps : 1;
  const double step = setup_.sim.step, time = notes_.strategy.time_in_phase();
  const bool is_lifted = phase == Phase::kLiftOff || phase == Phase::kHold;
  const bool is_clear = phase == Phase::kPreGrasp || (phase == Phase::kPlacing && setup_.arm &&
                                                      time + num_clear * step < notes_.clear_time);
  if (!(is_clear || (is_lifted && notes_.steady.are_steady())) || notes_.sensors ||
      !setup_.drives.empty() || (setup_.is_compliant && notes_.grip.is_regulated())) {
    return 1;
  }
  if (is_clear) return num_clear;
  const double end = phase == Phase::kHold ? setup_.strategy.hold_time : setup_.strategy.lift_time;
  // So that samples are taken, and phases end, when they would be: a phase's last step is short.
  const bool is_aligned = std::lround(time / step) % num_steps == 0;
  return is_aligned && time + num_steps * step < end - 0.5 * step ? num_steps : 1;
}

StrategyCommand TableLift::NextCommand(const StrategyObservation& observation, int num_steps) {
  if (notes_.strategy.phase() == Phase::kPreGrasp &&
      notes_.strategy.time_in_phase() >= notes_.result.arm->reach_time) {
    notes_.strategy.StartPlacing(setup_.strategy.placing_time);
  }
  const Phase phase = notes_.strategy.phase();
  const double duration = num_steps * setup_.sim.step;
  const double arrival = setup_.strategy.placing_time - setup_.strategy.closure_lead;
  if (phase == Phase::kPlacing && !notes_.palm.has_ended() &&
      notes_.strategy.time_in_phase() + duration >= arrival) {
    notes_.palm.Advance(duration, notes_.report.arm_force, CalcArmStiffness(placement_.approach_W));
    StrategyCommand stays;
    stays.distance = notes_.strategy.CalcPlacingDistance(setup_.strategy.closure_lead);
    return stays;
  }
  const StrategyCommand command = notes_.strategy.Step(duration, observation);
  notes_.grip.Advance(phase, duration);
  return command;
}

bool TableLift::Advance() {
  notes_.is_over = notes_.is_over || IsDecided(MakeFacts());
  if (notes_.is_over) return false;
  const int num_steps = ChooseNumSteps();
  const StrategyCommand command = NextCommand(FindObservation(), num_steps);
  if (notes_.strategy.phase() != notes_.phase) {
    notes_.phase = notes_.strategy.phase();
    EnterPhase(notes_.phase);
    const bool lifts_nothing = notes_.phase == Phase::kLiftOff && notes_.report.grip_force == 0.0;
    notes_.is_over = notes_.phase == Phase::kDone || lifts_nothing;
    if (notes_.is_over) return false;
  }
  notes_.command = MakeCommand(command);
  if (notes_.phase == Phase::kPreGrasp) Reach(notes_.command);
  notes_.command.num_steps = num_steps;
  Observe(world_->Step(notes_.command));
  return true;
}

std::optional<WorldCommand> TableLift::ComputeOpenLoopCommand() {
  const StrategyCommand command = NextCommand({}, 1);
  notes_.phase = notes_.strategy.phase();
  if (notes_.phase == Phase::kDone) return std::nullopt;
  WorldCommand made = MakeCommand(command);
  if (notes_.phase == Phase::kPreGrasp) Reach(made);
  return made;
}

TrialInstant TableLift::Save() const { return {world_->Clone(), notes_}; }

void TableLift::Restore(const TrialInstant& instant) {
  world_ = instant.world->Clone();
  notes_ = instant.notes;
}

HeldObject TableLift::Hold() const {
  return HeldObject(*world_, notes_.command, setup_, notes_.grip, notes_.sensors);
}

Judgement TableLift::Judge() const {
  return JudgeGrasp(Hold(), notes_.stability.MakeInstant(*world_).grasp.contacts);
}

double TableLift::FindStrength() const {
  if (is_held()) return FindWeakestForce(Hold());
  const double weight = setup_.object->mass_properties.mass * setup_.sim.gravity;
  const double lift_time = setup_.strategy.lift_time, asked = lift_time + setup_.strategy.hold_time;
  double borne = notes_.last_touch - notes_.time;  // the time in which it was lost
  if (notes_.phase == Phase::kLiftOff) borne += notes_.strategy.time_in_phase();
  if (notes_.phase == Phase::kHold) borne += lift_time + notes_.strategy.time_in_phase();
  if (notes_.phase == Phase::kDone) borne += asked;
  return -weight * (1.0 - std::clamp(borne / asked, 0.0, 1.0));
}

const Protocol& GetTableLift() {
  static const Protocol protocol = {
      "table_lift", "pre-grasp, placing, closure, stabilisation, lift-off; then a hold",
      TablePresence::kPresent,
      [](std::unique_ptr<World> world, const TrialSetup& setup,
         WristCamera* camera) -> std::unique_ptr<TrialCourse> {
        return std::make_unique<TableLift>(std::move(world), setup, camera);
      }};
  return protocol;
}

}  // namespace graspbench
