#pragma once
/** @file
The page of grasps that others made and profiles have judged: success under each profile, agreement
with the files' own verdicts, transitions, failures with their reasons, what was nearest the
border. */

#include <string>
#include <vector>

#include "datasets/judged_grasps/judged_summary.h"

namespace graspbench {

/** A self-contained page like the session's report.
@param config  frozen, of the store.   @param judged  what the summary is of. */
std::string MakeGraspsPage(const Json& config, const std::vector<JudgedGrasp>& judged,
                           const JudgedSummary& summary);

}  // namespace graspbench
