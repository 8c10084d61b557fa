#pragma once
/** @file
All statistics of one measure: by condition, for every factor, for pairs of conditions, and as
trends over factors whose levels are quantities. */

#include <string>
#include <vector>

#include "core/statistics/bootstrap.h"
#include "core/statistics/proportion.h"
#include "core/statistics/summary.h"
#include "human_study/events/trial_analysis.h"
#include "human_study/statistics/condition_means.h"
#include "human_study/statistics/effects_model.h"
#include "human_study/statistics/line_fit.h"
#include "human_study/statistics/location_tests.h"
#include "human_study/statistics/reliability/reliability.h"
#include "human_study/statistics/within_anova.h"
#include "human_study/study/design/study_config.h"

namespace graspbench {

/** Comparison of two conditions: b - a of the persons' means. */
struct PairStatistics {
  PairComparison means;  ///< t test
  Answer<WilcoxonTest> ranks;
  double p_ranks_holm = NAN;            ///< over all pairs; NaN without a test
  Answer<BootstrapInterval> bootstrap;  ///< of the mean difference, resampling persons
  Answer<EquivalenceTest> equivalence;  ///< none without bounds in the hypothesis
};

/** Trend of all trials over a factor whose levels are quantities. */
struct TrendStatistics {
  std::string factor;
  PersonSlopes slopes;                  ///< tested against the slope of the hypothesis
  Answer<BootstrapInterval> bootstrap;  ///< of the mean slope, resampling persons
  Answer<EffectsModel> model;  ///< of all trials; its slope is tested against the same value
};

/** Range of the median over all trials under the choices of the analysis. */
struct ChoiceRange {
  int num_values = 0;  ///< combinations of choices with a value
  double lowest = NAN, highest = NAN;
};

struct MeasureStatistics {
  TrialMeasure measure;
  Hypothesis hypothesis;
  MeasureTable table;       ///< the included trials
  Answer<Summary> summary;  ///< over them
  ChoiceRange over_choices;
  std::vector<Answer<Summary>> by_cell;  ///< within each cell, in the order of ListCells()
  Answer<CellMeans> cells;
  Answer<WithinAnova> anova;
  Answer<EffectsModel> model;  ///< of all trials, including persons with an empty condition
  Answer<FriedmanTest> friedman;
  std::vector<PairStatistics> pairs;
  std::vector<GroupComparison> group_pairs;
  Answer<Retest> retest;                ///< none without sessions
  std::vector<TrendStatistics> trends;  ///< one for each factor with numbers
};

/** Possible range of a mean of the measure: 0 to 1 for shares (unit "1"), else unbounded. Student's
t intervals ignore such limits; cutting at them does not change their coverage. */
Interval FindPossible(const TrialMeasure& measure);
/** Possible range of a difference of two such means: -1 to 1 for shares. */
Interval FindPossibleDifference(const TrialMeasure& measure);
Interval CutAt(const Interval& possible, const Interval& interval);

MeasureStatistics CalcMeasureStatistics(const TrialMeasure& measure, const MeasureTable& table,
                                        const Hypothesis& hypothesis);

/** Lists the levels of every cell, in the order of ListCells(). */
std::vector<std::vector<std::string>> ListLevels(const std::vector<Factor>& factors);
/** Summarises the rows with a value. */
Answer<Summary> SummariseRows(const MeasureTable& table);
/** No answer for a study without factors and groups. */
Answer<WithinAnova> CalcAnova(const Answer<CellMeans>& cells);

/** Condition means of a measure with all kinds of error bars, for figures and tables. */
struct ConditionEstimates {
  std::vector<std::string> cells;  ///< in the order of ListCells()
  std::vector<double> means;       ///< of the persons' means, else over trials; NaN: no trial
  std::vector<int> num_trials;     ///< trials with a value
  std::vector<Answer<Eigen::VectorXd>> half_widths;  ///< of each of ListBarKinds()
  /** Bars of the figure: Loftus and Masson's, which allow visual comparison of conditions; where
  these are unavailable, between-person bars. */
  Answer<Eigen::VectorXd> drawn;
  std::string drawn_kind;                     ///< for the caption: the kind, or why there are none
  Interval possible = {-INFINITY, INFINITY};  ///< FindPossible

  /** Mean -+ half the drawn length, cut at the possible range. @pre `drawn` has a value. */
  Interval drawn_interval(size_t cell) const {
    const double half = (*drawn)[static_cast<Eigen::Index>(cell)];
    return CutAt(possible, {means[cell] - half, means[cell] + half});
  }
};
ConditionEstimates CalcConditionEstimates(const MeasureStatistics& statistics);

/** Published values for comparison with a study's own: an expectation for healthy adults who reach
for objects on a table, never a criterion. */
struct StudyResult;

struct PublishedValue {
  const char* measure;   ///< id of TrialMeasureList()
  bool is_slope;         ///< a slope over a factor with numbers, not the measure itself
  const char* unit_end;  ///< for a slope: suffix of the factor's name ("_m" for a size, "_kg")
  const char* text;      ///< what was found
  const char* source;
};

const std::vector<PublishedValue>& PublishedValueList();

/** A study's own value for a published one. */
struct ComparedValue {
  const PublishedValue* published = nullptr;
  const TrialMeasure* measure = nullptr;
  Answer<Summary> summary;  ///< of the measure over the included trials
  std::string factor;       ///< of a slope; else empty
  PersonSlopes slopes;      ///< over this factor, tested against 0
};
/** Compares the published values that the study can address, in the order of the list. */
std::vector<ComparedValue> ComparePublished(const StudyResult& result);

}  // namespace graspbench
