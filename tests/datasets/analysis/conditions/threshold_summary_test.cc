#include "datasets/analysis/conditions/threshold_summary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/error.h"
#include "datasets/plan/conditions.h"

namespace graspbench {
namespace {

const ThresholdScale& kMarginScale = kThresholdScales[0];
const ThresholdScale& kForceScale = kThresholdScales[1];

/** Draws of one cell of which the k-th holds with these places; every grip of them has run. */
Session MakeExperiment(const std::vector<std::function<bool(int)>>& draws) {
  Session session;
  session.config.conditions = ListThresholdGrips(kMarginScale, session.config);
  for (size_t k = 0; k < draws.size(); ++k) {
    PlannedTrial planned = {"base" + std::to_string(k), "tum", "can", "g1", static_cast<int>(k)};
    session.plan.push_back(planned);
    for (int place = 0; place <= kMostGripPlace; ++place) {
      planned.id = "grip" + std::to_string(k) + "-" + std::to_string(place);
      planned.condition = session.config.conditions[static_cast<size_t>(place)].name;
      session.plan.push_back(planned);
      TrialRecord& record = session.records.emplace_back();
      record.plan = planned;
      record.result.outcome = draws[k](place) ? Outcome::kSuccess : Outcome::kDroppedWhileHolding;
    }
  }
  return session;
}

std::function<bool(int)> From(int first) {
  return [first](int place) { return place >= first; };
}

TEST(ThresholdSummary, MedianAndIntervalAreOrderStatistics) {
  // Ten draws: places 0, 1, 2, 4, 4, 8, 8, 8, 12 and never. Of ten the interval is from the second
  // to the ninth: P(B <= 1) = 11 / 1024 is below 2.5 %, P(B <= 2) = 56 / 1024 is not.
  std::vector<std::function<bool(int)>> draws;
  for (const int first : {8, 0, 4, 99, 2, 12, 1, 8, 4, 8}) draws.push_back(From(first));
  const ThresholdSummary summary = SummariseThresholds(MakeExperiment(draws));
  EXPECT_EQ(summary.scale, &kMarginScale);
  ASSERT_EQ(summary.cells.size(), 1u);
  const CellThreshold& cell = summary.cells[0];
  EXPECT_EQ(cell.num_draws, 10);
  EXPECT_EQ(cell.num_never, 1);
  EXPECT_EQ(cell.num_below, 1);
  EXPECT_TRUE(cell.not_monotone.empty());
  EXPECT_DOUBLE_EQ(cell.median, 0.5 * (2.0 + 4.0));
  EXPECT_DOUBLE_EQ(cell.low, CalcGripAt(kMarginScale, 1));
  EXPECT_DOUBLE_EQ(cell.high, 8.0);
  EXPECT_LE(summary.num_trials, 10 * kMostThresholdTrials);
  EXPECT_EQ(FormatThreshold(kMarginScale, summary.draws[3].value), "none held");
  EXPECT_TRUE(ToJson(summary)["cells"][0]["low"].is_number());
}

TEST(ThresholdSummary, FewDrawsHaveNoInterval) {
  const ThresholdSummary summary =
      SummariseThresholds(MakeExperiment({From(4), From(4), From(4), From(4), From(4)}));
  EXPECT_TRUE(std::isnan(summary.cells[0].low));
  EXPECT_DOUBLE_EQ(summary.cells[0].median, 2.0);
}

TEST(ThresholdSummary, NamesDrawsThatFailAgain) {
  const auto gap = [](int place) { return (place >= 4 && place <= 9) || place >= 13; };
  const ThresholdSummary summary = SummariseThresholds(MakeExperiment({From(4), gap}));
  EXPECT_EQ(summary.cells[0].not_monotone, std::vector<int>{1});
  EXPECT_EQ(summary.num_not_monotone(), 1);
  const std::vector<ExportTable> tables = MakeThresholdTables({summary});
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_NE(tables[0].csv.find("base0,tum,can,g1,0,margin,2.0,0,1,"), std::string::npos)
      << tables[0].csv;
  EXPECT_TRUE(MakeThresholdTables({}).empty());
}

// Trial by trial, as a round asks for them, the same is found as from all grips.
TEST(ThresholdSummary, AsksForOneTrialOfEveryDrawUntilAllAreFound) {
  const Session whole = MakeExperiment({From(0), From(7), From(99)});
  Session session = whole;
  session.records.clear();
  int num_rounds = 0;
  for (;; ++num_rounds) {
    const std::vector<PlannedTrial> trials = FindThresholdTrials(session);
    if (trials.empty()) break;
    ASSERT_LE(trials.size(), 3u);
    for (const PlannedTrial& planned : trials) {
      for (const TrialRecord& record : whole.records) {
        if (record.plan.id == planned.id) session.records.push_back(record);
      }
    }
  }
  EXPECT_EQ(num_rounds, kMostThresholdTrials);
  EXPECT_EQ(ToJson(SummariseThresholds(session)), ToJson(SummariseThresholds(whole)));
}

TEST(ThresholdSummary, WhatIsNotFinishedIsNotCounted) {
  Session session = MakeExperiment({From(4), From(4)});
  session.records.resize(17);
  const ThresholdSummary summary = SummariseThresholds(session);
  EXPECT_EQ(summary.cells[0].num_draws, 1);
  EXPECT_TRUE(std::isnan(summary.draws[1].value));
}

// None of the grips may be the session's own trial, whatever that is.
TEST(ThresholdSummary, GripsDifferFromTheSession) {
  SessionConfig config;
  config.strategy.grip_force = 0.0;  // with margin 2, which is on the scale
  for (const ThresholdScale* scale : {&kMarginScale, &kForceScale}) {
    const std::vector<Condition> grips = ListThresholdGrips(*scale, config);
    ASSERT_EQ(grips.size(), 17u);
    for (const Condition& grip : grips) {
      const StrategyConfig strategy = ApplyCondition(grip, config).config.strategy;
      EXPECT_TRUE(strategy.grip != config.strategy.grip ||
                  strategy.grip_force != config.strategy.grip_force ||
                  strategy.grip_margin != config.strategy.grip_margin);
    }
    SessionConfig experiment = config;
    experiment.conditions = grips;
    EXPECT_EQ(&FindThresholdScale(experiment), scale);
  }
  EXPECT_THROW(FindThresholdScale(SessionConfig()), Error);
  config.strategy.grip = "posture";
  config.strategy.touch_speed = 1.0;
  EXPECT_EQ(ApplyCondition(ListThresholdGrips(kMarginScale, config)[4], config)
                .config.strategy.touch_speed,
            MakePeopleGrip().touch_speed);
}

}  // namespace
}  // namespace graspbench
