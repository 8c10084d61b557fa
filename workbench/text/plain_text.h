#pragma once
/** @file
Text as a terminal shows it. */

#include <string>

namespace graspbench {

/** Text of core/base/text/text.h for a terminal: no-break spaces become spaces. */
std::string MakePlainText(std::string text);

}  // namespace graspbench
