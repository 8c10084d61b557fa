#pragma once
/** @file
How much of the key light and of the sky each point of the table sees, from what both lights see of
the things on it: percentage-closer soft shadows (Fernando 2005). A filter looks for what is in the
way, and the filter of the shadow grows with its height above the table.

Beside OpenGL, because Mesa takes 0.12 s to compile it as a shader and as long as this to run it. */

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/render/stage.h"

namespace graspbench {

/** What a light sees: depth from 0 to 1 over its box, 1 where there is nothing; rows from y = 0. */
struct LightMap {
  StageLight light;
  int size = 0;              ///< of a side [texel]
  std::vector<float> depth;  ///< (size x size)
};

/** Shares of the key light and of the sky, 0 to 255, side by side for each of (size x size) texels
over `area` (FindShadowArea); rows from the area's corner. */
std::vector<uint8_t> CalcTableLight(const LightMap& key, const LightMap& sky,
                                    const Eigen::Vector4d& area, int size);

}  // namespace graspbench
