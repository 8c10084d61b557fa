#include "core/render/picture_passes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kSlabHeight = 0.02;  // of a plate over the half x < 0 of the table [m]
constexpr int kTexels = 256;

LightMap MakeMap(const Vector3d& to_light, bool has_plate) {
  LightMap map;
  map.light = MakeStageLight(to_light, {{-0.2, -0.2, 0.0}, {0.2, 0.2, kSlabHeight}});
  map.size = kTexels;
  map.depth.assign(static_cast<size_t>(kTexels) * kTexels, 1.0f);
  if (!has_plate) return map;
  const Eigen::Matrix4d S_from_map = map.light.map_from_S.inverse();
  for (int y = 0; y < kTexels; ++y) {
    for (int x = 0; x < kTexels; ++x) {
      // Where the ray through this texel meets the plate's plane.
      const Eigen::Vector4d start =
          S_from_map * Eigen::Vector4d((x + 0.5) / kTexels, (y + 0.5) / kTexels, 0.0, 1.0);
      const Eigen::Vector4d way = S_from_map * Eigen::Vector4d(0.0, 0.0, 1.0, 0.0);
      const double depth = (kSlabHeight - start.z()) / way.z();
      if (start.x() + depth * way.x() < 0.0) map.depth[y * kTexels + x] = static_cast<float>(depth);
    }
  }
  return map;
}

/** Share of a disc whose middle is `distance` radii beyond a straight edge that the edge leaves. */
double CalcOpenShare(double distance) {
  const double t = std::clamp(distance, -1.0, 1.0);
  return 1.0 - (std::acos(t) - t * std::sqrt(1.0 - t * t)) / M_PI;
}

TEST(TableLightTest, PenumbraOfAHalfPlaneIsTheCutOfADisc) {
  const LightMap map = MakeMap(Vector3d::UnitZ(), true);
  constexpr int kSize = 100;  // texels of 1 mm
  const std::vector<uint8_t> light = CalcTableLight(map, map, {-0.05, -0.05, 0.1, 0.1}, kSize);
  const double key_radius = 0.13 * kSlabHeight, sky_radius = 0.8 * kSlabHeight;
  for (int x = 4; x < kSize - 4; ++x) {
    const double place = -0.05 + 0.001 * (x + 1.0);  // the mean of 4 texels, x - 1 to x + 2
    const uint8_t* const value = &light[2 * (50 * kSize + x)];
    EXPECT_NEAR(value[1] / 255.0, CalcOpenShare(place / sky_radius), 0.06) << place;
    if (std::abs(place) < key_radius + 0.003) continue;  // sharper than the smoothing of 4 mm
    EXPECT_EQ(value[0], place > 0.0 ? 255 : 0) << place;
  }
}

TEST(TableLightTest, ShadowLiesAwayFromALowLight) {
  const Vector3d to_light = Vector3d(1.0, 0.0, 1.0).normalized();
  const LightMap low = MakeMap(to_light, true), high = MakeMap(Vector3d::UnitZ(), true);
  constexpr int kSize = 100;
  const std::vector<uint8_t> light = CalcTableLight(low, high, {-0.05, -0.05, 0.1, 0.1}, kSize);
  // The edge at the height of the plate throws its shadow as far to the left as it is high.
  int last_dark = -1;
  for (int x = 0; x < kSize; ++x) {
    if (light[2 * (50 * kSize + x)] < 128) last_dark = x;
  }
  EXPECT_NEAR(-0.05 + 0.001 * (last_dark + 1.5), -kSlabHeight, 0.002);
}

Image MakeImage(int width, int height, uint8_t grey) {
  return {width, height, std::vector<uint8_t>(3 * static_cast<size_t>(width) * height, grey)};
}

/** Share of a pixel, from its middle, that lies below y = slope x, by many points. */
double CalcCover(double x, double y, double slope) {
  constexpr int kPoints = 16;
  int num_below = 0;
  for (int i = 0; i < kPoints * kPoints; ++i) {
    const double px = x + (i % kPoints + 0.5) / kPoints - 0.5;
    const double py = y + (i / kPoints + 0.5) / kPoints - 0.5;
    num_below += py < slope * px;
  }
  return static_cast<double>(num_below) / (kPoints * kPoints);
}

TEST(SmoothEdgesTest, StepsOfASlantingEdgeComeNearerToItsCover) {
  constexpr int kSize = 64;
  for (const double slope : {0.1, 0.25, 0.4, -0.3, 2.5}) {
    Image rough = MakeImage(kSize, kSize, 40);
    const auto cover = [&](int x, int y) { return CalcCover(x - 32.0, y - 32.0, slope); };
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const bool is_below = y - 32.0 < slope * (x - 32.0);
        for (int k = 0; k < 3; ++k) rough.rgb[3 * (y * kSize + x) + k] = is_below ? 200 : 40;
      }
    }
    const Image smooth = SmoothEdges(rough);
    double before = 0.0, after = 0.0;
    for (int y = 4; y < kSize - 4; ++y) {
      for (int x = 4; x < kSize - 4; ++x) {
        const double truth = 40.0 + 160.0 * cover(x, y);
        const size_t pixel = 3 * static_cast<size_t>(y * kSize + x);
        before += std::pow(rough.rgb[pixel] - truth, 2);
        after += std::pow(smooth.rgb[pixel] - truth, 2);
      }
    }
    EXPECT_LT(after, 0.5 * before) << slope;
  }
}

}  // namespace
}  // namespace graspbench
