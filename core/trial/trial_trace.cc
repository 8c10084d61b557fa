#include "core/trial/trial_trace.h"

#include <algorithm>
#include <cmath>

#include "core/trial/protocols/protocol.h"

namespace graspbench {

TraceInstant MakeTraceInstant(const World& world, double time, Phase phase,
                              const StepReport& report, const WorldCommand& command) {
  TraceInstant instant;
  instant.time = time;
  instant.phase = instant.next_phase = phase;
  instant.X_WH = world.state().X_WH;
  instant.X_WO = world.CalcObjectPose();
  instant.q = world.state().q;
  instant.q_asked = command.q;
  instant.q_arm = world.state().q_arm;
  world.FindHandContacts(instant.contacts);
  instant.grip_force = report.grip_force;
  instant.table_force = report.table_force;
  return instant;
}

TracedTrial TraceTrial(TrialRunner& runner, const TrialSetup& setup, double interval) {
  const double num_steps = std::ceil(interval / setup.sim.step - 1e-9);
  const long every = std::max(1L, std::lround(num_steps));
  TracedTrial traced;
  traced.arm = setup.arm;
  TraceInstant latest;
  long next_kept = 0;
  bool is_kept = true;
  const auto keep_latest = [&] {
    if (!is_kept) traced.trace.push_back(latest);
    is_kept = true;
  };
  traced.result = runner.Run(setup, [&](TrialCourse& course) {
    const long step = std::lround(course.time() / setup.sim.step);
    if (step > 0 && course.phase() != latest.phase) {
      keep_latest();
      traced.trace.back().next_phase = course.phase();
    }
    latest = MakeTraceInstant(course.world(), course.time(), course.phase(), course.report(),
                              course.last_command());
    traced.closure_start = course.closure_start();
    is_kept = false;
    if (step < next_kept) return;
    keep_latest();
    next_kept = (step / every + 1) * every;
  });
  keep_latest();
  return traced;
}

std::vector<const TraceInstant*> ListPhaseEnds(const std::vector<TraceInstant>& trace) {
  std::vector<const TraceInstant*> ends;
  for (const TraceInstant& instant : trace) {
    if (ends.empty() || ends.back()->phase != instant.phase) ends.push_back(nullptr);
    ends.back() = &instant;
  }
  return ends;
}

const TraceInstant& FindInstant(const std::vector<TraceInstant>& trace, double time) {
  return *std::min_element(trace.begin(), trace.end(),
                           [time](const TraceInstant& a, const TraceInstant& b) {
                             return std::abs(a.time - time) < std::abs(b.time - time);
                           });
}

}  // namespace graspbench
