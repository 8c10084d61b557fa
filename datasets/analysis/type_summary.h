#pragma once
/** @file
Whether grasps are what they are called (core/trial/measures/grasp_types.h): of a hand's grasp the
opposition that its name asks for, the oppositions found in what it held, and the parts that bore. */

#include <array>
#include <string>
#include <vector>

#include "core/base/text/csv.h"
#include "core/base/text/json.h"
#include "core/trial/measures/opposition.h"
#include "datasets/session/session_store.h"

namespace graspbench {

struct TypeSummary {
  std::string hand, grasp;  ///< ids; of a choice by sight the grasp that was chosen
  std::string asked;        ///< opposition; empty: no standard grasp, so that none is asked for
  int num_finished = 0;     ///< trials
  int num_held = 0;         ///< of these; a record without opposition is not held
  std::array<int, std::size(kOppositions)> found{};  ///< of the held, by opposition
  int num_as_called = 0;                             ///< of the held
  /** "palm 14 %, TH 44 %": shares of the normal force in the hold, mean of the held trials whose
  grip was regulated by exact touch; empty: none was. */
  std::string parts;

  double share() const;  ///< as called, of the held; NaN: nothing is asked for, or nothing held
};

/** By hand, then grasp. Numerical failures are left out. */
std::vector<TypeSummary> ListTypeSummaries(const Session& session);

std::vector<CsvColumn<TypeSummary>> ListTypeColumns();
/** Empty where nothing was held. */
std::string FormatTypeLine(const std::vector<TypeSummary>& types);

}  // namespace graspbench
