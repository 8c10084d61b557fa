#include "datasets/trajectory/trajectory.h"

#include <algorithm>

#include "core/base/error.h"
#include "core/base/sha256.h"
#include "datasets/records/trial_record.h"

namespace graspbench {

std::string CalcRecordSha256(const PlannedTrial& planned, const TrialResult& result) {
  return CalcSha256(FormatJson(ToJson(TrialRecord{planned, result})));
}

TrialTrajectory MakeTrajectory(const PlannedTrial& planned, const TrialSetup& setup,
                               const TracedTrial& traced, double rate) {
  if (traced.trace.empty()) {
    throw Error(ErrorKind::kUnsupported, "trial " + planned.id + " (" + DescribeTrial(planned) +
                                             ") has no course: it could not begin; " +
                                             traced.result.reason);
  }
  TrialTrajectory trajectory = {
      planned, CalcRecordSha256(planned, traced.result), setup.hand, setup.object, rate, {}};
  trajectory.traced.result = traced.result;
  trajectory.traced.closure_start = traced.closure_start;
  std::vector<TraceInstant>& kept = trajectory.traced.trace;
  int num_regular = 0;
  for (const TraceInstant& instant : traced.trace) {
    const bool is_due =
        instant.time - traced.trace.front().time >= num_regular / rate - 1e-9;  // of rounding
    num_regular += is_due;
    const bool ends_phase = instant.next_phase != instant.phase;
    if (is_due || ends_phase || &instant == &traced.trace.back()) kept.push_back(instant);
  }
  return trajectory;
}

std::vector<TrajectoryEvent> ListTrajectoryEvents(const TrialTrajectory& trajectory) {
  const TracedTrial& traced = trajectory.traced;
  std::vector<TrajectoryEvent> events = {{0.0, "phase", NameOf(Phase::kPlacing), "", "", kUnset}};
  for (const PhaseStart& phase : traced.result.phases) {
    events.push_back({phase.time + traced.closure_start, "phase", phase.name, "", "", kUnset});
  }
  for (const ContactEvent& event : traced.result.contact_events) {
    events.push_back({event.time + traced.closure_start, NameOf(event.kind), "", event.digit,
                      event.link, event.impulse});
  }
  std::stable_sort(
      events.begin(), events.end(),
      [](const TrajectoryEvent& a, const TrajectoryEvent& b) { return a.time < b.time; });
  return events;
}

}  // namespace graspbench
