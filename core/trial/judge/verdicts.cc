#include "core/trial/judge/verdicts.h"

#include <algorithm>

#include "core/trial/judge/judge.h"
#include "core/trial/protocols/table_lift_outcome.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

/** Six half axes of the palm in W. */
std::vector<Vector3d> ListAxes(const HeldObject& held) {
  std::vector<Vector3d> axes;
  for (int axis = 0; axis < 3; ++axis) {
    axes.push_back(held.R_WPalm().col(axis));
    axes.push_back(-held.R_WPalm().col(axis));
  }
  return axes;
}

/** Time until it has moved or turned by that much; `duration` if it never does. */
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
