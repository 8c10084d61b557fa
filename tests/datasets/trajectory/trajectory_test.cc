#include "datasets/trajectory/trajectory.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/sha256.h"
#include "datasets/records/trial_record.h"
#include "tests/datasets/session/fake_session.h"

namespace graspbench {
namespace {

const PlannedTrial kPlanned = {"0123456789abcdef", "tum", "mug", "g2", 1};

/** Steps of 2 ms for one second; closure begins at 0.301 s, between two instants at 60 Hz. */
TracedTrial MakeTraced() {
  TracedTrial traced;
  for (int step = 0; step <= 500; ++step) {
    TraceInstant instant;
    instant.time = 0.002 * step;
    instant.phase = step <= 151 ? Phase::kPlacing : Phase::kClosure;
    instant.next_phase = step < 151 ? Phase::kPlacing : Phase::kClosure;
    traced.trace.push_back(instant);
  }
  traced.closure_start = 0.302;
  traced.result.phases = {{"closure", 0.0}};
  traced.result.contact_events = {{0.1, ContactEventKind::kTouch, "F1", "link", kUnset},
                                  {0.2, ContactEventKind::kLost, "F1", "link", 0.5}};
  return traced;
}

TEST(Trajectory, KeepsTheFirstStepOfEachIntervalAndTheEndsOfPhases) {
  const TrialTrajectory trajectory = MakeTrajectory(kPlanned, {}, MakeTraced(), 60.0);
  const std::vector<TraceInstant>& kept = trajectory.traced.trace;
  // 0, 1/60 .. 60/60 s are 61 instants; 1 s is a step itself. One more ends the phase.
  ASSERT_EQ(kept.size(), 62u);
  EXPECT_DOUBLE_EQ(kept[1].time, 0.018);  // 16.7 ms
  EXPECT_DOUBLE_EQ(kept[2].time, 0.034);  // 33.3 ms
  EXPECT_DOUBLE_EQ(kept[3].time, 0.050);  // exactly
  EXPECT_DOUBLE_EQ(kept.back().time, 1.0);
  int num_ends = 0;
  for (const TraceInstant& instant : kept) {
    if (instant.next_phase == instant.phase) continue;
    EXPECT_DOUBLE_EQ(instant.time, 0.302);
    ++num_ends;
  }
  EXPECT_EQ(num_ends, 1);
}

TEST(Trajectory, EveryStepAtTheRateOfTheSteps) {
  EXPECT_EQ(MakeTrajectory(kPlanned, {}, MakeTraced(), 500.0).traced.trace.size(), 501u);
  EXPECT_EQ(MakeTrajectory(kPlanned, {}, MakeTraced(), 1000.0).traced.trace.size(), 501u);
}

TEST(Trajectory, EventsCountFromTheStartOfPlacing) {
  const auto events = ListTrajectoryEvents(MakeTrajectory(kPlanned, {}, MakeTraced(), 60.0));
  ASSERT_EQ(events.size(), 4u);
  EXPECT_EQ(events[0].phase, "placing");
  EXPECT_EQ(events[1].phase, "closure");
  EXPECT_DOUBLE_EQ(events[1].time, 0.302);
  EXPECT_EQ(events[2].kind, "touch");
  EXPECT_DOUBLE_EQ(events[2].time, 0.402);
  EXPECT_EQ(events[3].kind, "lost");
  EXPECT_EQ(events[3].impulse, 0.5);
}

TEST(Trajectory, NamesTheRecordByItsLineWithoutTheChecksum) {
  const TrialRecord record = MakeFakeRecord(kPlanned);
  std::string line = FormatJournalLine(record);
  line = line.substr(0, line.rfind(",\"xxh64\"")) + "}";
  EXPECT_EQ(CalcRecordSha256(kPlanned, record.result), CalcSha256(line));
}

TEST(Trajectory, OfATrialThatCouldNotBeginThereIsNone) {
  EXPECT_THROW(MakeTrajectory(kPlanned, {}, {}, 60.0), Error);
}

}  // namespace
}  // namespace graspbench
