#include "core/grasp/strategy.h"

#include <algorithm>
#include <cmath>

#include "core/base/minimum_jerk.h"

namespace graspbench {
namespace {

/** The grip is steady when its force has stayed within this share for this time [s]. */
constexpr double kSteadyShare = 0.02;
constexpr double kSteadyTime = 0.1;

}  // namespace

GraspStrategy::GraspStrategy(const StrategyConfig& config, double distance)
    : config_(config), distance_(distance), slowest_closure_(config.closure_time) {}

void GraspStrategy::Enter(Phase phase) {
  phase_ = phase;
  time_in_phase_ = 0.0;
  closed_since_ = 0.0;
  settled_since_ = 0.0;
  settled_force_ = 0.0;
}

void GraspStrategy::StartPlacing(double time_before_arrival) {
  Enter(Phase::kPlacing);
  time_in_phase_ = config_.placing_time - time_before_arrival;
}

double GraspStrategy::CalcPlacingDistance(double time_before_arrival) const {
  const double x = std::clamp(1.0 - time_before_arrival / config_.placing_time, 0.0, 1.0);
  return distance_ * (1.0 - CalcMinimumJerk(x));
}

/** With a regulated grip: the force is in its band; otherwise it has stopped changing. */
bool GraspStrategy::IsSteady(const StrategyObservation& observation) {
  if (observation.is_regulated) return observation.is_in_band;
  if (closing_ < 1.0 ||
      std::abs(observation.grip_force - settled_force_) > kSteadyShare * settled_force_) {
    settled_since_ = time_in_phase_;
    settled_force_ = observation.grip_force;
  }
  return time_in_phase_ - settled_since_ >= kSteadyTime;
}

StrategyCommand GraspStrategy::Step(double step, const StrategyObservation& observation) {
  StrategyCommand command;
  time_in_phase_ += step;

  switch (phase_) {
    case Phase::kPreGrasp:
      command.distance = distance_;
      break;
    case Phase::kPlacing: {
      const double x = std::clamp(time_in_phase_ / config_.placing_time, 0.0, 1.0);
      command.distance = distance_ * (1.0 - CalcMinimumJerk(x));
      command.speed = -distance_ * CalcMinimumJerkRate(x) / config_.placing_time;
      if (time_in_phase_ >= config_.placing_time - config_.closure_lead) Enter(Phase::kClosure);
      break;
    }
    case Phase::kClosure:
      if (time_in_phase_ < config_.closure_lead) {
        const double before_arrival = config_.closure_lead - time_in_phase_;
        command.distance = CalcPlacingDistance(before_arrival);
        command.speed = -distance_ *
                        CalcMinimumJerkRate(1.0 - before_arrival / config_.placing_time) /
                        config_.placing_time;
      }
      closing_ = std::min(1.0, closing_ + step / config_.closure_time);
      if (time_in_phase_ >= config_.closure_lead &&
          (observation.all_digits_touched || observation.lifts.value_or(false) ||
           time_in_phase_ >= slowest_closure_ + config_.closure_patience)) {
        Enter(Phase::kStabilisation);
      }
      break;
    case Phase::kStabilisation:
      closing_ = std::min(1.0, closing_ + step / config_.closure_time);
      if (observation.is_closing) closed_since_ = time_in_phase_;
      if (observation.lifts) {
        if (*observation.lifts) Enter(Phase::kLiftOff);
      } else if ((IsSteady(observation) && time_in_phase_ >= config_.stabilisation_min_time) ||
                 time_in_phase_ - closed_since_ >= config_.stabilisation_max_time) {
        Enter(Phase::kLiftOff);
      }
      break;
    case Phase::kLiftOff: {
      const double x = std::clamp(time_in_phase_ / config_.lift_time, 0.0, 1.0);
      command.distance = distance_ * CalcMinimumJerk(x);
      command.speed = distance_ * CalcMinimumJerkRate(x) / config_.lift_time;
      if (time_in_phase_ >= config_.lift_time) Enter(Phase::kHold);
      break;
    }
    case Phase::kHold:
      command.distance = distance_;
      if (time_in_phase_ >= config_.hold_time) Enter(Phase::kDone);
      break;
    case Phase::kDone:
      command.distance = distance_;
      break;
  }
  command.closing = closing_;
  return command;
}

}  // namespace graspbench
