#include "core/render/picture_passes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/units.h"

namespace graspbench {
namespace {

using Eigen::Vector2d;
using Eigen::Vector2f;
using Eigen::Vector3f;

constexpr int kTaps = 8;
/** Of a square of so many neighbours each turns its disc by another sixteenth; their mean has all of
these taps and no pattern. */
constexpr int kTurns = 4;
constexpr double kGoldenAngle = 2.399963;
constexpr float kSharpest = 0.0015f;  // radius of a shadow's filter [m]

using Disc = std::array<Vector2f, kTaps>;

/** Points of a sunflower, which cover the unit disc evenly. */
Disc MakeDisc(double turn) {
  Disc disc;
  for (int i = 0; i < kTaps; ++i) {
    const double angle = kGoldenAngle * i + turn, radius = std::sqrt((i + 0.5) / kTaps);
    disc[i] = (radius * Vector2d(std::cos(angle), std::sin(angle))).cast<float>();
  }
  return disc;
}

std::array<Disc, kTurns * kTurns> MakeDiscs() {
  std::array<Disc, kTurns * kTurns> discs;
  for (int i = 0; i < kTurns * kTurns; ++i) discs[i] = MakeDisc(2.0 * kPi / (kTurns * kTurns) * i);
  return discs;
}

/** How wide a light is. */
struct Softness {
  float spread;         ///< tangent of its angular size
  float search_radius;  ///< in which something may be in its way [m]
};

class ShadowFilter {
 public:
  ShadowFilter(const LightMap& map, const Softness& softness)
      : map_(map),
        softness_(softness),
        last_(map.size - 1),
        texels_per_metre_((map.size * map.light.extent.head<2>().cwiseInverse()).cast<float>()) {}

  /** Share of the light that reaches a point. */
  float CalcVisibility(const Eigen::Vector3d& p_S, const Disc& disc) const {
    const Eigen::Vector4d in_map = map_.light.map_from_S * p_S.homogeneous();
    const Vector2f centre = (map_.size * in_map.head<2>()).cast<float>();
    const float depth = static_cast<float>(std::clamp(in_map.z(), 0.0, 1.0));
    float blockers = 0.0f;
    int num_blockers = 0;
    for (const Vector2f& tap : disc) {
      const Vector2f p = centre + softness_.search_radius * tap.cwiseProduct(texels_per_metre_);
      const float blocker =
          Find(static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y())));
      if (blocker >= depth) continue;
      blockers += blocker;
      ++num_blockers;
    }
    if (num_blockers == 0) return 1.0f;
    const float gap =
        (static_cast<float>(in_map.z()) - blockers / static_cast<float>(num_blockers)) *
        static_cast<float>(map_.light.extent.z());
    const float radius = std::clamp(gap * softness_.spread, kSharpest, softness_.search_radius);
    float sum = 0.0f;
    for (const Vector2f& tap : disc) {
      sum += Compare(centre + radius * tap.cwiseProduct(texels_per_metre_), depth);
    }
    return sum / static_cast<float>(kTaps);
  }

 private:
  float Find(int x, int y) const {
    return map_
        .depth[static_cast<size_t>(std::clamp(y, 0, last_)) * map_.size + std::clamp(x, 0, last_)];
  }
  /** Share of the four texels around a point that nothing nearer to the light covers. */
  float Compare(const Vector2f& p, float depth) const {
    const float x = p.x() - 0.5f, y = p.y() - 0.5f;
    const float left = std::floor(x), lower = std::floor(y);
    const float u = x - left, v = y - lower;
    const int x0 = static_cast<int>(left), y0 = static_cast<int>(lower);
    const auto is_lit = [&](int column, int row) {
      return Find(column, row) >= depth ? 1.0f : 0.0f;
    };
    return (1.0f - v) * ((1.0f - u) * is_lit(x0, y0) + u * is_lit(x0 + 1, y0)) +
           v * ((1.0f - u) * is_lit(x0, y0 + 1) + u * is_lit(x0 + 1, y0 + 1));
  }

