#pragma once
/** @file
The table of trials, with one row per finished trial. The CSV file, its data dictionary and the
SQLite index are made from one list of columns. */

#include <vector>

#include "core/base/text/csv.h"
#include "core/quality/grasp_quality.h"
#include "datasets/records/trial_record.h"

namespace graspbench {

using TrialColumn = CsvColumn<TrialRecord>;

/** Returns the column name of a convention's epsilon: "epsilon_dex_net". */
std::string NameEpsilonColumn(const QualityConvention& convention);

/** Lists all columns in order. Their values need complete records. First contacts have columns for
the digits TH FF MF RF LF, which are always present, then for other digits of the records by name.
@param config  of the session, which determines the drawn poses of the object. */
std::vector<TrialColumn> ListTrialColumns(const std::vector<TrialRecord>& records,
                                          const SessionConfig& config = {});

/** A contact event with the trial it belongs to. */
struct EventRow {
  const TrialRecord* record = nullptr;
  const ContactEvent* event = nullptr;
  int rank = 0;  ///< rank in the contact order for a grasping digit's first contact; else 0
};
/** List the events of a complete record, which must outlive them, and the columns of
`events.csv`. */
std::vector<EventRow> ListEvents(const TrialRecord& record);
std::vector<CsvColumn<EventRow>> ListEventColumns();

}  // namespace graspbench
