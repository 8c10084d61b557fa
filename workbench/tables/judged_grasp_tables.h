#pragma once
/** @file
What judged grasps say, a line a profile, for people and as JSON. */

#include <string>

#include "core/base/text/json.h"
#include "datasets/judged_grasps/judged_summary.h"

namespace graspbench {

std::string FormatJudged(const JudgedSummary& summary);
Json MakeJson(const JudgedSummary& summary);

}  // namespace graspbench
