#include "core/trial/trial_trace.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/trial/trial_setups.h"

namespace graspbench {
namespace {

TracedTrial Trace(const TrialSetup& setup, double interval) {
  TrialRunner runner(setup.hand, setup.object);
  return TraceTrial(runner, setup, interval);
}

TEST(TrialTrace, WatchingChangesNoByteOfTheResult) {
  for (const double mu : {0.5, 0.02}) {  // held, lost
    const TrialSetup setup = MakeSetup("tum", "g2", MakeCube(0.0122, mu));
    EXPECT_EQ(ToJson(Trace(setup, 0.0).result), ToJson(RunSetup(setup))) << mu;
  }
}

TEST(TrialTrace, EveryStepIsThereInItsOrder) {
  const TrialSetup setup = MakeSetup("tum", "g2", MakeCube(0.0122, 0.5));
  const TracedTrial traced = Trace(setup, 0.0);
  ASSERT_EQ(traced.trace.size(), static_cast<size_t>(traced.result.num_steps) + 1);
  EXPECT_EQ(traced.trace.front().time, 0.0);
  EXPECT_EQ(traced.trace.back().time, traced.result.simulated_time);
  EXPECT_EQ(traced.trace.back().phase, Phase::kHold);
  double largest_grip = 0.0;
  for (size_t i = 1; i < traced.trace.size(); ++i) {
    const TraceInstant& instant = traced.trace[i];
    const double length = (instant.time - traced.trace[i - 1].time) / setup.sim.step;
    EXPECT_NEAR(length, length > 2.0 ? setup.sim.steady_step_factor : 1.0, 1e-9);
    EXPECT_GE(instant.phase, traced.trace[i - 1].phase);
    // The grip is what its contacts add up to.
    double sum = 0.0;
    for (const HandContact& contact : instant.contacts) sum += contact.normal_force;
    EXPECT_NEAR(sum, instant.grip_force, 1e-9 * (1.0 + sum));
    largest_grip = std::max(largest_grip, sum);
  }
  EXPECT_GT(largest_grip, 0.1);
  // At rest on the table it carries the cube's weight.
  EXPECT_NEAR(FindInstant(traced.trace, 0.1).table_force, 0.0122 * kStandardGravity, 1e-3);
  // The snapshots of the record are instants of the trace.
  for (const SceneSnapshot& snapshot : traced.result.snapshots) {
    const TraceInstant& instant = FindInstant(traced.trace, snapshot.time);
    EXPECT_NEAR(instant.time, snapshot.time, 1e-12);
    EXPECT_EQ(instant.q, snapshot.q);
    EXPECT_EQ(instant.X_WO.matrix(), snapshot.X_WO.matrix());
  }
}

TEST(TrialTrace, ACoarseOneHoldsWholeStepsAndTheEndsOfPhases) {
  const TrialSetup setup = MakeSetup("tum", "g2", MakeCube(0.0122, 0.5));
  const TracedTrial fine = Trace(setup, 0.0), coarse = Trace(setup, 2.5 * setup.sim.step);
  EXPECT_EQ(coarse.closure_start, fine.closure_start);
  std::vector<double> wanted;
  long next = 0;
  for (size_t i = 0; i < fine.trace.size(); ++i) {
    const bool is_end =
        i + 1 == fine.trace.size() || fine.trace[i + 1].phase != fine.trace[i].phase;
    const long step = std::lround(fine.trace[i].time / setup.sim.step);
    if (step >= next || is_end) wanted.push_back(fine.trace[i].time);
    if (step >= next) next = (step / 3 + 1) * 3;
  }
  ASSERT_EQ(coarse.trace.size(), wanted.size());
  for (size_t i = 0; i < wanted.size(); ++i) EXPECT_EQ(coarse.trace[i].time, wanted[i]);
  EXPECT_EQ(&FindInstant(coarse.trace, -1.0), &coarse.trace.front());
  EXPECT_EQ(&FindInstant(coarse.trace, 1e9), &coarse.trace.back());
}

// The record says when each phase began, and keeps the posture at two of these times.
TEST(TrialTrace, PhasesEndWhereTheRecordSaysThatTheNextOneBegins) {
  const TrialSetup setup = MakeSetup("tum", "g2", MakeCube(0.0122, 0.5));
  const TracedTrial traced = Trace(setup, 0.02);
  const std::vector<const TraceInstant*> ends = ListPhaseEnds(traced.trace);
  const std::vector<PhaseStart>& phases = traced.result.phases;  // after placing, with "done"
  ASSERT_EQ(ends.size(), 5u);
  ASSERT_EQ(phases.size(), 5u);
  for (size_t i = 0; i < ends.size(); ++i) {
    EXPECT_NEAR(ends[i]->time, phases[i].time + traced.closure_start, 1e-12) << phases[i].name;
    const bool is_last = i + 1 == ends.size();
    EXPECT_EQ(NameOf(ends[i]->next_phase), is_last ? "hold" : phases[i].name);
  }
  const SceneSnapshot& closed = traced.result.snapshots.at(1);
  EXPECT_EQ(closed.moment, Moment::kClosed);
  EXPECT_EQ(ends[2]->phase, Phase::kStabilisation);
  EXPECT_EQ(ends[2]->q, closed.q);
  EXPECT_EQ(ends[2]->X_WO.matrix(), closed.X_WO.matrix());
}

}  // namespace
}  // namespace graspbench
