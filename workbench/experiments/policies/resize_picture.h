#pragma once
/** @file
Resizes images as policy servers expect them: the whole image, centred on a black one. The filter is
a triangle as wide as a pixel of the smaller image, applied to columns first, in integer arithmetic.
It equals PIL's BILINEAR, which openpi's clients use, to the byte. */

#include <cstddef>
#include <cstdint>
#include <vector>

namespace graspbench {

struct BytePicture {
  size_t height = 0, width = 0;
  std::vector<uint8_t> rgb;  ///< height x width x 3
};

/** @pre no size is 0. */
BytePicture ResizeWithPadding(const BytePicture& picture, size_t height, size_t width);

}  // namespace graspbench
