#include "human_study/study/output/statistics_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/human_study/faults.h"
#include "tests/human_study/statistics/known_studies.h"

namespace graspbench {
namespace {

const TrialMeasure kAperture = {"aperture_mm", "aperture", "mm",
                                [](const TrialAnalysis&) { return 0.0; }};

/** The reaching study of R's answers, its size read as a quantity. */
MeasureStatistics MakeStatistics(const Hypothesis& hypothesis = {}) {
  return CalcMeasureStatistics(kAperture, MakeReachTable(), hypothesis);
}

StatisticRow FindRow(const std::vector<StatisticRow>& rows, const std::string& analysis,
                     const std::string& effect) {
  for (const StatisticRow& row : rows) {
    if (row.analysis == analysis && row.effect == effect) return row;
  }
  ADD_FAILURE() << "no row \"" << analysis << "\", \"" << effect << "\"";
  return {};
}

std::vector<StatisticRow> ListAll(const MeasureStatistics& measure) {
  StudyStatistics statistics;
  statistics.measures = {measure};
  return ListStatistics(statistics);
}

TEST(StatisticsTable, ConditionTestsAreThoseOfTheAnalyses) {
  const MeasureStatistics measure = MakeStatistics();
  const std::vector<StatisticRow> rows = ListConditionTests(measure);
  const WithinEffect& effect = measure.anova->effects[0];
  const StatisticRow anova = FindRow(rows, "repeated-measures ANOVA", "size");
  EXPECT_EQ(anova.value, effect.test->f);
  EXPECT_EQ(anova.df_1, 3.0);
  EXPECT_EQ(anova.df_2, 21.0);
  EXPECT_EQ(anova.p, effect.test->p);
  EXPECT_EQ(anova.effect_size, effect.test->generalised_eta_squared);
  EXPECT_EQ(anova.note,
            "assumes normal differences and sphericity; partial eta squared 0.962; Mauchly's W "
            "0.0327, p 0.00178");
  const StatisticRow corrected = FindRow(rows, "ANOVA, Greenhouse-Geisser", "size");
  EXPECT_NEAR(corrected.df_2, 21 * 0.4156420793, 1e-8);
  EXPECT_EQ(corrected.p, effect.test->greenhouse_geisser.p);
  EXPECT_EQ(FindRow(rows, "ANOVA, Huynh-Feldt", "size").p, effect.test->huynh_feldt->p);
  EXPECT_EQ(FindRow(rows, "Friedman", "condition").effect_size, 1.0);  // all persons agree
}

TEST(StatisticsTable, SlopesAreThoseOfPersonsAndTheMixedModelAgrees) {
  const std::vector<StatisticRow> rows = ListTrends(MakeStatistics({"aperture_mm", 0.82}));
  const StatisticRow slope = FindRow(rows, "persons' slopes, t test", "slope over size");
  EXPECT_EQ(slope.unit, "mm per size");
  EXPECT_NEAR(slope.estimate, 0.8258333, 1e-7);
  EXPECT_NEAR(slope.p, 0.920414, 1e-6);
  ExpectHolds(slope.note, "tested against 0.82");
  const StatisticRow drawn = FindRow(rows, "persons' slopes, BCa bootstrap", "slope over size");
  EXPECT_EQ(drawn.estimate, slope.estimate);
  EXPECT_GT(drawn.low, slope.low - 0.05);
  EXPECT_LT(drawn.low, slope.estimate);
  EXPECT_GT(drawn.high, slope.estimate);
  // In a balanced design the fixed slope is the mean of the persons' slopes, with their error.
  const StatisticRow mixed = FindRow(rows, "mixed model (REML)", "slope over size");
  EXPECT_NEAR(mixed.estimate, slope.estimate, 1e-9);
  EXPECT_NEAR(mixed.standard_error, slope.standard_error, 1e-6);
  EXPECT_NEAR(mixed.df_1, 7.0, 0.01);
  EXPECT_NEAR(mixed.value, slope.value, 1e-4);  // against the same reference
  EXPECT_NEAR(mixed.p, slope.p, 1e-4);
  ExpectHolds(mixed.note, "tested against 0.82");
  EXPECT_EQ(std::count_if(rows.begin(), rows.end(),
                          [](const auto& row) { return row.analysis == "mixed model (REML)"; }),
            1);
}

TEST(StatisticsTable, PairsHoldTheDifferenceItsRanksAndItsBounds) {
  const Hypothesis hypothesis = {"aperture_mm", 0.0, 43.0};
  const std::vector<StatisticRow> rows = ListPairs(MakeStatistics(hypothesis));
  const StatisticRow t = FindRow(rows, "paired t test", "75 - 30");
  EXPECT_NEAR(t.effect_size, 4.834925, 1e-6);
  EXPECT_GT(t.p_holm, t.p);
  const StatisticRow ranks = FindRow(rows, "Wilcoxon signed ranks", "75 - 30");
  EXPECT_EQ(ranks.value, 36.0);          // 1 + 2 + .. + 8: all differ in one direction
  EXPECT_EQ(ranks.p, 2.0 / 256.0);       // two of 2^8 signs are as extreme
  EXPECT_EQ(ranks.p_holm, 6 * ranks.p);  // all six pairs are like that
  EXPECT_EQ(ranks.effect_size, 1.0);
  const StatisticRow equal = FindRow(rows, "equivalence, two one-sided t tests", "75 - 30");
  EXPECT_EQ(equal.confidence, 0.9);
  // The interval lies within the bounds exactly when p is below 0.05.
  EXPECT_EQ(equal.high < 43.0, equal.p < 0.05);
  EXPECT_NEAR(equal.value, (t.estimate - 43.0) / t.standard_error, 1e-9);
  const std::vector<StatisticRow> without = ListPairs(MakeStatistics());
  EXPECT_EQ(rows.size(), without.size() + 6);
}

TEST(StatisticsTable, WhatHasNoAnswerSaysWhy) {
  MeasureTable table = MakeReachTable();
  table.rows.resize(4);  // one person
  const MeasureStatistics statistics = CalcMeasureStatistics(kAperture, table, {"", 0.0, 5.0});
  const std::vector<StatisticRow> rows = ListAll(statistics);
  ASSERT_FALSE(rows.empty());
  for (const StatisticRow& row : rows) {
    if (row.analysis == "Wilcoxon signed ranks") {
      EXPECT_EQ(row.p, 1.0);  // one pair: either sign is as likely
      continue;
    }
    EXPECT_TRUE(std::isnan(row.p)) << row.analysis;
    EXPECT_EQ(row.note.rfind("none: ", 0), 0U) << row.analysis << ": " << row.note;
  }
}

/** The reaching study, its persons in two groups and seen twice. */
MeasureTable MakeGroupedTable() {
  MeasureTable table = MakeReachTable();
  table.groups = {{"group", {"old", "young"}, {}, ""}};
  table.sessions = {"1", "2"};
  const size_t num_rows = table.rows.size();
  for (size_t i = 0; i < num_rows; ++i) {
    Observation& row = table.rows[i];
    row.groups = {std::stoi(row.person.substr(1)) <= 3 ? "old" : "young"};
    row.session = "1";
    Observation again = row;
    again.session = "2";
    again.value += 2.0 + static_cast<double>(i * 5 % 7) / 2.0;
    table.rows.push_back(again);
  }
  return table;
}

TEST(StatisticsTable, GroupsMakeAMixedDesignAndSessionsARetest) {
  const MeasureStatistics statistics = CalcMeasureStatistics(kAperture, MakeGroupedTable(), {});
  const std::vector<StatisticRow> rows = ListAll(statistics);
  const StatisticRow group = FindRow(rows, "mixed ANOVA (type III)", "group");
  EXPECT_EQ(group.df_1, 1.0);
  EXPECT_EQ(group.df_2, 6.0);
  const StatisticRow both = FindRow(rows, "mixed ANOVA (type III)", "size x group");
  EXPECT_EQ(both.df_1, 3.0);
  EXPECT_EQ(both.df_2, 18.0);
  FindRow(rows, "ANOVA, Greenhouse-Geisser", "size x group");
  // Two groups: Welch's t has the sign of the means' difference and at most all degrees of freedom.
  const StatisticRow welch = FindRow(rows, "Welch t test of groups", "group: young minus old");
  EXPECT_LE(welch.df_1, 6.0);
  EXPECT_GT(welch.value * welch.estimate, 0.0);
  const StatisticRow model = FindRow(rows, "mixed model (REML), all factors", "size x group");
  EXPECT_EQ(model.df_1, 3.0);
  ExpectHolds(model.note, "varies between persons: level of persons");
  FindRow(rows, "mixed model (REML), size as a quantity", "size x group");
  FindRow(rows, "mixed model (REML), all factors", "mean in 30");
  const StatisticRow icc = FindRow(rows, "test-retest", "ICC(2,1)");
  EXPECT_LT(icc.estimate, FindRow(rows, "test-retest", "ICC(3,1)").estimate);
  EXPECT_GT(FindRow(rows, "test-retest, shift (paired t test)", "session 2 minus 1").estimate, 2.0);
}

TEST(StatisticsTable, AGroupWithOnePersonIsASentence) {
  MeasureTable table = MakeGroupedTable();
  for (Observation& row : table.rows) {
    row.groups = {row.person == "P1" ? "old" : "young"};
  }
  const std::vector<StatisticRow> rows = ListAll(CalcMeasureStatistics(kAperture, table, {}));
  EXPECT_EQ(FindRow(rows, "mixed ANOVA (type III)", "condition").note,
            "none: group \"old\" has 1 person with a value in every condition; expected 2 or more");
  EXPECT_EQ(FindRow(rows, "mixed model (REML), all factors", "condition").note,
            "none: group \"old\" has 1 person; expected 2 or more");
  EXPECT_EQ(FindRow(rows, "Welch t test of groups", "group: young minus old").note,
            "none: 1 person with a value in a group; expected 2 or more");
}

TEST(StatisticsTable, OpeningsHaveARowForEveryCriterionOrTheReason) {
  OpeningFamily family;
  family.rows.resize(2);
  family.rows[0].opening = &FindHandOpening("aperture");
  family.rows[1].opening = &FindHandOpening("hull");
  for (OpeningComparison& comparison : family.rows[1].against_aperture) {
    comparison.no_answer = "4 persons; expected 5 or more";
  }
  family.rows[1].against_aperture[1] = {1.2, 0.9, 1.6, 0.15, 0.6, 7, ""};
  const std::vector<StatisticRow> rows = ListOpenings(family);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].measure, "open_hull_m");
  EXPECT_EQ(rows[0].note, "none: 4 persons; expected 5 or more");
  EXPECT_EQ(rows[1].effect, "separation");
  EXPECT_EQ(rows[1].estimate, 1.2);
  EXPECT_EQ(rows[1].p_holm, 0.6);
  EXPECT_EQ(rows[1].num_persons, 7);
}

