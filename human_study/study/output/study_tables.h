#pragma once
/** @file
A study's results as tables, for any other program:

    trials.csv    every trial of the plan: where it is, whether it counts and why not
    events.csv    every event of every analysed trial, by each detector, with its uncertainty
    measures.csv  one row per included trial: all measures, openings and the contact order
    statistics.csv  every test and estimate of the measures (statistics_table.h)

Each has a data dictionary beside it, `<name>.schema.json` (Frictionless Table Schema). */

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/base/text/csv.h"
#include "human_study/study/run/run_study.h"

namespace graspbench {

/** One event of one trial; `detector` and `digit` are empty where they do not apply. */
struct StudyEvent {
  const StudyTrial* trial = nullptr;
  std::string name;  ///< "movement_onset", "contact", ..
  std::string digit;
  std::string detector;
  EventTime event;
  bool is_believed = true;  ///< the one the measures rest on
};

/** In the order of a reach; none for a trial that was not analysed. They point to `trial`. */
std::vector<StudyEvent> ListEvents(const StudyTrial& trial, const StudyConfig& config);

/** One row per included trial and measure of hand opening, also without each digit: what the R
script compares the openings with. */
std::string FormatOpeningTable(const StudyResult& result);

/** Writes the tables and their dictionaries. Same result, same bytes. @throws Error(kIo). */
void WriteStudyTables(const StudyResult& result, const std::filesystem::path& folder);

/** File and data dictionary of each of these tables and of the openings, with a column for each
factor, group and digit of the result. */
std::vector<std::pair<std::string, Json>> MakeStudySchemas(const StudyResult& result);

/** The names of columns of wide.csv, in order: `text` with everything but ASCII letters and digits
as underscores, cut, and numbered where two would be alike. */
std::vector<std::string> MakeColumnNames(const std::vector<std::string>& texts);

/** A study's persons as rows, for jamovi, JASP and SPSS, whose repeated-measures analyses want a
column a condition: wide.csv with its dictionary wide.schema.json.

A cell is the mean of the person's included trials, in SI units; empty without any. Columns are
`<measure>_<levels>` for the measures that the study tests, and num_trials_<levels>. Names are what
SPSS takes: letters, digits and underscores, at most 64, unlike in any case; the dictionary says
which condition each is.
@throws Error(kIo). */
void WriteWideTable(const StudyResult& result, const std::filesystem::path& folder);
/** The data dictionary of wide.csv. */
Json MakeWideSchema(const StudyResult& result);

}  // namespace graspbench
