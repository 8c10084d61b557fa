#include "core/trial/judge/judge.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "core/quality/grasp_quality.h"
#include "core/trial/measures/stability.h"
#include "core/trial/protocols/table_lift_outcome.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kFreeTime = 0.05;   ///< [s]
constexpr double kRestSpeed = 1e-5;  ///< [m/s]

constexpr double kGrowthTime = 0.3;                ///< tau [s]
constexpr double kMostTestLoad = 100.0;            ///< [N]
constexpr double kBrokenDistance = 0.02;           ///< [m]
constexpr double kBrokenAngle = RadFromDeg(30.0);  ///< [rad]
/** Above this, cones get 4 edges instead of 8, since a hull in six dimensions grows fast. */
constexpr size_t kMostFineContacts = 8;
constexpr double kWindow = 0.02;  ///< [s]

double CalcMomentum(const HeldObject& object, const Vector3d& direction_W, bool is_moment) {
  const WorldState& state = object.world().state();
  if (!is_moment) return object.mass() * direction_W.dot(state.v_WOcm);
  return direction_W.dot(state.R_WO * (object.world().mass_properties().I_OOcm *
                                       (state.R_WO.transpose() * state.w_WO)));
}

/** @param enough  the pull ends, unbroken, when the hand has balanced this load. */
BreakingLoad FindBreakingLoad(const HeldObject& held, const Vector3d& direction_W, bool is_moment,
                              double enough = std::numeric_limits<double>::infinity()) {
  HeldObject object = held;
  const double arm = is_moment ? held.radius() : 1.0;
  const double weight = held.mass() * kStandardGravity;
  const auto window = static_cast<size_t>(std::max(1L, std::lround(kWindow / held.step())));
  struct Sample {
    double impulse, momentum;
  };
  std::deque<Sample> samples = {{0.0, CalcMomentum(object, direction_W, is_moment)}};
  BreakingLoad result;
  result.load = 0.0;
  double impulse = 0.0;
  for (double level = 0.0; level < kMostTestLoad;) {
    level =
        std::min(kMostTestLoad, weight * std::expm1((object.time() + held.step()) / kGrowthTime));
    const Vector3d load_W = level * arm * direction_W;
    object.world().SetExternalLoad(is_moment ? Vector3d::Zero() : load_W,
                                   is_moment ? load_W : Vector3d::Zero());
    object.Step();
    if (object.CalcMoved() > kBrokenDistance || object.CalcTurned() > kBrokenAngle ||
        object.IsFree()) {
      result.is_broken = true;
      break;
    }
    impulse += level * arm * held.step();
    samples.push_back({impulse, CalcMomentum(object, direction_W, is_moment)});
    if (samples.size() <= window) continue;
    const double gained = samples.back().momentum - samples.front().momentum;
    const double resisted = (samples.back().impulse - samples.front().impulse - gained) /
                            (static_cast<double>(window) * held.step());
    result.load = std::max(result.load, resisted);
    if (result.load >= enough) return result;
    samples.pop_front();
  }
  if (!result.is_broken) result.load = kMostTestLoad * arm;
  return result;
}

void JudgeQuality(const HeldObject& held, const std::vector<GraspContact>& contacts,
                  Judgement& judgement) {
  if (contacts.size() < 2) return;
  for (const QualityConvention& convention : ListQualityConventions()) {
    QualityRequest request;
    request.contacts = contacts;
    request.convention = convention;
    if (contacts.size() > kMostFineContacts) request.num_edges = 4;
    request.torque_scale = convention.calc_torque_scale({held.radius(), held.object().size});
    if (!ListProblems(request).empty()) continue;
    const GraspQuality quality = CalcGraspQuality(request);
    judgement.epsilons.push_back({convention.id, quality.epsilon});
    if (convention.id == ListQualityConventions().front().id) judgement.volume = quality.volume;
  }
}

/** Six half axes of the palm in W. */
std::vector<Vector3d> ListAxes(const HeldObject& held) {
  std::vector<Vector3d> axes;
  for (int axis = 0; axis < 3; ++axis) {
    axes.push_back(held.R_WPalm().col(axis));
    axes.push_back(-held.R_WPalm().col(axis));
  }
  return axes;
}

