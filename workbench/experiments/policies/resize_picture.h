#pragma once
/** @file
Pictures of another size, as policy servers expect them: the whole picture in the middle of a black
one. The filter is a triangle as wide as a pixel of the smaller picture, columns first, with whole
numbers: that of PIL's BILINEAR, which openpi's clients use, to the byte. */

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
