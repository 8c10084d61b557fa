#pragma once
/** @file
One sample a pixel has steps at edges. Where the corners of a pixel differ, their gradient says how
the edge runs, and the mean along it smooths the steps (after Lottes, "FXAA", 2009); a quarter of
every pixel is the mean of its corners. Beside OpenGL, because Mesa takes 90 ms to compile it as a
shader and twice the time of this to run it. */

#include "core/render/scene.h"

namespace graspbench {

Image SmoothEdges(const Image& rough);

}  // namespace graspbench
