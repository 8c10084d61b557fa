#include "datasets/analysis/conditions/threshold_summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/base/error.h"
#include "datasets/analysis/conditions/sweep_summary.h"
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

ThresholdSummary Summarise(const Session& experiment) {
  Session session;
  for (const PlannedTrial& planned : experiment.plan) {
    if (!planned.condition) session.plan.push_back(planned);
  }
  return SummariseThresholds(experiment, session);
}

std::function<bool(int)> From(int first) {
  return [first](int place) { return place >= first; };
}

TEST(ThresholdSummary, MedianAndIntervalAreOrderStatistics) {
  // Ten draws: places 0, 1, 2, 4, 4, 8, 8, 8, 12 and never. Of ten the interval is from the second
  // to the ninth: P(B <= 1) = 11 / 1024 is below 2.5 %, P(B <= 2) = 56 / 1024 is not.
  std::vector<std::function<bool(int)>> draws;
  for (const int first : {8, 0, 4, 99, 2, 12, 1, 8, 4, 8}) draws.push_back(From(first));
  const ThresholdSummary summary = Summarise(MakeExperiment(draws));
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
      Summarise(MakeExperiment({From(4), From(4), From(4), From(4), From(4)}));
  EXPECT_TRUE(std::isnan(summary.cells[0].low));
  EXPECT_DOUBLE_EQ(summary.cells[0].median, 2.0);
}

TEST(ThresholdSummary, NamesDrawsThatFailAgain) {
  const auto gap = [](int place) { return (place >= 4 && place <= 9) || place >= 13; };
  const ThresholdSummary summary = Summarise(MakeExperiment({From(4), gap}));
  EXPECT_EQ(summary.cells[0].not_monotone, std::vector<int>{1});
  EXPECT_EQ(summary.num_not_monotone(), 1);
  const std::vector<ExportTable> tables = MakeThresholdTables({summary});
  ASSERT_EQ(tables.size(), 1u);
  EXPECT_NE(tables[0].csv.find("base0,,tum,can,g1,0,margin,2.0,0,1,"), std::string::npos)
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
  EXPECT_EQ(ToJson(Summarise(session)), ToJson(Summarise(whole)));
}

TEST(ThresholdSummary, WhatIsNotFinishedIsNotCounted) {
  Session session = MakeExperiment({From(4), From(4)});
  session.records.resize(17);
  const ThresholdSummary summary = Summarise(session);
  EXPECT_EQ(summary.cells[0].num_draws, 1);
  EXPECT_TRUE(std::isnan(summary.draws[1].value));
}

/** Two conditions of six objects with two draws each: under "heavy" a draw needs the grip that is
four places larger, twice the margin; the second draw of object 0 is never held there. */
struct ThresholdSweep {
  ThresholdSweep() {
    sweep.config.conditions = {{"heavy", {"model.mass_scale=2.0"}}};
    experiment.config.conditions = ListThresholdGrips(kMarginScale, sweep.config);
    for (int object = 0; object < 6; ++object) {
      for (int trial = 0; trial < 2; ++trial) Add(object, trial);
    }
  }

  void Add(int object, int number) {
    const std::string id = std::to_string(2 * object + number);
    PlannedTrial planned = {"base" + id, "tum", "object" + std::to_string(object), "g1", number};
    TrialRecord record;
    record.plan = planned;
    for (const bool is_heavy : {false, true}) {
      record.plan.id = (is_heavy ? "heavy" : "base") + id;
      if (is_heavy) record.plan.condition = "heavy";
      sweep.plan.push_back(record.plan);
      sweep.records.push_back(record);
    }
    experiment.plan.push_back(planned);
    const bool is_lost = object == 0 && number == 1;
    for (size_t i = 0; i < experiment.config.conditions.size(); ++i) {
      const bool is_heavy = i > size_t{kMostGripPlace};
      const int place = static_cast<int>(i) % (kMostGripPlace + 1);
      record.plan.id = "grip" + id + "-" + std::to_string(i);
      record.plan.condition = experiment.config.conditions[i].name;
      const bool holds = is_heavy ? place >= object + 5 && !is_lost : place >= object + 1;
      record.result.outcome = holds ? Outcome::kSuccess : Outcome::kDroppedWhileHolding;
      experiment.plan.push_back(record.plan);
      experiment.records.push_back(record);
    }
  }

  Session sweep, experiment;
};

