#pragma once
/** @file
Everything a reader must know before trusting the numbers, as sentences. */

#include <string>
#include <vector>

#include "reports/sections/section.h"

namespace graspbench {

/** Errors first: missing trials, damaged journal lines of an unfinished session, numerical
failures, contacts before the start of closure, models and pictures that are missing. Empty for a
flawless session. */
std::vector<std::string> ListFindings(const ReportData& data);

}  // namespace graspbench
