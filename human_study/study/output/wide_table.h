#pragma once
/** @file
A study's persons as rows, for jamovi, JASP and SPSS, whose repeated-measures analyses want a column
a condition: wide.csv with its dictionary wide.schema.json.

A cell is the mean of the person's trials that count, in SI units; empty without any. Columns are
`<measure>_<levels>` for the measures that the study tests, and num_trials_<levels>. Names are what
SPSS takes: letters, digits and underscores, at most 64, unlike in any case; the dictionary says
which condition each is. */

#include <filesystem>
#include <string>
#include <vector>

namespace graspbench {

struct StudyResult;

/** The names of columns, in order: `text` with everything but ASCII letters and digits as
underscores, cut, and numbered where two would be alike. */
std::vector<std::string> MakeColumnNames(const std::vector<std::string>& texts);

/** @throws Error(kIo). */
void WriteWideTable(const StudyResult& result, const std::filesystem::path& folder);

}  // namespace graspbench
