#include "core/render/table_light.h"

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

}  // namespace graspbench
