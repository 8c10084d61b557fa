#include "workbench/trace_session.h"

#include <gtest/gtest.h>

#include "core/trial/trial_runner.h"
#include "datasets/plan/session_inputs.h"
#include "datasets/records/compare_results.h"

namespace graspbench {
namespace {

TEST(TraceSession, EveryTrialIsThatOfTheSession) {
  Session session;
  session.config.hands = {"tum"};
  session.config.objects = {"golf_ball"};
  session.config.trials = 2;
  const SessionInputs inputs = LoadSessionInputs(session.config);
  session.plan = MakePlan(session.config, inputs);
  const TrialTracer trace = MakeTrialTracer(session);
  // Backwards: what was carried out before leaves nothing behind.
  for (auto planned = session.plan.rbegin(); planned != session.plan.rend(); ++planned) {
    const TrialSetup setup = MakeTrialSetup(session.config, inputs, *planned);
    const TrialResult result = TrialRunner(setup.hand, setup.object).Run(setup);
    const TracedTrial traced = trace(*planned);
    EXPECT_FALSE(FindFirstDifference(result, traced.result)) << planned->id;
    EXPECT_GT(traced.trace.size(), 100u);
  }
}

}  // namespace
}  // namespace graspbench
