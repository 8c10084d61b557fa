#pragma once

#include <string>

namespace graspbench {

/** Text of core/base/text.h for a terminal: no-break spaces become spaces. */
std::string MakePlainText(std::string text);

}  // namespace graspbench
