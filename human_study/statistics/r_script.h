#pragma once
/** @file
analysis.R: the statistics of a study once more, by R's own means, for readers who trust only what
they have computed themselves.

It reads tidy.csv (and openings.csv, where it is there), repeats the rows of statistics.csv, writes
them to r_statistics.csv and, where ../statistics.csv lies, says of every row how far the two are
apart and which it does not repeat. Base R does most; the mixed models need lme4 and lmerTest. */

#include <cmath>
#include <string>
#include <vector>

#include "human_study/statistics/measure_table.h"

namespace graspbench {

/** What a measure is tested against, beside zero. */
struct ScriptHypothesis {
  std::string measure;
  double slope = 0.0;
  double equal_within = NAN;  ///< NaN: equivalence is not tested
};

/** Of tidy.csv. */
inline constexpr const char* kSessionColumn = "trial_session";

/** @param table  any measure of the study: its factors, groups and sessions. */
std::string FormatRScript(const MeasureTable& table,
                          const std::vector<ScriptHypothesis>& hypotheses);

}  // namespace graspbench
