#pragma once
/** @file
What reads whole pictures: the light on the table, and smooth edges. Beside OpenGL, because Mesa
takes about 0.1 s to compile each as a shader and longer than this to run it. */

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

/** How much of the key light and of the sky each point of the table sees, from what both lights see
of the things on it: percentage-closer soft shadows (Fernando 2005). A filter looks for what is in
the way, and the filter of the shadow grows with its height above the table.

@returns shares of the key light and of the sky, 0 to 255, side by side for each of (size x size)
texels over `area` (FindShadowArea); rows from the area's corner. */
std::vector<uint8_t> CalcTableLight(const LightMap& key, const LightMap& sky,
                                    const Eigen::Vector4d& area, int size);

/** One sample a pixel has steps at edges. Where the corners of a pixel differ, their gradient says
how the edge runs, and the mean along it smooths the steps (after Lottes, "FXAA", 2009); a quarter
of every pixel is the mean of its corners. */
Image SmoothEdges(const Image& rough);

}  // namespace graspbench
