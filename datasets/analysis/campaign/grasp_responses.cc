#include "datasets/analysis/campaign/grasp_responses.h"

#include "core/base/units.h"
#include "core/trial/judge/disturbance.h"

namespace graspbench {
namespace {

using Record = const TrialRecord&;

double OfSuccess(Record record, double value) {
  return IsSuccess(record.result.outcome) ? value : kUnset;
}

double FindSuccess(Record record) {
  if (record.result.outcome == Outcome::kNumericalFailure) return kUnset;
  return IsSuccess(record.result.outcome) ? 1.0 : 0.0;
}

}  // namespace

const std::vector<GraspResponse>& ListGraspResponses() {
  static const std::vector<GraspResponse> responses = {
      {{"success", "success [%]", 100.0, 1}, FindSuccess},
      {{"shift_m", "push before lift-off [mm]", MmFromM(1.0), 2},
       [](Record record) { return CalcDisturbance(record.result).before_lift.shift; }},
      {{"turn_rad", "turn before lift-off [deg]", DegFromRad(1.0), 2},
       [](Record record) { return CalcDisturbance(record.result).before_lift.turn; }},
      {{"shift_in_hand_m", "in-hand displacement [mm]", MmFromM(1.0), 2},
       [](Record record) {
         return OfSuccess(record, CalcDisturbance(record.result).in_hand.shift);
       }},
      {{"turn_in_hand_rad", "turn in the hand [deg]", DegFromRad(1.0), 2},
       [](Record record) {
         return OfSuccess(record, CalcDisturbance(record.result).in_hand.turn);
       }},
      {{"hold_slip_m", "slip in the hold [mm]", MmFromM(1.0), 3},
       [](Record record) { return OfSuccess(record, record.result.hold_slip); }},
      {{"sigma_n", "sigma [N]", 1.0, 2},
       [](Record record) { return OfSuccess(record, record.result.stability.sigma); }},
      {{"breaking_force_n", "breaking force [N]", 1.0, 2},
       [](Record record) {
         return record.judgement ? OfSuccess(record, record.judgement->breaking_force) : kUnset;
       }},
  };
  return responses;
}

}  // namespace graspbench
