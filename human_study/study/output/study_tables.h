#pragma once
/** @file
A study's results as tables for other programs:

    trials.csv    every planned trial: its location, and whether or why it was removed
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
  bool is_believed = true;  ///< the event from which the measures are computed
};

/** Lists events in the order of a reach; none for a trial that was not analysed. They point to
`trial`. */
std::vector<StudyEvent> ListEvents(const StudyTrial& trial, const StudyConfig& config);

/** Formats one row per included trial and measure of hand opening, also without each digit, as
input of the R script's comparison of openings. */
std::string FormatOpeningTable(const StudyResult& result);

/** Writes the tables and their dictionaries. Equal results give equal bytes. @throws Error(kIo). */
void WriteStudyTables(const StudyResult& result, const std::filesystem::path& folder);

/** Makes file name and data dictionary of each of these tables and of the openings, with a column
for each factor, group and digit of the result. */
std::vector<std::pair<std::string, Json>> MakeStudySchemas(const StudyResult& result);

/** Makes the column names of wide.csv, in order: all characters but ASCII letters and digits become
underscores; long names are cut, and duplicates numbered. */
std::vector<std::string> MakeColumnNames(const std::vector<std::string>& texts);

/** Writes a study with persons as rows, for jamovi, JASP and SPSS, whose repeated-measures analyses
need one column per condition: wide.csv with its dictionary wide.schema.json.

A cell is the mean of the person's included trials, in SI units; empty without any. Columns are
`<measure>_<levels>` for the measures that the study tests, and num_trials_<levels>. Names are valid
in SPSS: at most 64 letters, digits and underscores, unique regardless of case. The dictionary
states each column's condition.
@throws Error(kIo). */
void WriteWideTable(const StudyResult& result, const std::filesystem::path& folder);
/** The data dictionary of wide.csv. */
Json MakeWideSchema(const StudyResult& result);

}  // namespace graspbench
