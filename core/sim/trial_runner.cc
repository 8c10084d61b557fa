#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/hand/coupling.h"
#include "core/sim/simbody_model.h"
#include "core/sim/trial.h"
#include "core/sim/world.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

// The verdict; proposed by graspbench (method: the object has left the table, stays in the hand, is
// slower than 5 mm/s relative to the palm at the end).
constexpr double kLiftedShare = 0.5;    ///< of the lift height
constexpr double kSteadySpeed = 0.005;  ///< [m/s]
constexpr double kPushedAway = 0.05;    ///< horizontal displacement of a free object [m]
constexpr double kTippedShare = 0.1;    ///< change of the height of an object that lies anew

/** The simulation starts this long before the hand could first touch anything [s]. */
constexpr double kLeadTime = 0.06;
constexpr double kSafeGap = 0.004;  ///< [m]
/** A trial is given up after this long without the solver converging [s]. */
constexpr double kMaxUnconvergedTime = 0.1;
/** The object counts as lost when the hand has not touched it for this long [s]. */
constexpr double kLostTime = 0.15;
/** Largest relative difference from Simbody's mass matrix and bias. */
constexpr double kSimbodyTolerance = 1e-9;

std::string Format(const char* format, double a, double b = 0.0) {
  char text[160];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

}  // namespace

struct TrialRunner::Impl {
  std::shared_ptr<const Hand> hand;
  std::shared_ptr<const GraspObject> object;
  SimbodyModel simbody;
  std::unique_ptr<World> world;  // for `sim`
  SimConfig sim;

  Impl(std::shared_ptr<const Hand> the_hand, std::shared_ptr<const GraspObject> the_object)
      : hand(std::move(the_hand)),
        object(std::move(the_object)),
        simbody(*hand, object->mass_properties) {}

  World& FindWorld(const SimConfig& config);
  double CalcSimbodyDifference();
};

namespace {

bool IsSame(const SimConfig& a, const SimConfig& b) {
  bool same = true;
  std::vector<double> values;
  SimConfig copy_a = a, copy_b = b;
  copy_a.Visit([&](const char*, double& value) { values.push_back(value); });
  size_t i = 0;
  copy_b.Visit([&](const char*, double& value) { same = same && value == values[i++]; });
  return same;
}

/** One trial in progress. */
class Trial {
 public:
  Trial(World& world, const TrialSetup& setup)
      : world_(world),
        setup_(setup),
        hand_(*setup.hand),
        placement_(CalcPlacement(hand_, setup.grasp, setup.object->size,
                                 setup.object->mass_properties.p_OOcm)),
        strategy_(setup.strategy, setup.grasp.approach_distance) {
    for (const std::string& id : setup.grasp.digits) {
      for (size_t d = 0; d < hand_.digits.size(); ++d) {
        if (hand_.digits[d].id != id) continue;
        digits_.push_back(static_cast<int>(d));
        const bool opposes = static_cast<int>(d) == FindOpposingDigit(hand_, setup.grasp);
        result_.contacts.push_back({id, opposes, kMissing});
      }
    }
  }

  TrialResult Run();

 private:
  void Start();
  WorldCommand MakeCommand(const StrategyCommand& command) const;
  void Observe(const StepReport& report);
  void EnterPhase(Phase phase);
  /** An outcome as soon as nothing that follows can change it. */
  std::optional<Outcome> FindEarlyOutcome();
  Outcome FindFinalOutcome();
  Outcome Fail(Outcome outcome, const std::string& reason) {
    result_.reason = reason;
    return outcome;
  }
  void TakeSnapshot(const char* name);
  double CalcExtent() const;  ///< height of the object from its lowest to its highest point [m]
  double CalcDisplacement() const;
  double CalcRise() const { return world_.CalcObjectPose().translation().z() - rest_height_; }
  Vector3d CalcObjectInHand() const {
    return world_.state().X_WH.inverse() * world_.state().p_WOcm;
  }
  int CountTouchingDigits() const;

