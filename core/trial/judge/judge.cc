#include "core/trial/judge/judge.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "core/quality/grasp_quality.h"
#include "core/trial/judge/verdicts.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kGrowthTime = 0.3;                ///< tau [s]
constexpr double kMostLoad = 100.0;                ///< [N]
constexpr double kBrokenDistance = 0.02;           ///< [m]
constexpr double kBrokenAngle = RadFromDeg(30.0);  ///< [rad]
/** Above this, cones get 4 edges instead of 8: a hull in six dimensions grows fast. */
constexpr size_t kMostFineContacts = 8;
constexpr double kWindow = 0.02;  ///< [s]

double CalcMomentum(const HeldObject& object, const Vector3d& direction_W, bool is_moment) {
  const WorldState& state = object.world().state();
  if (!is_moment) return object.mass() * direction_W.dot(state.v_WOcm);
  return direction_W.dot(state.R_WO * (object.world().mass_properties().I_OOcm *
                                       (state.R_WO.transpose() * state.w_WO)));
}

/** @param enough  the pull ends unbroken when the hand has balanced so much. */
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
  for (double level = 0.0; level < kMostLoad;) {
    level = std::min(kMostLoad, weight * std::expm1((object.time() + held.step()) / kGrowthTime));
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
  if (!result.is_broken) result.load = kMostLoad * arm;
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

}  // namespace

BreakingLoad FindBreakingForce(const HeldObject& held, const Vector3d& direction_W) {
  return FindBreakingLoad(held, direction_W, false);
}

double FindWeakestForce(const HeldObject& held) {
  double weakest = std::numeric_limits<double>::infinity();
  for (int axis = 2; axis >= 0; --axis) {  // along the approach grasps are weak
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

}  // namespace graspbench
