#pragma once
/** @file
Files in this folder that are compiled into the manual generator (workbench/CMakeLists.txt). */

#include <string_view>

namespace graspbench::assets {

extern const std::string_view kManualCss;
extern const std::string_view kManualSearchJs;

}  // namespace graspbench::assets