  World& world_;
  const TrialSetup& setup_;
  const Hand& hand_;
  Placement placement_;
  GraspStrategy strategy_;
  TrialResult result_;
  std::vector<int> digits_;  // grasping digits, indices into hand_.digits

  StepReport report_;
  double time_ = 0.0;
  double closure_start_ = kMissing;
  double last_touch_ = 0.0;
  double unconverged_time_ = 0.0;
  double rest_height_ = 0.0;
  double rest_extent_ = 0.0;
  Vector3d rest_position_ = Vector3d::Zero();
  Vector3d held_at_ = Vector3d::Zero();  // object in H at the start of the hold
};

void Trial::Start() {
  WorldState state;
  state.q = setup_.grasp.q_pre + setup_.draw.joint_error;
  for (size_t j = 0; j < hand_.joints.size(); ++j) {
    const auto joint = static_cast<Eigen::Index>(j);
    state.q[joint] = std::clamp(state.q[joint], hand_.joints[j].lower, hand_.joints[j].upper);
  }
  ApplyCoupling(hand_, state.q);
  state.u = VectorXd::Zero(world_.dynamics().num_dofs());

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

WorldCommand Trial::MakeCommand(const StrategyCommand& command) const {
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

int Trial::CountTouchingDigits() const {
  int count = 0;
  for (int digit : digits_) {
    for (int link : hand_.digits[digit].links) {
      if (report_.link_touches_object[link]) {
        ++count;
        break;
      }
    }
  }
  return count;
}

void Trial::Observe(const StepReport& report) {
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
  for (size_t d = 0; d < digits_.size(); ++d) {
    if (!std::isnan(result_.contacts[d].time)) continue;
    for (int link : hand_.digits[digits_[d]].links) {
      if (report.link_touches_object[link]) result_.contacts[d].time = time_;
    }
  }
}

void Trial::EnterPhase(Phase phase) {
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
      held_at_ = CalcObjectInHand();
      break;
    case Phase::kPreGrasp:
    case Phase::kPlacing:
    case Phase::kStabilisation:
    case Phase::kDone:
      break;
  }
}

void Trial::TakeSnapshot(const char* name) {
  SceneSnapshot snapshot;
  snapshot.name = name;
  snapshot.time = time_;
  snapshot.X_WH = world_.state().X_WH;
  snapshot.X_WO = world_.CalcObjectPose();
  snapshot.q = world_.state().q;
  result_.snapshots.push_back(snapshot);
}

double Trial::CalcExtent() const {
  const Pose X_WO = world_.CalcObjectPose();
  Pose upside_down = Pose::Identity();
  upside_down.rotate(Eigen::AngleAxisd(kPi, Vector3d::UnitX()));
  return -world_.collider().CalcLowestPoint(upside_down * X_WO) -
         world_.collider().CalcLowestPoint(X_WO);
}

double Trial::CalcDisplacement() const {
  return (world_.state().p_WOcm - rest_position_).head<2>().norm();
}

std::optional<Outcome> Trial::FindEarlyOutcome() {
  if (!report_.is_finite) {
    return Fail(Outcome::kNumericalFailure,
                Format("positions or speeds became infinite %.3f s into the trial", time_));
  }
  if (unconverged_time_ > kMaxUnconvergedTime) {
    return Fail(Outcome::kNumericalFailure,
                Format("the solver did not converge for %.2f s, up to %.3f s into the trial",
                       unconverged_time_, time_));
  }
  const bool is_free = time_ - last_touch_ > kLostTime;
  const bool is_lost = is_free && report_.table_force > 0.0;
  switch (strategy_.phase()) {
    case Phase::kPlacing:
    case Phase::kClosure:
    case Phase::kStabilisation:
      if (is_free && CalcDisplacement() > kPushedAway) {
        return Fail(Outcome::kPushedAway,
                    Format("the object was pushed %.0f mm aside before it was held",
                           MmFromM(CalcDisplacement())));
      }
      break;
    case Phase::kLiftOff:
      if (strategy_.time_in_phase() > 0.5 * setup_.strategy.lift_time && is_lost) {
        return FindFinalOutcome();
      }
      break;
    case Phase::kHold:
      if (is_free) return FindFinalOutcome();
      break;
    case Phase::kPreGrasp:
    case Phase::kDone:
      break;
  }
  return std::nullopt;
}

Outcome Trial::FindFinalOutcome() {
  const double lift = setup_.grasp.approach_distance;
  const bool was_lifted = strategy_.phase() == Phase::kHold || strategy_.phase() == Phase::kDone;
  const bool is_held =
      report_.grip_force > 0.0 && report_.table_force == 0.0 && CalcRise() > kLiftedShare * lift;
  const Vector3d slip = was_lifted ? Vector3d(CalcObjectInHand() - held_at_) : Vector3d::Zero();
  const Vector3d relative_velocity = world_.state().v_WOcm - world_.state().v_WH;
  result_.hold_slip = was_lifted ? slip.norm() : kMissing;
  result_.end_speed = relative_velocity.norm();

  if (strategy_.phase() == Phase::kDone && is_held && result_.end_speed <= kSteadySpeed) {
    return Outcome::kSuccess;
  }
  int num_touched = 0;
  std::string untouched;
  for (const DigitContact& contact : result_.contacts) {
    if (!std::isnan(contact.time)) {
      ++num_touched;
    } else {
      untouched += (untouched.empty() ? "" : ", ") + contact.digit;
    }
  }
  if (is_held) {
    return Fail(Outcome::kDroppedWhileHolding,
                Format("still moving in the hand at %.1f mm/s at the end of the hold",
                       MmFromM(result_.end_speed)));
  }
  if (was_lifted && CalcRise() < kLiftedShare * lift && held_at_.allFinite() &&
      last_touch_ > time_ - strategy_.time_in_phase()) {
    return Fail(Outcome::kDroppedWhileHolding,
                Format("fell out of the hand %.2f s into the hold", strategy_.time_in_phase()));
  }
  if (std::abs(CalcExtent() - rest_extent_) > kTippedShare * rest_extent_)
    return Fail(Outcome::kKnockedOver, "the object tipped over and stayed behind");
  if (num_touched < 2) {
    return Fail(Outcome::kNoContact, "never touched by " + untouched);
  }
  if (CalcDisplacement() > kPushedAway) {
    return Fail(Outcome::kPushedAway,
                Format("the object was pushed %.0f mm aside and stayed behind",
                       MmFromM(CalcDisplacement())));
  }
  if (!untouched.empty()) return Fail(Outcome::kNoContact, "never touched by " + untouched);
  if (result_.grip_force == 0.0) {
    return Fail(Outcome::kLostWhileClosing, "all digits had touched, but none did before lift-off");
  }
  return Fail(Outcome::kSlippedInLiftOff,
              Format("gripped with %.2f N in all, but it stayed behind", result_.grip_force));
}

TrialResult Trial::Run() {
  Start();
  Phase phase = strategy_.phase();
  std::optional<Outcome> outcome;
  while (strategy_.phase() != Phase::kDone && !outcome) {
    StrategyObservation observation;
    observation.grip_force = report_.grip_force;
    observation.all_digits_touched =
        std::all_of(result_.contacts.begin(), result_.contacts.end(),
                    [](const DigitContact& contact) { return !std::isnan(contact.time); });
    const StrategyCommand command = strategy_.Step(setup_.sim.step, observation);
    if (strategy_.phase() != phase) {
      phase = strategy_.phase();
      EnterPhase(phase);
      if (phase == Phase::kLiftOff && CountTouchingDigits() == 0 && report_.grip_force == 0.0) {
        outcome = FindFinalOutcome();
        break;
      }
      if (phase == Phase::kDone) break;
    }
    Observe(world_.Step(MakeCommand(command)));
    outcome = FindEarlyOutcome();
  }
  result_.outcome = outcome ? *outcome : FindFinalOutcome();
  TakeSnapshot("lifted");
  result_.lift_height = CalcRise();
  result_.simulated_time = time_;
  result_.energy_residual = world_.CalcEnergyResidual();
  for (DigitContact& contact : result_.contacts) contact.time -= closure_start_;
  result_.timing = CalcContactTiming(result_.contacts, 0.0);
  return result_;
}

}  // namespace

World& TrialRunner::Impl::FindWorld(const SimConfig& config) {
  if (!world || !IsSame(config, sim)) {
    sim = config;
    world = std::make_unique<World>(*hand, *object, config);
  }
  return *world;
}

/** Largest difference of our mass matrix and bias from Simbody's at the world's state, relative to
the largest entry. */
double TrialRunner::Impl::CalcSimbodyDifference() {
  HandDynamics& dynamics = world->dynamics();
  const WorldState& state = world->state();
  const int joints = dynamics.num_joints(), dofs = dynamics.num_dofs();
  Eigen::MatrixXd T = Eigen::MatrixXd::Zero(joints, dofs);  // u_joint = T u_dof
  for (int j = 0; j < joints; ++j) T(j, dynamics.dof_of_joint(j)) = dynamics.rate_of_joint(j);

  VectorXd u(joints + 6);
  u << T * state.u, state.w_WO, state.v_WOcm;
  simbody.SetPositions(state.X_WH, state.q, MakePose(state.R_WO, state.p_WOcm));
  simbody.SetSpeeds(state.v_WH, u);
  const Eigen::MatrixXd M_theirs =
      T.transpose() * simbody.CalcMassMatrix().topLeftCorner(joints, joints) * T;
  const VectorXd bias_theirs = T.transpose() * simbody.CalcBias(state.gravity_W).head(joints);

  dynamics.UpdatePositions(state.X_WH, state.q);
  Eigen::MatrixXd M(dofs, dofs);
  dynamics.CalcMassMatrix(M);
  VectorXd bias(dofs);
  dynamics.CalcBias(state.u, state.v_WH, -state.gravity_W, bias);
  return std::max((M - M_theirs).cwiseAbs().maxCoeff() / M_theirs.cwiseAbs().maxCoeff(),
                  (bias - bias_theirs).cwiseAbs().maxCoeff() / bias_theirs.cwiseAbs().maxCoeff());
}

TrialRunner::TrialRunner(std::shared_ptr<const Hand> hand,
                         std::shared_ptr<const GraspObject> object)
    : impl_(std::make_unique<Impl>(std::move(hand), std::move(object))) {
  const HandDynamics dynamics(*impl_->hand);
  for (size_t link = 0; link < impl_->hand->links.size(); ++link) {
    const size_t length = dynamics.chain(static_cast<int>(link)).size();
    if (length > ContactPoint::kMaxChain) {
      throw Error(ErrorKind::kUnsupported,
                  "hand \"" + impl_->hand->id + "\" has " + std::to_string(length) +
                      " joints between its root and link \"" + impl_->hand->links[link].name +
                      "\"; the simulation takes at most " +
                      std::to_string(ContactPoint::kMaxChain));
    }
  }
}

TrialRunner::~TrialRunner() = default;

TrialResult TrialRunner::Run(const TrialSetup& setup) {
  GRASPBENCH_DEMAND(setup.hand == impl_->hand && setup.object == impl_->object,
                    "a runner serves one hand and one object");
  TrialResult result;
  try {
    World& world = impl_->FindWorld(setup.sim);
    result = Trial(world, setup).Run();
    if (result.outcome == Outcome::kNumericalFailure) return result;
    if (const double difference = impl_->CalcSimbodyDifference();
        !(difference < kSimbodyTolerance)) {
      result.outcome = Outcome::kNumericalFailure;
      result.reason = Format("mass matrix or bias differs from Simbody's by %.1e", difference);
    }
  } catch (const std::exception& e) {
    // Simbody reports impossible states this way.
    result = TrialResult();
    result.outcome = Outcome::kNumericalFailure;
    result.reason = e.what();
  }
  return result;
}

}  // namespace graspbench
