#pragma once
/** @file
The table of trials, one row per finished trial: one list of columns, from which the CSV file, its
data dictionary and the SQLite index are made. */

#include <vector>

#include "core/base/text/csv.h"
#include "core/quality/grasp_quality.h"
#include "datasets/records/trial_record.h"

namespace graspbench {

using TrialColumn = CsvColumn<TrialRecord>;

/** Name of the column of a convention's epsilon: "epsilon_dex_net". */
std::string NameEpsilonColumn(const QualityConvention& convention);

/** All columns in order; their values are those of whole records. Those of first contacts follow the
digits TH FF MF RF LF, which are always there, then any other digits of the records by name.
@param config  of the session, from which the drawn places of the object follow. */
std::vector<TrialColumn> ListTrialColumns(const std::vector<TrialRecord>& records,
                                          const SessionConfig& config = {});

/** A contact event with the trial it belongs to. */
struct EventRow {
  const TrialRecord* record = nullptr;
  const ContactEvent* event = nullptr;
  int rank = 0;  ///< in the order of contact, on a grasping digit's first touch; else 0
};
/** The events of a whole record, which must outlive them, and the columns of `events.csv`. */
std::vector<EventRow> ListEvents(const TrialRecord& record);
std::vector<CsvColumn<EventRow>> ListEventColumns();

}  // namespace graspbench