  const LightMap& map_;
  Softness softness_;
  int last_;
  Vector2f texels_per_metre_;
};

}  // namespace

std::vector<uint8_t> CalcTableLight(const LightMap& key, const LightMap& sky,
                                    const Eigen::Vector4d& area, int size) {
  static const std::array<Disc, kTurns* kTurns> discs = MakeDiscs();
  const ShadowFilter key_filter(key, {0.13f, 0.03f}), sky_filter(sky, {0.8f, 0.06f});
  const auto num_texels = static_cast<size_t>(size) * size;
  std::vector<Vector2f> rough(num_texels);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const Vector2d p =
          area.head<2>() + Vector2d(x + 0.5, y + 0.5).cwiseProduct(area.tail<2>()) / size;
      const Eigen::Vector3d p_S(p.x(), p.y(), 0.0);
      const Disc& disc = discs[(x % kTurns) + kTurns * (y % kTurns)];
      rough[static_cast<size_t>(y) * size + x] = {key_filter.CalcVisibility(p_S, disc),
                                                  sky_filter.CalcVisibility(p_S, disc)};
    }
  }
  std::vector<uint8_t> light(2 * num_texels);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      Vector2f sum = Vector2f::Zero();
      for (int i = 0; i < kTurns * kTurns; ++i) {
        const int column = std::clamp(x + i % kTurns - 1, 0, size - 1);
        const int row = std::clamp(y + i / kTurns - 1, 0, size - 1);
        sum += rough[static_cast<size_t>(row) * size + column];
      }
      for (int k = 0; k < 2; ++k) {
        light[2 * (static_cast<size_t>(y) * size + x) + k] =
            static_cast<uint8_t>(255.0f / (kTurns * kTurns) * sum[k] + 0.5f);
      }
    }
  }
  return light;
}

namespace {

constexpr float kLeastContrast = 0.04f * 255.0f;  // of the corners' brightness
constexpr float kMaxLength = 4.0f;                // along the edge [pixel]
constexpr float kLeastSlope = 0.02f * 255.0f;

float CalcBrightness(const Vector3f& c) { return c.dot(Vector3f(0.299f, 0.587f, 0.114f)); }

/** A picture with its border twice, so that no pixel has to ask for it. */
struct Padded {
  explicit Padded(const Image& image)
      : width(image.width), stride(3 * (static_cast<size_t>(image.width) + 2)) {
    rgb.reserve(stride * (static_cast<size_t>(image.height) + 2));
    for (int y = -1; y <= image.height; ++y) {
      const size_t row = 3 * static_cast<size_t>(image.width) *
                         static_cast<size_t>(std::clamp(y, 0, image.height - 1));
      const auto first = image.rgb.begin() + static_cast<std::ptrdiff_t>(row);
      const auto end = first + 3 * static_cast<std::ptrdiff_t>(image.width);
      rgb.insert(rgb.end(), first, first + 3);
      rgb.insert(rgb.end(), first, end);
      rgb.insert(rgb.end(), end - 3, end);
    }
  }
  /** @pre -1 <= x <= width, -1 <= y <= height. */
  const uint8_t* Find(int x, int y) const {
    return &rgb[static_cast<size_t>(y + 1) * stride + 3 * static_cast<size_t>(x + 1)];
  }

  int width;
  size_t stride;  // of a row
  std::vector<uint8_t> rgb;
};

/** Between the pixels around it; whole numbers are the pixels' middles. */
Vector3f Sample(const Image& image, const Vector2f& p) {
  const float x = std::clamp(p.x(), 0.0f, static_cast<float>(image.width - 1));
  const float y = std::clamp(p.y(), 0.0f, static_cast<float>(image.height - 1));
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, image.width - 1), y1 = std::min(y0 + 1, image.height - 1);
  const float u = x - static_cast<float>(x0), v = y - static_cast<float>(y0);
  const auto find = [&](int column, int row) {
    const size_t pixel = static_cast<size_t>(row) * image.width + column;
    return Eigen::Map<const Eigen::Matrix<uint8_t, 3, 1>>(&image.rgb[3 * pixel]).cast<float>();
  };
  return (1.0f - v) * ((1.0f - u) * find(x0, y0) + u * find(x1, y0)) +
         v * ((1.0f - u) * find(x0, y1) + u * find(x1, y1));
}

