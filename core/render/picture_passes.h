#pragma once
/** @file
Passes over whole pictures: the light on the table, and anti-aliasing. They run outside OpenGL,
because Mesa takes about 0.1 s to compile each as a shader, which then runs more slowly than
this. */

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/render/stage.h"

namespace graspbench {

/** View of a light: depth from 0 to 1 over its box, 1 where it is empty; rows from y = 0. */
struct LightMap {
  StageLight light;
  int size = 0;              ///< side length [texel]
  std::vector<float> depth;  ///< (size x size)
};

/** Computes the shares of the key light and of the sky that reach each point of the table, from the
depth maps of both lights. The method is percentage-closer soft shadows (Fernando 2005): a first
filter searches for occluders, and the shadow's filter grows with their height above the table.

@returns shares of the key light and of the sky, 0 to 255, side by side for each of (size x size)
texels over `area` (FindShadowArea); rows from the area's corner. */
std::vector<uint8_t> CalcTableLight(const LightMap& key, const LightMap& sky,
                                    const Eigen::Vector4d& area, int size);

/** Smooths the steps that one sample per pixel leaves at edges (after Lottes, "FXAA", 2009). Where
the corners of a pixel differ, their gradient gives the direction of the edge, and the mean along it
smooths the steps. A quarter of every pixel is the mean of its corners. */
Image SmoothEdges(const Image& rough);

}  // namespace graspbench
