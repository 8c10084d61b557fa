#pragma once
/** @file
The table of trials, one row per finished trial: one list of columns, from which the CSV file, its
data dictionary and the SQLite index are made. */

#include <functional>
#include <string>
#include <vector>

#include "datasets/trial_record.h"

namespace graspbench {

struct TrialColumn {
  std::string name;                               ///< with the unit as suffix: "gct_s"
  std::string type;                               ///< "string", "integer", "number" or "boolean"
  std::string unit;                               ///< "s", "m", ...; empty: none
  std::string meaning;                            ///< one sentence
  std::function<Json(const TrialRecord&)> value;  ///< null: missing; a boolean is 0 or 1
};

/** All columns in order. Those of first contacts follow the digits TH FF MF RF LF, which are always
there, then any other digits of the records by name. */
std::vector<TrialColumn> ListTrialColumns(const std::vector<TrialRecord>& records);

/** RFC 4180 with line feeds; missing = empty, numbers shortest-exact. */
std::string FormatTrialsCsv(const std::vector<TrialColumn>& columns,
                            const std::vector<TrialRecord>& records);

/** The data dictionary in the form of a Frictionless Table Schema, plus each column's unit. */
Json MakeTrialsSchema(const std::vector<TrialColumn>& columns);

}  // namespace graspbench
