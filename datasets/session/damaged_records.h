#pragma once
/** @file
What lines that fail their checksum still say. Its integrity cannot be verified: it is for a
comparison with the trial run again, which names what has changed, and for nothing else. */

#include <vector>

#include "datasets/session/session_store.h"

namespace graspbench {

/** The records in the damaged lines of the session's journals whose trials are in the plan and have
no whole line, in the plan's order. A line that is no record any more is left out.
@pre the session was loaded in spite of its damage. @throws Error(kIo). */
std::vector<TrialRecord> ReadDamagedRecords(const Session& session);

}  // namespace graspbench