/** Time until the object has moved or turned by that much; `duration` if it never does. */
double FindFallTime(const HeldObject& held, const Vector3d& gravity_W, double distance,
                    double angle, double duration) {
  HeldObject object = held;
  object.world().SetGravity(gravity_W);
  while (object.time() < duration && !object.IsAtRest()) {
    object.Step();
    if (object.CalcMoved() > distance || object.CalcTurned() > angle) return object.time();
  }
  return duration;
}

Verdict JudgeLiftOff(const HeldObject& held) {
  const bool passed = held.CalcSpeed() <= kSteadySpeed;
  return {"lift_off", passed, passed ? 1.0 : 0.0};
}

Verdict JudgeDexGraspBench(const HeldObject& held) {
  constexpr double kAcceleration = 10.0, kDuration = 2.0, kDistance = 0.05;
  int num_passed = 0;
  for (const Vector3d& axis_W : ListAxes(held)) {
    num_passed += FindFallTime(held, kAcceleration * axis_W, kDistance, RadFromDeg(15.0),
                               kDuration) == kDuration;
  }
  return {"dexgraspbench", num_passed == 6, static_cast<double>(num_passed)};
}

Verdict JudgeGraspa(const HeldObject& held) {
  constexpr double kQuarter = 1.0;  // [s]
  HeldObject object = held;
  const Vector3d gravity_W = held.world().state().gravity_W, axis_W = held.R_WPalm().col(0);
  int num_survived = 0;
  const double ends[] = {0.0, 0.5 * kPi, 0.0, -0.5 * kPi, 0.0};
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double start = object.time();
    while (object.time() < start + kQuarter) {
      const double share = (object.time() - start) / kQuarter;
      const double angle = ends[quarter] + share * (ends[quarter + 1] - ends[quarter]);
      object.world().SetGravity(Eigen::AngleAxisd(angle, axis_W) * gravity_W);
      object.Step();
    }
    if (object.IsFree()) break;
    ++num_survived;
  }
  return {"graspa", num_survived == 4, static_cast<double>(num_survived)};
}

Verdict JudgeMultiGripperGrasp(const HeldObject& held) {
  constexpr double kGravity = 9.81, kDuration = 6.0, kDistance = 0.3;
  double shortest = kDuration;
  for (const Vector3d& axis_W : ListAxes(held)) {
    shortest =
        std::min(shortest, FindFallTime(held, kGravity * axis_W, kDistance, 2.0 * kPi, kDuration));
  }
  return {"multigrippergrasp", shortest == kDuration, shortest};
}

Verdict JudgeNistPull(const HeldObject& held) {
  const double force = FindBreakingForce(held, -Vector3d::UnitZ()).load;
  return {"nist_pull", force >= held.mass() * kStandardGravity, force};
}

}  // namespace

HeldObject::HeldObject(const World& world, const WorldCommand& command, const TrialSetup& setup,
                       const GripRegulator& grip, const std::optional<TouchSensors>& sensors)
    : world_(world),
      command_(command),
      grip_(grip),
      sensors_(sensors),
      hand_(setup.hand.get()),
      object_(setup.object.get()),
      step_(setup.sim.step),
      mass_(setup.object->mass_properties.mass),
      radius_(CalcObjectRadius(*setup.object)),
      R_WPalm_(CalcPalmPose(*hand_, world.state()).linear()),
      X_PalmStart_(CalcObjectInPalm()) {
  command_.num_steps = 1;  // loads grow in every step
}

Pose HeldObject::CalcObjectInPalm() const {
  const WorldState& state = world_->state();
  return CalcPalmPose(*hand_, state).inverse() * MakePose(state.R_WO, state.p_WOcm);
}

