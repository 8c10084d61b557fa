#include "core/trial/grip/grip_regulator.h"

#include <algorithm>
#include <cmath>

#include "core/quality/holding_force.h"
#include "core/trial/grip/unfelt_force.h"
#include "core/trial/measures/stability.h"

namespace graspbench {
namespace {

constexpr double kFilterTime = 0.02;      // of forces and setpoints [s]
constexpr double kShiftTime = 0.1;        // in which an error falls to 1/e [s]
constexpr double kShareTime = 0.1;        // likewise for a difference within a side [s]
constexpr double kDeadShare = 0.02;       // of A
constexpr double kDeadDifference = 0.05;  // of a share
constexpr double kBandShare = 0.1;        // of A, in which stabilisation ends
constexpr double kLookInterval = 0.1;     // between two computations of the smallest force [s]
constexpr double kAtTarget = 1e-9;        // of s
constexpr double kAtLimit = 1.0 - 1e-6;   // of a torque limit
/** Likewise, for a drive that is reported to be at its limit: what it holds creeps, and so does its
torque. */
constexpr double kNearLimit = 0.9;
constexpr double kStopAngle = 1e-3;       // [rad]
constexpr double kMostTorqueShare = 4.0;  // largest c; its inverse is the least
/** Share of a drive's torque limit that bears its finger, whatever the grip. */
constexpr double kLeastTorque = 0.02;
constexpr double kMostShift = 1.0;   // rate of s over that of the closure
constexpr double kKnownTouch = 0.2;  // force at which a digit touches if its elements do not feel
                                     // [N]
constexpr double kTrace = 1e-6;      // force of a contact of which only the position is known [N]
constexpr double kLeastRest = 5e-3;  // mean of the hold above which the rest of the hand presses
                                     // [N]

std::vector<double> FindCourse(const Grasp& grasp, const std::string& digit) {
  const auto own = grasp.course.closing.find(digit);
  return own == grasp.course.closing.end() ? std::vector<double>() : own->second;
}

}  // namespace

GripRegulator::GripRegulator(const TrialSetup& setup, const std::vector<int>& digits)
    : setup_(std::make_shared<TrialSetup>(setup)),
      mode_(RowFromName(kGripModes, setup.strategy.grip, "grip").value),
      is_saturating_(is_regulated() &&
                     RowFromName(kDriveLaws, setup.strategy.drive_law, "drive law").value ==
                         DriveLaw::kSaturating),
      most_closing_(setup.grasp.palm_may_touch ? 1.0 : kMostClosing),
      way_(setup.grasp.q_target - setup.grasp.q_pre),
      parts_(MapLinksToParts(*setup.hand, digits)),
      told_weight_(setup.object->mass_properties.mass * setup.sim.gravity),
      told_friction_(setup.object->surface.friction_dynamic) {
  const Hand& hand = *setup.hand;
  const int opposing = FindOpposingDigit(hand, setup.grasp);
  for (const int index : digits) {
    const Digit& digit = hand.digits[static_cast<size_t>(index)];
    ClosingSchedule schedule;
    if (const auto own = setup.grasp.closing.find(digit.id); own != setup.grasp.closing.end()) {
      schedule = own->second;
    }
    const double late = setup.lateness.empty() ? 0.0 : setup.lateness[static_cast<size_t>(index)];
    schedule.delay += late;
    digits_.push_back(
        {index, index == opposing, late > 0.0, FindDrivenJoints(hand, digit),
         ClosingLaw(schedule, FindCourse(setup.grasp, digit.id), setup.grasp.course.period)});
  }
}

double GripRegulator::CalcClosureTime() const {
  double slowest = setup_->strategy.closure_time;
  for (const auto& [digit, schedule] : setup_->grasp.closing) {
    slowest = std::max(slowest, CalcClosingTime(schedule, setup_->strategy.closure_time));
  }
  const GraspCourse& course = setup_->grasp.course;
  return course.is_set() ? course.duration() - course.closure_start + slowest : slowest;
}

void GripRegulator::FollowTouches(const World& world, const std::vector<HandContact>& contacts,
                                  const TouchSensors* sensors) {
  std::vector<bool> touches(digits_.size() + 1, false);
  for (const HandContact& contact : contacts) {
    touches[static_cast<size_t>(parts_[static_cast<size_t>(contact.link)])] = true;
  }
  for (size_t d = 0; d < digits_.size(); ++d) {
    DigitGrip& digit = digits_[d];
    const bool has_touched =
        sensors ? sensors->has_felt(digit.digit) || digit.force > kKnownTouch : touches[d];
    if (!has_touched || digit.has_touched) continue;
    digit.has_touched = true;
    if (is_regulated()) TakeBack(digit, world);
  }
}

/** While the digit moved, its drive's spring was ahead of it by what damping requires. When it is
blocked, this lead would become force. */
void GripRegulator::TakeBack(DigitGrip& digit, const World& world) const {
  const double closing = FindClosing(digit, [&](int joint) {
    return CalcDrivePosition(*setup_->hand, world.state(), joint) - setup_->grasp.q_pre[joint] -
           setup_->draw.joint_error[joint];
  });
  if (!std::isnan(closing)) digit.law.MoveTo(std::min(digit.law.closing(), closing));
}

template <class Way>
double GripRegulator::FindClosing(const DigitGrip& digit, Way way) const {
  double along = 0.0, length = 0.0;
  for (const int joint : digit.joints) {
    const double stiffness = setup_->hand->joints[static_cast<size_t>(joint)].drive.stiffness;
    double moved = way(joint);
    if (offset_.size() > 0) moved -= offset_[joint];
    along += stiffness * way_[joint] * moved;
    length += stiffness * way_[joint] * way_[joint];
  }
  return length > 0.0 ? along / length : kUnset;
}

GripRegulator GripRegulator::TakeOver(GripMode mode, const Eigen::VectorXd& asked) const {
  GripRegulator made = *this;
  TrialSetup setup = *setup_;
  setup.strategy.grip = RowOf(kGripModes, mode).name;
  made.mode_ = mode;
  made.is_saturating_ = setup.strategy.drive_law == RowOf(kDriveLaws, DriveLaw::kSaturating).name;
  made.setup_ = std::make_shared<TrialSetup>(std::move(setup));
  made.offset_ = Eigen::VectorXd::Zero(asked.size());
  for (DigitGrip& digit : made.digits_) {
    const double closing =
        FindClosing(digit, [&](int joint) { return asked[joint] - setup_->grasp.q_pre[joint]; });
    if (std::isnan(closing)) continue;
    digit.law.MoveTo(closing);
    digit.beyond = std::clamp(closing - 1.0, 0.0, most_closing_ - 1.0);
    for (const int joint : digit.joints) {
      made.offset_[joint] =
          asked[joint] - setup_->grasp.q_pre[joint] -
          digit.CalcClosing() * (setup_->grasp.q_target[joint] - setup_->grasp.q_pre[joint]);
    }
  }
  return made;
}

double GripRegulator::CalcCommand(const DigitGrip& digit, int joint) const {
  const double own =
      setup_->grasp.q_pre[joint] +
      digit.CalcClosing() * (setup_->grasp.q_target[joint] - setup_->grasp.q_pre[joint]) +
      setup_->draw.joint_error[joint];
  return offset_.size() > 0 ? own + offset_[joint] : own;
}

void GripRegulator::FindSmallest(const World& world, const std::vector<HandContact>& contacts) {
  const WorldState& state = world.state();
  const Eigen::Matrix3d R_OW = state.R_WO.transpose();
  LoadedGrasp grasp;
  grasp.weight = setup_->object->mass_properties.mass * (R_OW * state.gravity_W);
  grasp.radius = CalcObjectRadius(*setup_->object);
  std::vector<bool> is_free;
  for (const HandContact& contact : contacts) {
    const int part = parts_[static_cast<size_t>(contact.link)];
    const bool is_rest = part == static_cast<int>(digits_.size());
    grasp.contacts.push_back(MakeGraspContact(contact, state, contact.mu_dynamic));
    grasp.digits.push_back(part);
    is_free.push_back(is_rest || digits_[static_cast<size_t>(part)].opposes);
  }
  smallest_ = CalcSmallestGrip(grasp, is_free);
}

double GripRegulator::CalcAskedForce() const {
  const StrategyConfig& strategy = setup_->strategy;
  if (mode_ == GripMode::kForce) return strategy.grip_force;
  const auto num_others = static_cast<double>(
      std::count_if(digits_.begin(), digits_.end(), [](const auto& d) { return !d.opposes; }));
  const double smallest = smallest_.value_or(told_weight_ / (2.0 * told_friction_ * num_others));
  return std::max(strategy.grip_force, strategy.grip_margin * smallest);
}

/** Setpoints of the opposing digit, and of the rest of the hand if it touches, follow from
balance. */
void GripRegulator::ShareForce(const std::vector<PartLoad>& loads, double duration) {
  const double force = CalcAskedForce();
  std::vector<double> asked(loads.size(), force);
  std::vector<int> free;
  bool is_known = true;
  double others = 0.0;
  for (size_t part = 0; part < loads.size(); ++part) {
    const bool is_rest = part == digits_.size();
    const bool touches = loads[part].force > 0.0;
    if (is_rest || digits_[part].opposes) {
      asked[part] = 0.0;
      if (touches) free.push_back(static_cast<int>(part));
      is_known = is_known && (touches || is_rest);
    } else {
      others += force;
      is_known = is_known && touches;
    }
  }
  if (is_known) {
    BalanceForces(loads, free, asked);
  } else {
    for (size_t d = 0; d < digits_.size(); ++d) {
      if (digits_[d].opposes) asked[d] = others;
    }
  }
  const double weight = duration / (kFilterTime + duration);
  asked_ = sum_ = 0.0;
  for (size_t d = 0; d < digits_.size(); ++d) {
    DigitGrip& digit = digits_[d];
    digit.asked += (digit.asked == 0.0 ? 1.0 : weight) * (asked[d] - digit.asked);
    if (!digit.is_known) continue;
    asked_ += digit.asked;
    sum_ += digit.force;
  }
  rest_asked_ += weight * (asked.back() - rest_asked_);
  asked_ += rest_asked_;
  sum_ += rest_force_;
}

/** Returns the contacts with the forces that a hand with sensed touch estimates. An unknown force
becomes a trace, since the direction of the push counts. */
std::vector<HandContact> GripRegulator::EstimateForces(World& world, const WorldCommand& command,
                                                       const std::vector<HandContact>& contacts,
                                                       const TouchSensors& sensors) {
  std::vector<HandContact> estimated = EstimateContacts(
      contacts, sensors, world.dynamics(), CalcContactTorques(*setup_->hand, world, command));
  for (DigitGrip& digit : digits_) digit.is_known = true;
  for (HandContact& contact : estimated) {
    if (!std::isnan(contact.normal_force)) continue;
    contact.normal_force = kTrace;
    const auto part = static_cast<size_t>(parts_[static_cast<size_t>(contact.link)]);
    if (part < digits_.size()) digits_[part].is_known = false;
  }
  return estimated;
}

void GripRegulator::Observe(Phase phase, World& world, const WorldCommand& command,
                            const std::vector<HandContact>& contacts, const TouchSensors* sensors,
                            double duration) {
  time_ += duration;
  if (phase == Phase::kLiftOff && phase_ != Phase::kLiftOff) {
    was_in_band_ = is_in_band();
    closed_ = sum_;
    for (DigitGrip& digit : digits_) {
      digit.closed = digit.force;
      digit.fault = FindFault(digit, digit.asked, digit.force, digit.pressed);
    }
  }
  phase_ = phase;
  FollowTouches(world, contacts, sensors);
  if (!is_regulated()) return;
  const auto load = [&](const std::vector<HandContact>& pressing) {
    return CalcPartLoads(pressing, parts_, static_cast<int>(digits_.size()) + 1, world.dynamics(),
                         world.state().gravity_W);
  };
  const std::vector<PartLoad> truth = load(contacts);
  const std::vector<PartLoad> loads =
      sensors ? load(EstimateForces(world, command, contacts, *sensors)) : truth;
  std::vector<double> forces;
  for (const PartLoad& part : loads) forces.push_back(part.force);
  // No drive holds the palm, which bears the load of the digits.
  if (sensors && forces.back() > 0.0) {
    BalanceForces(loads, {static_cast<int>(digits_.size())}, forces);
  }
  const double weight = duration / (kFilterTime + duration);
  for (size_t d = 0; d < digits_.size(); ++d) {
    DigitGrip& digit = digits_[d];
    digit.force += weight * (forces[d] - digit.force);
    digit.pressed += weight * (truth[d].force - digit.pressed);
    if (loads[d].force > 0.0) {
      digit.torque = loads[d].torque;
      digit.stiffness = CalcClosingStiffness(*setup_->hand, world.dynamics(), loads[d], way_);
    }
  }
  rest_force_ += weight * (forces.back() - rest_force_);
  ShareForce(loads, duration);
  peak_ = std::max(peak_, sum_);

  const bool has_closed = phase >= Phase::kStabilisation;
  regulates_ =
      regulates_ || (phase >= Phase::kLiftOff && sum_ > 0.0) ||
      (has_closed && sum_ > 0.0 &&
       (sum_ >= asked_ || std::all_of(digits_.begin(), digits_.end(), [&](const DigitGrip& digit) {
          return digit.force >= digit.asked || digit.CalcClosing() >= 1.0 - kAtTarget ||
                 IsAtLimit(digit);
        })));
  if (mode_ == GripMode::kMargin && has_closed && phase < Phase::kLiftOff && sum_ > 0.0 &&
      time_ >= next_look_) {
    FindSmallest(world, contacts);
    next_look_ = time_ + kLookInterval;
  }
  const bool is_in_band = regulates_ && std::abs(sum_ - asked_) <= kBandShare * asked_;
  if (!is_in_band) in_band_since_ = kUnset;
  if (is_in_band && std::isnan(in_band_since_)) in_band_since_ = time_;
  NoteHold(phase, duration);

  const Hand& hand = *setup_->hand;
  drive_positions_.resize(hand.num_joints());
  dofs_.resize(static_cast<size_t>(hand.num_joints()));
  is_stopped_.assign(static_cast<size_t>(hand.num_joints()), false);
  for (int joint = 0; joint < hand.num_joints(); ++joint) {
    dofs_[static_cast<size_t>(joint)] = world.dynamics().dof_of_joint(joint);
    drive_positions_[joint] = CalcDrivePosition(hand, world.state(), joint);
    const HandJoint& one = hand.joints[static_cast<size_t>(joint)];
    const double q = world.state().q[joint];
    if (one.coupled_to < 0) {
      is_stopped_[static_cast<size_t>(joint)] = (way_[joint] > 0.0 && q > one.upper - kStopAngle) ||
                                                (way_[joint] < 0.0 && q < one.lower + kStopAngle);
      continue;
    }
    const double upper = hand.coupling == CouplingRule::kMiddleFirst
                             ? std::min(one.upper, world.state().q[one.coupled_to])
                             : one.upper;
    is_stopped_[static_cast<size_t>(joint)] = q > upper - kStopAngle && q > kStopAngle;
  }
}

void GripRegulator::NoteHold(Phase phase, double duration) {
  if (phase != Phase::kHold) return;
  held_time_ += duration;
  held_sum_ += duration * sum_;
  held_asked_ += duration * asked_;
  rest_held_sum_ += duration * rest_force_;
  rest_held_asked_ += duration * rest_asked_;
  for (DigitGrip& digit : digits_) {
    digit.held_sum += duration * digit.force;
    digit.asked_sum += duration * digit.asked;
    digit.pressed_sum += duration * digit.pressed;
  }
}

/** Whether the spring of a drive that closes a digit asks for this share of its limit. */
bool GripRegulator::IsAtLimit(const DigitGrip& digit, int joint, double share) const {
  if (drive_positions_.size() == 0 || way_[joint] == 0.0) return false;
  const JointDrive& drive = setup_->hand->joints[static_cast<size_t>(joint)].drive;
  const double torque = drive.stiffness * (CalcCommand(digit, joint) - drive_positions_[joint]);
  return torque * (way_[joint] > 0.0 ? 1.0 : -1.0) >= share * drive.torque_limit;
}

bool GripRegulator::IsAtLimit(const DigitGrip& digit) const {
  return std::any_of(digit.joints.begin(), digit.joints.end(),
                     [&](int joint) { return IsAtLimit(digit, joint, kAtLimit); });
}

bool GripRegulator::IsStopped(const DigitGrip& digit) const {
  return digit.CalcClosing() >= (digit.has_touched ? most_closing_ : 1.0) - kAtTarget ||
         IsAtLimit(digit);
}

/** Two digits that both oppose a third: one gains what the other gives up, so that the sum and the
opposing digit's share are unchanged. */
void GripRegulator::ShareWithinSide(double duration) {
  if (digits_.size() != 3) return;
  std::vector<DigitGrip*> side;
  for (DigitGrip& digit : digits_) {
    if (!digit.opposes && digit.is_known && digit.has_touched) side.push_back(&digit);
  }
  if (side.size() != 2) return;
  const double difference = side[1]->force / side[1]->asked - side[0]->force / side[0]->asked;
  if (std::abs(difference) < kDeadDifference || IsStopped(*side[difference > 0.0 ? 0 : 1])) return;
  const double most = kMostShift * duration / setup_->strategy.closure_time;
  for (const double sign : {1.0, -1.0}) {
    DigitGrip& digit = *side[sign > 0.0 ? 0 : 1];
    const double shift =
        0.5 * sign * digit.asked / digit.stiffness * difference * duration / kShareTime;
    digit.Shift(std::clamp(shift, -most, most), most_closing_);
  }
}

void GripRegulator::Advance(Phase phase, double duration) {
  const StrategyConfig& strategy = setup_->strategy;
  course_time_ += duration;
  is_closing_ = false;
  if (regulates_) {
    if (!is_saturating_) ShareWithinSide(duration);
    const double error = asked_ > 0.0 ? (asked_ - sum_) / asked_ : 0.0;
    if (std::abs(error) < kDeadShare) return;
    if (is_saturating_) {
      torque_share_ = std::clamp(torque_share_ * (1.0 + error * duration / kShiftTime),
                                 1.0 / kMostTorqueShare, kMostTorqueShare);
    }
    const double most = kMostShift * duration / strategy.closure_time;
    for (DigitGrip& digit : digits_) {
      if (is_saturating_ || !digit.has_touched || !digit.is_known) continue;
      const double shift =
          std::clamp(digit.asked / digit.stiffness * error * duration / kShiftTime, -most, most);
      if (shift > 0.0 && IsAtLimit(digit)) continue;
      digit.Shift(shift, most_closing_);
    }
    return;
  }
  if (phase < Phase::kClosure && !setup_->grasp.course.is_set()) return;
  for (DigitGrip& digit : digits_) {
    if (phase > Phase::kStabilisation && !digit.is_late) continue;
    const bool has_force = digit.has_touched && digit.force >= digit.asked;
    if (is_regulated() && !is_saturating_ && (has_force || IsAtLimit(digit))) {
      continue;
    }
    const double closing = digit.law.closing();
    digit.law.Advance(duration, strategy.closure_time,
                      digit.has_touched ? strategy.touch_speed : 1.0);
    is_closing_ = is_closing_ || digit.law.closing() > closing;
  }
}

void GripRegulator::Command(WorldCommand& command) const {
  const Hand& hand = *setup_->hand;
  if (is_saturating_) {
    command.torque_limit.resize(hand.num_joints());
    for (int joint = 0; joint < hand.num_joints(); ++joint) {
      command.torque_limit[joint] = hand.joints[static_cast<size_t>(joint)].drive.torque_limit;
    }
  }
  for (const DigitGrip& digit : digits_) {
    for (const int joint : digit.joints) {
      command.q[joint] = CalcCommand(digit, joint);
      if (!is_saturating_ || !digit.has_touched || digit.torque.size() == 0) continue;
      command.torque_limit[joint] = CalcSharedTorque(digit, joint);
    }
  }
}

/** Limit of the drive of a touching digit under the saturating law [N m]. */
double GripRegulator::CalcSharedTorque(const DigitGrip& digit, int joint) const {
  const double limit = setup_->hand->joints[static_cast<size_t>(joint)].drive.torque_limit;
  return std::clamp(torque_share_ * digit.asked * std::abs(digit.torque[dofs_[joint]]),
                    kLeastTorque * limit, limit);
}

/** Returns a joint that closes the digit and whose drive is nearly at its limit; -1: none. At a
joint stop the drive's torque does not press on the object, and a drive that is limited to a share
of its torque could exert more. */
int GripRegulator::FindFullDrive(const DigitGrip& digit) const {
  for (const int joint : digit.joints) {
    if (is_stopped_.empty() || is_stopped_[static_cast<size_t>(joint)]) continue;
    if (!IsAtLimit(digit, joint, kNearLimit)) continue;
    const bool is_shared = is_saturating_ && digit.has_touched && digit.torque.size() > 0;
    const JointDrive& drive = setup_->hand->joints[static_cast<size_t>(joint)].drive;
    if (is_shared && CalcSharedTorque(digit, joint) < kNearLimit * drive.torque_limit) continue;
    return joint;
  }
  return -1;
}

std::pair<GripFault, int> GripRegulator::FindFault(const DigitGrip& digit, double asked,
                                                   double reached, double pressed) const {
  // With sensed touch, the true force differs from the estimate.
  const bool misses_much = std::abs(pressed - reached) > kGripTolerance * std::max(asked, reached);
  if (!digit.is_known || misses_much) return {GripFault::kNotFelt, -1};
  if (!digit.has_touched) return {GripFault::kNoTouch, -1};
  if (std::abs(reached - asked) <= kGripTolerance * asked) return {GripFault::kNone, -1};
  if (reached > asked) return {GripFault::kBalance, -1};
  if (digit.CalcClosing() >= most_closing_ - kAtTarget) return {GripFault::kPosture, -1};
  if (const int joint = FindFullDrive(digit); joint >= 0) return {GripFault::kLimit, joint};
  const Hand& hand = *setup_->hand;
  for (const int link : hand.digits[static_cast<size_t>(digit.digit)].links) {
    const int joint = hand.links[static_cast<size_t>(link)].joint;
    if (joint < 0 || is_stopped_.empty() || !is_stopped_[static_cast<size_t>(joint)]) continue;
    const bool is_driven = hand.joints[static_cast<size_t>(joint)].coupled_to < 0;
    return {is_driven ? GripFault::kStop : GripFault::kCoupling, joint};
  }
  return {GripFault::kBalance, -1};
}

GripRecord GripRegulator::MakeRecord() const {
  GripRecord record;
  record.told_weight = told_weight_;
  record.told_friction = mode_ == GripMode::kMargin ? told_friction_ : 0.0;
  if (smallest_) record.smallest = *smallest_;
  record.force = CalcAskedForce();
  record.asked = held_time_ > 0.0 ? held_asked_ / held_time_ : asked_;
  record.closed = closed_;
  if (held_time_ > 0.0) record.held = held_sum_ / held_time_;
  if (held_time_ > 0.0 && rest_held_sum_ > kLeastRest * held_time_) {
    record.rest_asked = rest_held_asked_ / held_time_;
    record.rest_held = rest_held_sum_ / held_time_;
  }
  record.peak = peak_;
  record.was_in_band = was_in_band_;
  for (const DigitGrip& digit : digits_) {
    DigitGripRecord& of = record.digits.emplace_back();
    of.digit = setup_->hand->digits[static_cast<size_t>(digit.digit)].id;
    of.opposes = digit.opposes;
    of.asked = held_time_ > 0.0 ? digit.asked_sum / held_time_ : digit.asked;
    of.closed = digit.closed;
    if (held_time_ > 0.0) of.held = digit.held_sum / held_time_;
    of.closing = digit.CalcClosing();
    const bool was_lost = held_time_ == 0.0 && !std::isnan(closed_);  // then the final state gives
                                                                      // no information
    const auto [fault, joint] =
        was_lost ? digit.fault
                 : FindFault(digit, of.asked, held_time_ > 0.0 ? of.held : digit.force,
                             held_time_ > 0.0 ? digit.pressed_sum / held_time_ : digit.pressed);
    of.fault = fault;
    if (joint >= 0) of.joint = setup_->hand->joints[static_cast<size_t>(joint)].name;
  }
  return record;
}

}  // namespace graspbench
