#pragma once
/** @file
Files of human_study/statistics/assets, compiled into the program (graspbench_embed). */

#include <string_view>

namespace graspbench::assets {

extern const std::string_view kAnalysisR;  ///< analysis.R without the study's column names

}  // namespace graspbench::assets
