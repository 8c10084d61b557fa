#pragma once
/** @file
A trial that was simulated again against its record. */

#include <optional>
#include <string>

#include "datasets/records/trial_record.h"

namespace graspbench {

struct FieldDifference {
  std::string field;          ///< "contacts/2/time_s"
  std::string recorded, now;  ///< as JSON; "missing" where there is no such field
};

/** The first field of the record that is not the same to the last bit; unset: all are. */
[[nodiscard]] std::optional<FieldDifference> FindFirstDifference(const TrialResult& recorded,
                                                                 const TrialResult& now);

/** The same of the whole record; what decides the trial comes before its result. */
[[nodiscard]] std::optional<FieldDifference> FindFirstDifference(const TrialRecord& recorded,
                                                                 const TrialRecord& now);

}  // namespace graspbench
