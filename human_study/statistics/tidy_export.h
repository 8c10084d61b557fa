#pragma once
/** @file
The trials as one tidy table with its data dictionary, and a script that repeats the statistics with
R: for readers who trust only what they have computed themselves.

- tidy.csv: one row per trial and measure: person, trial, the factors, `<factor>_number` for factors
  whose levels are quantities, the groups, the session, measure, value (core/base/text/csv.h; a
  missing value is an empty cell);
- tidy.json: the data dictionary, a Frictionless Table Schema with the list of measures;
- analysis.R: the statistics of a study once more, by R's own means, for readers who trust only what
  they have computed themselves. It reads tidy.csv (and openings.csv, where it is there), repeats the
  rows of statistics.csv, writes them to r_statistics.csv and, where ../statistics.csv lies, says of
  every row how far the two are apart and which it does not repeat. Base R does most; the mixed
  models need lme4 and lmerTest. */

#include <filesystem>
#include <string>
#include <vector>

#include "human_study/statistics/measure_table.h"

namespace graspbench {

/** Of tidy.csv. */
inline constexpr const char* kSessionColumn = "trial_session";

/** @param table  any measure of the study: its factors, groups and sessions. */
std::string FormatRScript(const MeasureTable& table, const std::vector<Hypothesis>& hypotheses);

struct TidyExport {
  std::string csv;
  std::string dictionary;
  std::string r_script;
};

/** Measures of one study, all with the same factors.
@throws Error(kFormat) when their factors differ, a factor's name is that of another column, or a
row has not one level for each factor. */
TidyExport FormatTidyExport(const std::vector<MeasureTable>& measures,
                            const std::vector<Hypothesis>& hypotheses = {});

/** Writes the three files. @throws Error(kIo), and as above. */
void SaveTidyExport(const std::vector<MeasureTable>& measures, const std::filesystem::path& folder,
                    const std::vector<Hypothesis>& hypotheses = {});

}  // namespace graspbench
