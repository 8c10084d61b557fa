#pragma once
/** @file
All tests and estimates as rows of one table, for both statistics.csv and the report. A row names
its assumptions, or why it has no answer. */

#include <cmath>
#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "human_study/study/inference/study_statistics.h"

namespace graspbench {

/** A row of the table. NaN or empty text: not applicable, or no answer. */
struct StatisticRow {
  std::string measure;   ///< id
  std::string analysis;  ///< "paired t test"
  std::string effect;    ///< "diameter_m", "0.06 - 0.03", "slope over diameter_m"
  std::string unit;      ///< of the estimate, SI: "s", "1", "m per diameter_m"
  double estimate = NAN;
  double standard_error = NAN;
  double low = NAN, high = NAN;  ///< of the interval
  double confidence = 0.95;      ///< of the interval
  std::string statistic;         ///< "F", "t", "chi squared", "W"
  double value = NAN;            ///< of the statistic
  double df_1 = NAN, df_2 = NAN;
  double p = NAN;
  double p_holm = NAN;           ///< adjusted over the family of the analysis
  std::string effect_size_name;  ///< "generalised eta squared", "d_z"
  double effect_size = NAN;
  int num_persons = 0;
  std::string note;  ///< assumptions and further information on the answer
};

/** Lists the analysis of variance of every effect without and with both corrections, the mixed
model of all trials, pairs of groups, then Friedman's test. */
std::vector<StatisticRow> ListConditionTests(const MeasureStatistics& statistics);
/** Lists, for every factor with numbers, the persons' slopes and the mixed model. */
std::vector<StatisticRow> ListTrends(const MeasureStatistics& statistics);
/** Lists the reliability between sessions; empty for a study without sessions. */
std::vector<StatisticRow> ListRetest(const MeasureStatistics& statistics);
/** Lists, for every pair of conditions, t test, Wilcoxon test, bootstrap over persons, and
equivalence test. */
std::vector<StatisticRow> ListPairs(const MeasureStatistics& statistics);

/** Lists the ratio of every opening to the aperture by every criterion; p is adjusted over all
rows. */
std::vector<StatisticRow> ListOpenings(const OpeningFamily& family);

/** Lists the comparisons of GFT and GFT% with independent digits, by clock, or the reason for no
answer. */
std::vector<StatisticRow> ListIndependence(const Answer<IndependenceNull>& null);

/** The overall verdicts, one row each for GFT and GFT%. `effect` is the verdict
(kIndependenceVerdicts, or "not testable"). The numbers are those of the strictest clock, and the
interval is the widest of all clocks. The note states the number of trials and what would decide. */
inline constexpr char kIndependenceVerdictAnalysis[] = "independent digits, verdict";
std::vector<StatisticRow> ListIndependenceVerdicts(const Answer<IndependenceNull>& null);

/** Lists all rows of a study. */
std::vector<StatisticRow> ListStatistics(const StudyStatistics& statistics);

std::vector<CsvColumn<StatisticRow>> ListStatisticColumns();

}  // namespace graspbench
