#include "core/vision/camera_config.h"

#include <cstddef>

namespace graspbench {

std::optional<Eigen::Vector3f> ParseColour(const std::string& text) {
  if (text.size() != 7 || text[0] != '#' ||
      text.find_first_not_of("0123456789abcdefABCDEF", 1) != text.npos) {
    return std::nullopt;
  }
  Eigen::Vector3f colour;
  for (size_t i = 0; i < 3; ++i) {
    colour[static_cast<Eigen::Index>(i)] =
        static_cast<float>(std::stoi(text.substr(1 + 2 * i, 2), nullptr, 16)) / 255.0f;
  }
  return colour;
}

}  // namespace graspbench