TEST(ThresholdSummary, EachConditionOfASweepHasItsOwn) {
  const ThresholdSweep planted;
  ASSERT_EQ(planted.experiment.config.conditions.size(), 34u);
  EXPECT_EQ(planted.experiment.config.conditions[17].name, "heavy, margin 1.000");
  EXPECT_EQ(FindThresholdScale(planted.experiment.config), &kMarginScale);
  const ThresholdSummary summary = SummariseThresholds(planted.experiment, planted.sweep);
  ASSERT_EQ(summary.draws.size(), 24u);
  ASSERT_EQ(summary.cells.size(), 12u);
  for (const DrawThreshold& draw : summary.draws) {
    const int object = draw.draw.object.back() - '0';
    const bool is_heavy = draw.draw.condition == "heavy";
    if (is_heavy && object == 0 && draw.draw.trial == 1) {
      EXPECT_TRUE(std::isinf(draw.value));
      continue;
    }
    EXPECT_DOUBLE_EQ(draw.value, CalcGripAt(kMarginScale, object + (is_heavy ? 5 : 1)));
    EXPECT_EQ(draw.draw.id.rfind(is_heavy ? "heavy" : "base", 0), 0u) << draw.draw.id;
  }
  EXPECT_EQ(MakeThresholdTables({summary})[0].csv.find("heavy0,heavy,tum,object0,g1,0,margin,") !=
                std::string::npos,
            true);
}

// All draws but one need exactly twice the margin; that one counts as one step above the largest:
// from place 1 to 17 are 16 quarters of an octave, so the mean of twelve is (11 + 4) / 12.
TEST(ThresholdSummary, IsAResponseOfASweep) {
  const ThresholdSweep planted;
  const ThresholdSummary thresholds = SummariseThresholds(planted.experiment, planted.sweep);
  const SweepSummary summary = SummariseSweep(planted.sweep, {thresholds});
  const auto effect =
      std::find_if(summary.effects.begin(), summary.effects.end(),
                   [](const SweepEffect& one) { return one.measure == "threshold_margin"; });
  ASSERT_NE(effect, summary.effects.end());
  EXPECT_EQ(effect->change.num_draws, 12);
  EXPECT_NEAR(effect->change.estimate, 15.0 / 12.0, 1e-12);
  EXPECT_TRUE(effect->excludes_zero());
  const SweepMeasure& measure = FindSweepMeasure("threshold_margin");
  const size_t column = static_cast<size_t>(&measure - ListSweepMeasures().data());
  EXPECT_TRUE(summary.Shows(column));
  EXPECT_FALSE(summary.Shows(column + 1)) << "nobody looked for forces";
  EXPECT_DOUBLE_EQ(summary.rows[0].medians[column],
                   0.5 * (CalcGripAt(kMarginScale, 3) + CalcGripAt(kMarginScale, 4)));
  ASSERT_EQ(summary.thresholds.size(), 2u);
  EXPECT_EQ(summary.thresholds[1].num_never, 1);
  EXPECT_EQ(summary.thresholds[1].num_draws, 12);
  EXPECT_TRUE(SummariseSweep(planted.sweep, {}).thresholds.empty());
}

TEST(ThresholdSummary, ASweepOfTheGripHasNone) {
  SessionConfig config;
  for (const char* setting :
       {"strategy.grip=force", "strategy.grip_force_n=1.5", "strategy.grip_margin=4.0"}) {
    config.conditions = {{"other", {setting}}};
    EXPECT_THROW(ListThresholdGrips(kMarginScale, config), Error) << setting;
  }
  config.conditions = {{"other", {"strategy.touch_speed=1.0"}}};
  EXPECT_EQ(ListThresholdGrips(kMarginScale, config).size(), 34u);
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
    EXPECT_EQ(FindThresholdScale(experiment), scale);
  }
  EXPECT_EQ(FindThresholdScale(SessionConfig()), nullptr);
  EXPECT_THROW(SummariseThresholds(Session(), Session()), Error);
  config.strategy.grip = "posture";
  config.strategy.touch_speed = 1.0;
  EXPECT_EQ(ApplyCondition(ListThresholdGrips(kMarginScale, config)[4], config)
                .config.strategy.touch_speed,
            MakePeopleGrip().touch_speed);
}

// Of two draws one is held by the least grip, the other by none: the median is no grip at all.
TEST(ThresholdSummary, AMedianThatNoGripHoldsIsNotAtMostAnything) {
  CellThreshold cell;
  cell.num_draws = 2;
  cell.num_below = 1;
  cell.median = std::numeric_limits<double>::infinity();
  EXPECT_EQ(FormatMedian(kThresholdScales[0], cell), "none held");
  cell.median = 1.09;
  EXPECT_EQ(FormatMedian(kThresholdScales[0], cell), "at most 1.09");
  EXPECT_EQ(NameNotMonotone(cell), "none");
  cell.not_monotone = {0};
  EXPECT_EQ(NameNotMonotone(cell), "draw 0");
  cell.not_monotone = {0, 3};
  EXPECT_EQ(NameNotMonotone(cell), "draws 0, 3");
}

}  // namespace
}  // namespace graspbench
