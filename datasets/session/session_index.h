#pragma once
/** @file
The session as an SQLite database, for questions in SQL: table `trials` (the columns of
trial_table.h) and table `cells` (one row per hand, object and grasp of the plan). Made from plan
and journals; nothing is stored in it alone. */

#include <string>

#include "datasets/session/session_store.h"
#include "datasets/session/trial_table.h"

namespace graspbench {

/** The bytes of the database file; the same session gives the same bytes. */
std::string MakeSessionIndex(const Session& session, const std::vector<TrialColumn>& columns);

}  // namespace graspbench
