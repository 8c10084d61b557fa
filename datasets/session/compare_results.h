#pragma once
/** @file
A trial that was simulated again against its record. */

#include <optional>
#include <string>

#include "core/trial/trial_result.h"

namespace graspbench {

struct FieldDifference {
  std::string field;          ///< "contacts/2/time_s"
  std::string recorded, now;  ///< as JSON; "missing" where there is no such field
};

/** The first field of the record that is not the same to the last bit; unset: all are. */
std::optional<FieldDifference> FindFirstDifference(const TrialResult& recorded,
                                                   const TrialResult& now);

}  // namespace graspbench
