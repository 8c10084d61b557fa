#pragma once
/** @file
Every test and estimate of a measure as a row of one table: statistics.csv and the report show the
same rows. A row names its assumptions, or why it has no answer. */

#include <cmath>
#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "human_study/study/inference/study_statistics.h"

namespace graspbench {

/** NaN and empty text: does not apply, or has no answer. */
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
  std::string note;  ///< what it assumes; with it, what else belongs to the answer
};

/** Analysis of variance of every effect without and with both corrections, the mixed model of all
trials, pairs of groups, then Friedman's test. */
std::vector<StatisticRow> ListConditionTests(const MeasureStatistics& statistics);
/** For every factor with numbers: persons' slopes, then the mixed model. */
std::vector<StatisticRow> ListTrends(const MeasureStatistics& statistics);
/** Reliability between sessions; none for a study without them. */
std::vector<StatisticRow> ListRetest(const MeasureStatistics& statistics);
/** For every pair of conditions: t, Wilcoxon, persons drawn, equivalence. */
std::vector<StatisticRow> ListPairs(const MeasureStatistics& statistics);

/** Every opening as a multiple of the aperture, by every criterion; p adjusted over all of them. */
std::vector<StatisticRow> ListOpenings(const OpeningFamily& family);

/** GFT and GFT% against digits that move independently, by every clock, or the reason for none. */
std::vector<StatisticRow> ListIndependence(const Answer<IndependenceNull>& null);

/** What these say together, a row each for GFT and GFT%: `effect` is the verdict
(kIndependenceVerdicts, or "not testable"), the numbers are those of the strictest clock, the
interval is the widest of all clocks, the note counts the trials and says what would decide. */
inline constexpr char kIndependenceVerdictAnalysis[] = "independent digits, verdict";
std::vector<StatisticRow> ListIndependenceVerdicts(const Answer<IndependenceNull>& null);

/** All of a study. */
std::vector<StatisticRow> ListStatistics(const StudyStatistics& statistics);

std::vector<CsvColumn<StatisticRow>> ListStatisticColumns();

}  // namespace graspbench
