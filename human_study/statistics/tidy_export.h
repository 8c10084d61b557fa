#pragma once
/** @file
Exports the trials as one tidy table with a data dictionary, and an R script that repeats the
statistics, so that readers can check them independently.

- tidy.csv: one row per trial and measure: person, trial, the factors, `<factor>_number` for factors
  whose levels are quantities, the groups, the session, measure, value (core/base/text/csv.h; a
  missing value is an empty cell);
- tidy.json: the data dictionary, a Frictionless Table Schema with the list of measures;
- analysis.R: the statistics of the study computed with R. It reads tidy.csv (and openings.csv, if
  present), repeats the rows of statistics.csv and writes them to r_statistics.csv. If
  ../statistics.csv exists, it reports the difference of every row, and the rows that it does not
  repeat. Most of it needs only base R; the mixed models need lme4 and lmerTest. */

#include <filesystem>
#include <string>
#include <vector>

#include "human_study/statistics/measure_table.h"

namespace graspbench {

/** Name of the session column in tidy.csv. */
inline constexpr const char* kSessionColumn = "trial_session";

/** @param table  any measure of the study; only its factors, groups and sessions are used. */
std::string FormatRScript(const MeasureTable& table, const std::vector<Hypothesis>& hypotheses);

struct TidyExport {
  std::string csv;
  std::string dictionary;
  std::string r_script;
};

/** Formats the measures of one study, all with the same factors.
@throws Error(kFormat) when their factors differ, a factor's name is that of another column, or a
row does not have one level per factor. */
TidyExport FormatTidyExport(const std::vector<MeasureTable>& measures,
                            const std::vector<Hypothesis>& hypotheses = {});

/** Writes the three files. @throws Error(kIo), and as above. */
void SaveTidyExport(const std::vector<MeasureTable>& measures, const std::filesystem::path& folder,
                    const std::vector<Hypothesis>& hypotheses = {});

}  // namespace graspbench
