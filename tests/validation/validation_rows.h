#pragma once
/** @file
What is measured of this program, as data: the rows of workbench/manual/validation, how they are
checked, and how a benchmark writes its own. Their README says how a person adds one.

    topic: Contact quality
    rows:
      - claim: epsilon of 10 contacts with 8 edges, processor time
        figure: 0.17 ms
        interval: none
        bar: at most 3 ms
        met: yes
        command: build/release/tests/bench/quality_bench
        physics_version: none
        program_version: 0.1.0
        date: 2026-11-22
        machine: 2 cores, AMD EPYC

Every field is needed. */

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/error.h"

namespace graspbench {

/** As they stand in the file. */
struct ValidationRow {
  std::string claim;            ///< what is measured, and under which conditions
  std::string figure;           ///< with its unit
  std::string interval;         ///< how sure it is; "none"
  std::string bar;              ///< what was wanted; "none"
  std::string met;              ///< "yes", "no"; "none" where there is no bar
  std::string command;          ///< that measures it again
  std::string physics_version;  ///< kPhysicsVersion; "none": does not depend on it; or kNotRecorded
  std::string program_version;  ///< "0.1.0", or kNotRecorded
  std::string date;             ///< "2026-11-22", or kNotRecorded
  std::string machine;          ///< cores and processor
  int row = 0;                  ///< of the README's table that these files have replaced; 0: none
  std::string topic;            ///< of its file
};

inline constexpr const char* kNoneRecorded = "none";
inline constexpr const char* kNotRecorded = "not recorded";
/** Of all fields of a row together. */
inline constexpr int kMostValidationWords = 60;

/** The rows of one file. Faults go into `problems` with `file` and line. */
std::vector<ValidationRow> ParseValidationRows(const std::string& text, const std::string& file,
                                               Diagnostics& problems);

/** The rows of all files *.yaml of a folder, by name of the file. A claim that stands twice is a
fault, too. */
std::vector<ValidationRow> LoadValidationRows(const std::filesystem::path& folder,
                                              Diagnostics& problems);

/** As ParseValidationRows reads them. @pre the rows have one topic. */
std::string FormatValidationRows(const std::vector<ValidationRow>& rows);

/** Writes a benchmark's rows into a file: in the place of rows with the same claim, behind the
others, or as a new file. Comments in the file are lost.
@throws Error(kFormat) for a file with faults, or rows that would be one. */
void UpdateValidationFile(const std::filesystem::path& path,
                          const std::vector<ValidationRow>& measured);

/** Today (UTC), this program and this machine, as a benchmark's row names them.
@param physics  whether the figure depends on the physics. */
ValidationRow MakeValidationRow(const std::string& topic, bool physics);

}  // namespace graspbench