void HeldObject::Regulate() {
  world_->FindHandContacts(contacts_);
  if (sensors_) sensors_->Observe(sensors_->time() + step_, contacts_, world_->dynamics());
  grip_.Observe(Phase::kHold, *world_, command_, contacts_, sensors_ ? &*sensors_ : nullptr, step_);
  grip_.Advance(Phase::kHold, step_);
  grip_.Command(command_);
}

void HeldObject::Step() {
  const StepReport report = world_->Step(command_);
  time_ += step_;
  if (grip_.is_regulated()) Regulate();
  if (report.grip_force > 0.0) last_touch_ = time_;
  if (CalcSlipSpeed(world_->state(), radius_) > kRestSpeed) last_motion_ = time_;
  converged_ = converged_ && report.converged && report.is_finite;
}

double HeldObject::CalcMoved() const {
  return (CalcObjectInPalm().translation() - X_PalmStart_.translation()).norm();
}

double HeldObject::CalcSpeed() const {
  return (world_->state().v_WOcm - world_->state().v_WH).norm();
}

double HeldObject::CalcTurned() const {
  return Eigen::AngleAxisd(CalcObjectInPalm().linear() * X_PalmStart_.linear().transpose()).angle();
}

bool HeldObject::IsFree() const { return time_ - last_touch_ > kFreeTime; }

BreakingLoad FindBreakingForce(const HeldObject& held, const Vector3d& direction_W) {
  return FindBreakingLoad(held, direction_W, false);
}

double FindWeakestForce(const HeldObject& held) {
  double weakest = std::numeric_limits<double>::infinity();
  for (int axis = 2; axis >= 0; --axis) {  // grasps are weakest along the approach
    for (const double sign : {1.0, -1.0}) {
      const Vector3d direction_W = sign * held.R_WPalm().col(axis);
      weakest = std::min(weakest, FindBreakingLoad(held, direction_W, false, weakest).load);
    }
  }
  return weakest;
}

Judgement JudgeGrasp(const HeldObject& held, const std::vector<GraspContact>& contacts) {
  Judgement judgement;
  JudgeQuality(held, contacts, judgement);
  judgement.breaking_force = judgement.breaking_moment = std::numeric_limits<double>::infinity();
  for (const bool is_moment : {false, true}) {
    double& smallest = is_moment ? judgement.breaking_moment : judgement.breaking_force;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) {
        BreakingLoad load = FindBreakingLoad(held, sign * held.R_WPalm().col(axis), is_moment);
        load.direction =
            std::string(is_moment ? "moment " : "force ") + (sign > 0.0 ? "+" : "-") + "xyz"[axis];
        smallest = std::min(smallest, load.load);
        judgement.loads.push_back(load);
      }
    }
  }
  for (const VerdictRule& rule : ListVerdictRules()) judgement.verdicts.push_back(rule.judge(held));
  return judgement;
}

const std::vector<VerdictRule>& ListVerdictRules() {
  static const std::vector<VerdictRule> rules = {
      {"lift_off", "Lift-off", "1 or 0", "lifted, held and slower than 5 mm/s at the end",
       JudgeLiftOff},
      {"dexgraspbench", "DexGraspBench", "axes passed of 6",
       "10 m/s^2 times the mass along six axes, 2 s each: moved below 50 mm and 15 degrees",
       JudgeDexGraspBench},
      {"graspa", "GRASPA", "quarters survived of 4",
       "turned by a quarter, back, the other way and back, 1 s each: not dropped", JudgeGraspa},
      {"multigrippergrasp", "MultiGripperGrasp", "shortest time until it fell, at most 6 [s]",
       "9.81 m/s^2 along six axes, 6 s each: moved below 0.3 m", JudgeMultiGripperGrasp},
      {"nist_pull", "NIST pull", "force at slip [N]",
       "pulled straight down with growing force: resists one additional object weight",
       JudgeNistPull}};
  return rules;
}

Judgement MakeEmptyHandJudgement() {
  Judgement judgement;
  judgement.breaking_force = judgement.breaking_moment = 0.0;
  for (const VerdictRule& rule : ListVerdictRules()) {
    judgement.verdicts.push_back({rule.id, false, 0.0});
  }
  return judgement;
}

}  // namespace graspbench
