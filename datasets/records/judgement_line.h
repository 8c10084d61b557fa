#pragma once
/** @file
A judgement of one trial's held grasp as a line of a journal. */

#include <string>
#include <string_view>

#include "core/trial/judge/judgement.h"

namespace graspbench {

/** Without the line break. */
std::string FormatJudgementLine(const std::string& trial_id, const Judgement& judgement);
/** @throws Error(kFormat) saying what is wrong with the line. */
Judgement ParseJudgementLine(std::string_view line);

}  // namespace graspbench
