#pragma once
/** @file
The course of a trial as a table, one row an instant. */

#include <vector>

#include "core/base/text/csv.h"
#include "core/trial/trial_trace.h"

namespace graspbench {

/** Time and phase, poses of hand and object, every joint, and of every digit and the palm what it
presses with and how much of its friction cone it uses.
@param hand  whose trace it is; outlives the columns. */
std::vector<CsvColumn<TraceInstant>> ListTraceColumns(const Hand& hand);

/** Sum of the normal forces of a digit on the object, of the palm where digit is -1 [N]. */
double CalcDigitForce(const Hand& hand, const TraceInstant& instant, int digit);

}  // namespace graspbench
