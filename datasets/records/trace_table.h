#pragma once
/** @file
The trace of a trial as a table, one row per instant. */

#include <vector>

#include "core/base/text/csv.h"
#include "core/trial/trial_trace.h"

namespace graspbench {

/** Lists the columns: time and phase, poses of hand and object, every joint, and for every digit
and the palm its normal force and its use of the friction cone.
@param hand  of the trace; must outlive the columns. */
std::vector<CsvColumn<TraceInstant>> ListTraceColumns(const Hand& hand);

/** Sum of the normal forces of a digit on the object, or of the palm if `digit` is -1 [N]. */
double CalcDigitForce(const Hand& hand, const TraceInstant& instant, int digit);

}  // namespace graspbench
