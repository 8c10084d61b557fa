#pragma once
/** @file
The trials as one tidy table with its data dictionary, and a script that repeats the statistics with
R: for readers who trust only what they have computed themselves.

- tidy.csv: one row per trial and measure: person, trial, the factors, `<factor>_number` for factors
  whose levels are quantities, the groups, the session, measure, value (core/base/text/csv.h; a
  missing value is an empty cell);
- tidy.json: the data dictionary, a Frictionless Table Schema with the list of measures;
- analysis.R: r_script.h. */

#include <filesystem>
#include <string>
#include <vector>

#include "human_study/statistics/measure_table.h"
#include "human_study/statistics/r_script.h"

namespace graspbench {

struct TidyExport {
  std::string csv;
  std::string dictionary;
  std::string r_script;
};

/** Measures of one study, all with the same factors.
@throws Error(kFormat) when their factors differ, a factor's name is that of another column, or a
row has not one level for each factor. */
TidyExport FormatTidyExport(const std::vector<MeasureTable>& measures,
                            const std::vector<ScriptHypothesis>& hypotheses = {});

/** Writes the three files. @throws Error(kIo), and as above. */
void SaveTidyExport(const std::vector<MeasureTable>& measures, const std::filesystem::path& folder,
                    const std::vector<ScriptHypothesis>& hypotheses = {});

}  // namespace graspbench
