#pragma once
/** @file
Files beside this one, compiled into the maker of the manual (workbench/CMakeLists.txt). */

#include <string_view>

namespace graspbench::assets {

extern const std::string_view kManualCss;
extern const std::string_view kManualSearchJs;

}  // namespace graspbench::assets