/** The mean along the edge through a pixel. @param corners  brightness: upper left, upper right,
lower left, lower right. */
Vector3f SampleAlongEdge(const Image& rough, const Vector2f& pixel, const std::array<float, 4>& c,
                         float lowest, float highest) {
  Vector2f along(c[0] + c[1] - c[2] - c[3], c[1] + c[3] - c[0] - c[2]);
  along /= std::min(std::abs(along.x()), std::abs(along.y())) + kLeastSlope;
  along = along.cwiseMax(-kMaxLength).cwiseMin(kMaxLength);
  const auto take_both = [&](const Vector2f& offset) -> Vector3f {
    return 0.5f * (Sample(rough, pixel - offset) + Sample(rough, pixel + offset));
  };
  const Vector3f near = take_both(along / 6.0f);
  const Vector3f far = 0.5f * (near + take_both(0.5f * along));
  // What is brighter or darker than the pixel's corners lies beyond the edge.
  const float brightness = CalcBrightness(far);
  return brightness < lowest || brightness > highest ? near : far;
}

}  // namespace

Image SmoothEdges(const Image& rough) {
  const int width = rough.width, height = rough.height;
  const Padded padded(rough);
  Image result = {width, height, std::vector<uint8_t>(rough.rgb.size())};
  const size_t num_corners = static_cast<size_t>(width) + 1;
  std::vector<float> upper(num_corners), lower(num_corners);  // brightness along a row of corners
  const auto find_corners = [&](int y, std::vector<float>& corners) {
    const uint8_t* above = padded.Find(-1, y - 1);
    const uint8_t* below = padded.Find(-1, y);
    for (size_t i = 0; i < num_corners; ++i, above += 3, below += 3) {
      corners[i] = 0.25f * (0.299f * static_cast<float>(above[0] + above[3] + below[0] + below[3]) +
                            0.587f * static_cast<float>(above[1] + above[4] + below[1] + below[4]) +
                            0.114f * static_cast<float>(above[2] + above[5] + below[2] + below[5]));
    }
  };
  find_corners(0, lower);
  for (int y = 0; y < height; ++y) {
    std::swap(upper, lower);
    find_corners(y + 1, lower);
    const uint8_t* above = padded.Find(0, y - 1);
    const uint8_t* here = padded.Find(0, y);
    const uint8_t* below = padded.Find(0, y + 1);
    uint8_t* const out = &result.rgb[3 * static_cast<size_t>(y) * width];
    const auto sum_corners = [&](int k) {  // 16 times their mean
      return above[k - 3] + 2 * above[k] + above[k + 3] + below[k - 3] + 2 * below[k] +
             below[k + 3] + 2 * (here[k - 3] + 2 * here[k] + here[k + 3]);
    };
    for (int k = 0; k < 3 * width; ++k) {
      out[k] = static_cast<uint8_t>((48 * here[k] + sum_corners(k) + 32) >> 6);
    }
    for (int x = 0; x < width; ++x) {
      const std::array<float, 4> corners = {upper[x], upper[x + 1], lower[x], lower[x + 1]};
      const auto [lowest, highest] = std::minmax_element(corners.begin(), corners.end());
      if (*highest - *lowest <= kLeastContrast) continue;
      const Vector3f middle =
          SampleAlongEdge(rough, Vector2f(static_cast<float>(x), static_cast<float>(y)), corners,
                          *lowest, *highest);
      for (int k = 0; k < 3; ++k) {
        out[3 * x + k] = static_cast<uint8_t>(
            0.75f * middle[k] + static_cast<float>(sum_corners(3 * x + k)) / 64.0f + 0.5f);
      }
    }
  }
  return result;
}

}  // namespace graspbench
