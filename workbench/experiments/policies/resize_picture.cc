#include "workbench/experiments/policies/resize_picture.h"

#include <algorithm>
#include <cmath>

namespace graspbench {
namespace {

constexpr int kBits = 22;  // of PIL's weights

/** What one place of the result takes of the source. */
struct Share {
  size_t first;
  std::vector<int> weights;  // their sum is 2^kBits, but for rounding
};

std::vector<Share> CalcShares(size_t from, size_t to) {
  const double scale = static_cast<double>(from) / static_cast<double>(to);
  const double reach = std::max(scale, 1.0);
  std::vector<Share> shares(to);
  for (size_t i = 0; i < to; ++i) {
    const double centre = (static_cast<double>(i) + 0.5) * scale;
    const auto first = static_cast<size_t>(std::max(centre - reach + 0.5, 0.0));
    const auto end = std::min(static_cast<size_t>(centre + reach + 0.5), from);
    std::vector<double> weights;
    double sum = 0.0;
    for (size_t k = first; k < end; ++k) {
      const double distance = std::abs(static_cast<double>(k) + 0.5 - centre) / reach;
      weights.push_back(std::max(0.0, 1.0 - distance));
      sum += weights.back();
    }
    shares[i].first = first;
    for (const double weight : weights) {
      shares[i].weights.push_back(static_cast<int>(weight / sum * (1 << kBits) + 0.5));
    }
  }
  return shares;
}

/** Of numbers that stand `stride` apart. */
uint8_t CalcSum(const Share& share, const uint8_t* start, size_t stride) {
  int sum = 1 << (kBits - 1);
  for (size_t k = 0; k < share.weights.size(); ++k) {
    sum += share.weights[k] * start[(share.first + k) * stride];
  }
  return static_cast<uint8_t>(std::clamp(sum >> kBits, 0, 255));
}

BytePicture Resize(const BytePicture& picture, size_t height, size_t width) {
  const std::vector<Share> columns = CalcShares(picture.width, width);
  const std::vector<Share> rows = CalcShares(picture.height, height);
  BytePicture narrow = {picture.height, width, {}};
  for (size_t row = 0; row < picture.height; ++row) {
    for (const Share& share : columns) {
      for (size_t colour = 0; colour < 3; ++colour) {
        narrow.rgb.push_back(CalcSum(share, &picture.rgb[3 * row * picture.width + colour], 3));
      }
    }
  }
  BytePicture result = {height, width, {}};
  for (const Share& share : rows) {
    for (size_t i = 0; i < 3 * width; ++i) {
      result.rgb.push_back(CalcSum(share, &narrow.rgb[i], 3 * width));
    }
  }
  return result;
}

}  // namespace

BytePicture ResizeWithPadding(const BytePicture& picture, size_t height, size_t width) {
  if (picture.height == height && picture.width == width) return picture;
  const double ratio = std::max(static_cast<double>(picture.width) / static_cast<double>(width),
                                static_cast<double>(picture.height) / static_cast<double>(height));
  const auto shrink = [ratio](size_t size) {
    return std::max(static_cast<size_t>(static_cast<double>(size) / ratio), size_t{1});
  };
  const BytePicture inner = Resize(picture, shrink(picture.height), shrink(picture.width));
  BytePicture result = {height, width, std::vector<uint8_t>(3 * height * width)};
  const size_t top = (height - inner.height) / 2, left = (width - inner.width) / 2;
  for (size_t row = 0; row < inner.height; ++row) {
    std::copy_n(&inner.rgb[3 * row * inner.width], 3 * inner.width,
                &result.rgb[3 * ((top + row) * width + left)]);
  }
  return result;
}

}  // namespace graspbench
