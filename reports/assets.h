#pragma once
/** @file Files of reports/assets, compiled into the program (reports/CMakeLists.txt). */

#include <string_view>

namespace graspbench::assets {

extern const std::string_view kPage;   ///< page.mustache
extern const std::string_view kStyle;  ///< style.css
/** benchmark_sensitivity.json: what `graspbench sensitivity --json` prints of the benchmark. */
extern const std::string_view kBenchmarkSensitivity;

}  // namespace graspbench::assets
