#pragma once
/** @file
Whether grasps match their names (core/trial/measures/grasp_types.h): for each grasp of a hand the
opposition that its name implies, the oppositions found in held trials, and the parts that carried
the load. */

#include <array>
#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "core/base/text/json.h"
#include "core/trial/measures/opposition.h"
#include "datasets/session/session_store.h"

namespace graspbench {

struct TypeSummary {
  std::string hand, grasp;  ///< ids; for by-sight, the grasp that was chosen
  std::string asked;        ///< expected opposition; empty: not a standard grasp, so none
  int num_finished = 0;     ///< trials
  int num_held = 0;         ///< of these; excludes records without opposition
  std::array<int, std::size(kOppositions)> found{};  ///< held trials by opposition
  int num_as_called = 0;                             ///< held trials that match the name
  /** "palm 14 %, TH 44 %": shares of the normal force in the hold, averaged over held trials whose
  grip was regulated by exact touch; empty: there are none. */
  std::string parts;

  double share() const;  ///< num_as_called / num_held; NaN: none expected, or none held
};

/** Lists summaries by hand, then grasp, without numerical failures. */
std::vector<TypeSummary> ListTypeSummaries(const Session& session);

std::vector<CsvColumn<TypeSummary>> ListTypeColumns();
/** Returns an empty text if nothing was held. */
std::string FormatTypeLine(const std::vector<TypeSummary>& types);

}  // namespace graspbench
