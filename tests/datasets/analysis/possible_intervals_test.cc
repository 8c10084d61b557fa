// Every interval that a table prints lies within what its number can be, whatever comes in: all
// succeed, none, one object, all alike, one that differs.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "datasets/analysis/conditions/delay_summary.h"
#include "datasets/analysis/conditions/sensitivity_summary.h"
#include "datasets/analysis/conditions/sweep_summary.h"
#include "datasets/analysis/controller_comparison.h"
#include "datasets/analysis/map/map_result.h"
#include "datasets/analysis/session_comparison.h"
#include "datasets/analysis/session_summary.h"
#include "tests/datasets/analysis/made_results.h"

namespace graspbench {
namespace {

/** Who succeeds before and after a change. */
struct Extreme {
  const char* name;
  std::function<bool(int object, int trial)> before, after;
};

std::vector<Extreme> ListExtremes() {
  const auto all = [](int, int) { return true; };
  const auto none = [](int, int) { return false; };
  return {{"all", all, all},
          {"none", none, none},
          {"all lost", all, none},
          {"all won", none, all},
          {"one object lost", all, [](int object, int) { return object > 0; }},
          {"one object won", none, [](int object, int) { return object == 0; }},
          {"one trial lost", all, [](int object, int trial) { return object + trial > 0; }},
          {"ties", [](int, int trial) { return trial % 2 == 0; },
           [](int, int trial) { return trial % 2 == 1; }}};
}

/** NaN: there is no interval. */
void ExpectWithin(double low, double estimate, double high, double least, double most) {
  if (std::isnan(low) && std::isnan(high)) return;
  EXPECT_GE(low, least - 1e-12);
  EXPECT_LE(high, most + 1e-12);
  EXPECT_LE(low, high);
  EXPECT_LE(low, estimate + 1e-12);
  EXPECT_GE(high, estimate - 1e-12);
}

constexpr char kChange[] = "model.mass_scale=2.0";

/** A sweep of one factor, and the two sessions of its conditions. */
struct MadeSessions {
  Session sweep, before, after;
};

MadeSessions MakeExtreme(const Extreme& extreme, int num_objects, int num_trials) {
  std::vector<std::string> objects;
  for (int i = 0; i < num_objects; ++i) objects.push_back("object" + std::to_string(i));
  MadeSessions made;
  made.before = made.after = MakeSession({"tum"}, objects, "g1", num_trials);
  made.sweep.config = made.before.config;
  made.sweep.config.conditions = {{kChange, {kChange}}};
  for (const bool is_after : {false, true}) {
    Session& session = is_after ? made.after : made.before;
    for (size_t i = 0; i < session.records.size(); ++i) {
      TrialRecord& record = session.records[i];
      const int object = static_cast<int>(i) / num_trials;
      const bool succeeds = (is_after ? extreme.after : extreme.before)(object, record.plan.trial);
      record.result.outcome = succeeds ? Outcome::kSuccess : Outcome::kPushedAway;
      record.result.timing.gft_ratio = succeeds ? 1.0 : 0.0;
      made.sweep.records.push_back(record);
      PlannedTrial& plan = made.sweep.records.back().plan;
      plan.id += is_after ? " after" : "";
      if (is_after) plan.condition = kChange;
      made.sweep.plan.push_back(plan);
    }
  }
  return made;
}

class PossibleIntervals : public testing::TestWithParam<std::pair<int, int>> {
 protected:
  void ForEachExtreme(const std::function<void(const MadeSessions&)>& check) const {
    for (const Extreme& extreme : ListExtremes()) {
      SCOPED_TRACE(extreme.name);
      check(MakeExtreme(extreme, GetParam().first, GetParam().second));
    }
  }
};

TEST_P(PossibleIntervals, OfSweepsSensitivityAndComparisons) {
  ForEachExtreme([](const MadeSessions& made) {
    for (const SweepEffect& effect : SummariseSweep(made.sweep, {}).effects) {
      const bool is_share = effect.measure == "success" || effect.measure == "gft_ratio";
      if (!is_share || !effect.change.interval) continue;
      ExpectWithin(effect.change.interval->low, effect.change.estimate,
                   effect.change.interval->high, -1.0, 1.0);
    }
    const SessionComparison comparison = CompareSessions(made.before, made.after);
    for (const SettingChange& change : comparison.changes) {
      ExpectWithin(change.rate_change_low, change.rate_change(), change.rate_change_high, -1.0,
                   1.0);
      for (const char* id : {"gft_ratio", "got_ratio"}) {
        const MeasureChange& measure = change.Find(id);
        ExpectWithin(measure.low, measure.change(), measure.high, -1.0, 1.0);
      }
    }
    for (const LearningPoint& point :
         ListLearningPoints({{"before", &made.before}, {"after", &made.after}})) {
      ExpectWithin(point.interval.low, point.rate, point.interval.high, 0.0, 1.0);
      ExpectWithin(point.change_low, point.change, point.change_high, -1.0, 1.0);
    }
  });
}

TEST_P(PossibleIntervals, OfRatesOfSessions) {
  ForEachExtreme([](const MadeSessions& made) {
    for (const Session* session : {&made.before, &made.after}) {
      for (const CellSummary& cell : SummariseSession(*session).cells) {
        const Interval interval = cell.tally.rate_interval();
        ExpectWithin(interval.low, cell.tally.rate(), interval.high, 0.0, 1.0);
      }
    }
  });
}

// The line through 0 at 0, 50 and 100 ms and 1 at 200 and 300 ms is the steepest: its slope is
// (0.07 + 0.17) / 0.058 a second.
TEST_P(PossibleIntervals, OfDelays) {
  ForEachExtreme([](const MadeSessions& made) {
    std::vector<DelayedTrial> trials;
    for (size_t i = 0; i < made.before.records.size(); ++i) {
      for (const double delay : ListDelays()) {
        const Session& session = delay < 0.15 ? made.before : made.after;
        trials.push_back({"as run", "last", delay, {}, session.records[i]});
        trials.back().record.plan = made.before.records[i].plan;
      }
    }
    for (const DoseResponse& row : SummariseDelays(trials)) {
      if (std::string(row.response.id) != "success" || !row.interval) continue;
      ExpectWithin(row.interval->low, row.change, row.interval->high, -0.1 * 0.24 / 0.058,
                   0.1 * 0.24 / 0.058);
    }
  });
}

// Of a sign -1 to 1; of a rate that changes with 100 and with 300 ms of delay
// 0.1 (0.1 + 0.3) / (0.1^2 + 0.3^2) = 0.4.
TEST_P(PossibleIntervals, OfMaps) {
  ForEachExtreme([](const MadeSessions& made) {
    MapData data;
    data.factors = {{"grip", {"weak"}, false}};
    for (size_t i = 0; i < made.before.records.size(); ++i) {
      for (const double delay : {0.0, 0.1, 0.3}) {
        const TrialRecord& record = (delay > 0.0 ? made.after : made.before).records[i];
        const double success = IsSuccess(record.result.outcome) ? 1.0 : 0.0;
        MapTrial trial;
        trial.hand = "tum";
        trial.object = record.plan.object;
        trial.draw = record.plan.trial;
        trial.levels = {0};
        trial.late = delay > 0.0 ? LateDigit::kLast : LateDigit::kNone;
        trial.delay = delay;
        trial.values = {success, kUnset, success, kUnset};
        data.trials.push_back(trial);
      }
    }
    for (const MapCell& cell : MapSimultaneity(data).cells) {
      if (!cell.interval) continue;
      const double most = cell.measure == MapMeasure::kPush ? 1.0 : 0.4;
      ExpectWithin(cell.interval->low, cell.estimate, cell.interval->high, -most, most);
    }
    for (const ObjectEffect& effect : ListObjectEffects(data)) {
      if (!effect.interval) continue;
      ExpectWithin(effect.interval->low, effect.estimate, effect.interval->high, -0.4, 0.4);
    }
  });
}

INSTANTIATE_TEST_SUITE_P(OfObjectsAndTrials, PossibleIntervals,
                         testing::Values(std::pair(1, 1), std::pair(1, 12), std::pair(4, 3),
                                         std::pair(5, 1), std::pair(6, 4), std::pair(21, 2)));

// A map printed 100 (84 to 116 %) where every pair was pushed farther. Of 20 pairs without one that
// differs Wilson's upper limit is z^2 / (n + z^2) = 0.1611; such a pair may be pushed less far, so
// the mean is at least 1 - 2 * 0.1611.
TEST(PossibleInterval, OfAPushThatIsTheSameEverywhereEndsAtAllPairs) {
  MapData data;
  data.factors = {{"grip", {"weak"}, false}};
  for (int i = 0; i < 20; ++i) {
    for (const double delay : {0.0, 0.1}) {
      MapTrial trial;
      trial.hand = "tum";
      trial.object = "object" + std::to_string(i / 4);
      trial.draw = i;
      trial.levels = {0};
      trial.late = delay > 0.0 ? LateDigit::kLast : LateDigit::kNone;
      trial.delay = delay;
      trial.values = {kUnset, kUnset, delay, kUnset};
      data.trials.push_back(trial);
    }
  }
  const SimultaneityMap map = MapSimultaneity(data);
  const MapCell* cell = FindCell(map, MapMeasure::kPush, "tum", LateDigit::kLast, {});
  ASSERT_TRUE(cell && cell->interval);
  EXPECT_EQ(cell->estimate, 1.0);
  const double z = 1.959963984540054;
  EXPECT_NEAR(cell->interval->low, 1.0 - 2.0 * z * z / (20.0 + z * z), 1e-12);
  EXPECT_EQ(cell->interval->high, 1.0);
}

}  // namespace
}  // namespace graspbench
