#pragma once
/** @file
All statistics of one measure: by condition, of every factor, of pairs of conditions, and as a trend
over factors whose levels are quantities. */

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

/** Two conditions, b - a in the persons' means. */
struct PairStatistics {
  PairComparison means;  ///< t test
  Answer<WilcoxonTest> ranks;
  double p_ranks_holm = NAN;            ///< over all pairs; NaN without a test
  Answer<BootstrapInterval> bootstrap;  ///< of the mean difference, persons drawn
  Answer<EquivalenceTest> equivalence;  ///< none without a hypothesis' bounds
};

/** All trials over a factor whose levels are quantities. */
struct TrendStatistics {
  std::string factor;
  PersonSlopes slopes;                  ///< tested against the hypothesis' slope
  Answer<BootstrapInterval> bootstrap;  ///< of the mean slope, persons drawn
  Answer<EffectsModel> model;           ///< all trials; the slope against the same
};

/** How far the choices of the analysis move the median over all trials. */
struct ChoiceRange {
  int num_values = 0;  ///< combinations of choices with a value
  double lowest = NAN, highest = NAN;
};

struct MeasureStatistics {
  TrialMeasure measure;
  Hypothesis hypothesis;
  MeasureTable table;       ///< the kept trials
  Answer<Summary> summary;  ///< over them
  ChoiceRange over_choices;
  std::vector<Answer<Summary>> by_cell;  ///< the same within each cell, as ListCells() orders them
  Answer<CellMeans> cells;
  Answer<WithinAnova> anova;
  Answer<EffectsModel> model;  ///< all trials, also of persons with an empty condition
  Answer<FriedmanTest> friedman;
  std::vector<PairStatistics> pairs;
  std::vector<GroupComparison> group_pairs;
  Answer<Retest> retest;                ///< none without sessions
  std::vector<TrendStatistics> trends;  ///< one for each factor with numbers
};

/** What a mean of the measure can be: 0 to 1 of shares (unit "1"), else anything. An interval
of Student's t knows no such limits; cut at them it holds the true mean as often. */
Interval FindPossible(const TrialMeasure& measure);
/** What a difference of two such means can be: -1 to 1 of shares. */
Interval FindPossibleDifference(const TrialMeasure& measure);
Interval CutAt(const Interval& possible, const Interval& interval);

MeasureStatistics CalcMeasureStatistics(const TrialMeasure& measure, const MeasureTable& table,
                                        const Hypothesis& hypothesis);

/** The levels of every cell, in the order of ListCells(). */
std::vector<std::vector<std::string>> ListLevels(const std::vector<Factor>& factors);
/** Over the rows with a value. */
Answer<Summary> SummariseRows(const MeasureTable& table);
/** No answer for a study without factors and groups. */
Answer<WithinAnova> CalcAnova(const Answer<CellMeans>& cells);

/** The mean of each condition of a measure with all kinds of error bars, as figures and tables show
them. */
struct ConditionEstimates {
  std::vector<std::string> cells;  ///< as ListCells() orders them
  std::vector<double> means;       ///< over people of their means, else over trials; NaN: no trial
  std::vector<int> num_trials;     ///< with a value
  std::vector<Answer<Eigen::VectorXd>> half_widths;  ///< of each of ListBarKinds()
  /** Of the figure: Loftus and Masson's, whose lengths let conditions be compared by eye; where
  these cannot be, the ones between persons. */
  Answer<Eigen::VectorXd> drawn;
  std::string drawn_kind;                     ///< for the caption: which, or why there are none
  Interval possible = {-INFINITY, INFINITY};  ///< FindPossible

  /** Mean -+ half the drawn length, as far as is possible. @pre `drawn` has a value. */
  Interval drawn_interval(size_t cell) const {
    const double half = (*drawn)[static_cast<Eigen::Index>(cell)];
    return CutAt(possible, {means[cell] - half, means[cell] + half});
  }
};
ConditionEstimates CalcConditionEstimates(const MeasureStatistics& statistics);

/** What others have measured, to stand beside a study's own numbers: an expectation for healthy
adults who reach for things on a table, never a criterion. */
struct StudyResult;

struct PublishedValue {
  const char* measure;   ///< id of TrialMeasureList()
  bool is_slope;         ///< over a factor with numbers, not the measure itself
  const char* unit_end;  ///< of a slope: how the factor's name ends ("_m" of a size, "_kg")
  const char* text;      ///< what was found
  const char* source;
};

const std::vector<PublishedValue>& PublishedValueList();

/** A study's own number for a published one. */
struct ComparedValue {
  const PublishedValue* published = nullptr;
  const TrialMeasure* measure = nullptr;
  Answer<Summary> summary;  ///< of the measure over the included trials
  std::string factor;       ///< of a slope; else empty
  PersonSlopes slopes;      ///< over it, tested against 0
};
/** Those that the study can say something about, in the order of the list. */
std::vector<ComparedValue> ComparePublished(const StudyResult& result);

}  // namespace graspbench
