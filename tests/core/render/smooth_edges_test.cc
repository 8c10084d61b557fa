#include "core/render/smooth_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

namespace graspbench {
namespace {

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

TEST(SmoothEdgesTest, OneColourStays) {
  for (const auto& [width, height] : {std::pair(1, 1), {2, 1}, {1, 3}, {17, 9}}) {
    const Image image = MakeImage(width, height, 143);
    EXPECT_EQ(SmoothEdges(image).rgb, image.rgb);
  }
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

TEST(SmoothEdgesTest, FarFromAnEdgeNothingChanges) {
  Image image = MakeImage(32, 32, 20);
  for (size_t i = 0; i < 3 * 32 * 16; ++i) image.rgb[i] = 220;
  const Image smooth = SmoothEdges(image);
  for (int y = 0; y < 32; ++y) {
    if (std::abs(y - 15.5) < 4.0) continue;
    EXPECT_EQ(smooth.rgb[3 * (y * 32 + 7)], y < 16 ? 220 : 20) << y;
  }
}

}  // namespace
}  // namespace graspbench