TEST(StatisticsTable, IndependenceHasARowForEveryClockOrTheReason) {
  EXPECT_EQ(ListIndependence(NoAnswer{"too few"}).size(), 6u);
  EXPECT_EQ(ListIndependence(NoAnswer{"too few"}).front().note, "none: too few");
  IndependenceNull null;
  null.num_persons = 2;
  null.gft_ratio[2] = {0.2, 0.25, 0.24, 0.26, 0.002, 0.08};
  const StatisticRow row = ListIndependence(null).back();
  EXPECT_EQ(row.measure, "grasp_forming_ratio");
  EXPECT_NEAR(row.estimate, 0.8, 1e-12);
  EXPECT_EQ(row.p, 0.002);
  EXPECT_TRUE(std::isnan(row.low));  // two persons
}

// Of two persons that differ by 1 and 0 Student's t alone gives 0.5 -+ 12.7 / 2.
TEST(StatisticsTable, IntervalsOfSharesAreWithinWhatIsPossible) {
  const TrialMeasure share = {"gft_ratio", "GFT%", "1", [](const TrialAnalysis&) { return 0.0; }};
  int num_intervals = 0;
  for (const int num_persons : {2, 3, 6}) {
    for (const int kind : {0, 1, 2, 3}) {  // all, none, opposed, one that differs
      MeasureTable table;
      table.factors = {{"size", {"30", "60"}, {30, 60}, ""}};
      table.sessions = {"1", "2"};
      for (int person = 0; person < num_persons; ++person) {
        for (const int session : {0, 1}) {
          for (const size_t level : {0u, 1u}) {
            Observation row;
            row.person = std::to_string(person);
            row.session = table.sessions[static_cast<size_t>(session)];
            row.levels = {table.factors[0].levels[level]};
            const bool is_high = level == 1;
            row.value = kind == 0   ? 1.0
                        : kind == 1 ? 0.0
                        : kind == 2 ? (is_high ? 1.0 - 0.1 * person : 0.1 * session)
                                    : (is_high && person == 0 ? 1.0 : 0.0);
            table.rows.push_back(row);
          }
        }
      }
      const MeasureStatistics statistics = CalcMeasureStatistics(share, table, {"gft_ratio"});
      for (const StatisticRow& row : ListAll(statistics)) {
        if (row.unit != "1" || std::isnan(row.low)) continue;
        const bool is_mean = row.effect.rfind("mean in", 0) == 0;
        EXPECT_GE(row.low, is_mean ? 0.0 : -1.0) << row.analysis << ", " << row.effect;
        EXPECT_LE(row.high, 1.0) << row.analysis << ", " << row.effect;
        EXPECT_LE(row.low, row.high) << row.analysis << ", " << row.effect;
        ++num_intervals;
      }
      const ConditionEstimates estimates = CalcConditionEstimates(statistics);
      if (!estimates.drawn) continue;
      for (size_t cell = 0; cell < estimates.cells.size(); ++cell) {
        const Interval interval = estimates.drawn_interval(cell);
        EXPECT_GE(interval.low, 0.0);
        EXPECT_LE(interval.high, 1.0);
      }
    }
  }
  EXPECT_GE(num_intervals, 20);
}

}  // namespace
}  // namespace graspbench
