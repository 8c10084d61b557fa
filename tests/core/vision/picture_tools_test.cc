#include "core/vision/picture_tools.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>

namespace graspbench {
namespace {

using Eigen::Vector2d;

Image MakeGrey(int width, int height, uint8_t level) {
  return {width, height, std::vector<uint8_t>(3 * static_cast<size_t>(width) * height, level)};
}

void Paint(Image& image, int x0, int y0, int x1, int y1, uint8_t level) {
  for (int y = y0; y < y1; ++y) {
    for (int x = x0; x < x1; ++x) {
      for (int c = 0; c < 3; ++c) {
        image.rgb[3 * (static_cast<size_t>(y) * image.width + x) + c] = level;
      }
    }
  }
}

int LevelAt(const Image& image, int x, int y) {
  return image.rgb[3 * (static_cast<size_t>(y) * image.width + x)];
}

TEST(PictureToolsTest, NoiseHasTheSpreadAskedForAndItsSeed) {
  const Image image = MakeGrey(200, 200, 100);
  PictureFaults faults;
  faults.noise = 3.0;
  faults.noise_seed = 5;
  const Image noisy = LoadPictureTools().apply_faults(image, faults);
  double sum = 0.0, square = 0.0;
  for (const uint8_t level : noisy.rgb) {
    sum += level - 100.0;
    square += std::pow(level - 100.0, 2.0);
  }
  const double n = static_cast<double>(noisy.rgb.size());
  EXPECT_NEAR(sum / n, 0.0, 5.0 * 3.0 / std::sqrt(n));
  EXPECT_NEAR(square / n, 9.0 + 1.0 / 12.0, 0.15);  // and rounding
  EXPECT_EQ(LoadPictureTools().apply_faults(image, faults).rgb, noisy.rgb);
  faults.noise_seed = 6;
  EXPECT_NE(LoadPictureTools().apply_faults(image, faults).rgb, noisy.rgb);
}

// An edge becomes the normal distribution's integral.
TEST(PictureToolsTest, BlurSpreadsAnEdgeAsAGaussianDoes) {
  Image image = MakeGrey(60, 10, 50);
  Paint(image, 30, 0, 60, 10, 150);
  PictureFaults faults;
  faults.blur = 2.0;
  const Image blurred = LoadPictureTools().apply_faults(image, faults);
  for (const int x : {26, 28, 30, 32, 34}) {
    const double share = 0.5 * (1.0 + std::erf((x + 0.5 - 30.0) / (2.0 * std::sqrt(2.0))));
    EXPECT_NEAR(LevelAt(blurred, x, 5), 50.0 + 100.0 * share, 1.5) << x;
  }
}

TEST(PictureToolsTest, PixelsComeFromWhereTheLensShowsThem) {
  Image image = MakeGrey(50, 40, 10);
  Paint(image, 20, 15, 22, 17, 240);
  PictureFaults faults;
  faults.width = 30;
  faults.height = 20;
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 30; ++x) {
      faults.from_x.push_back(static_cast<float>(x + 0.5 + 12.0));
      faults.from_y.push_back(static_cast<float>(y + 0.5 + 9.0));
    }
  }
  const Image cut = LoadPictureTools().apply_faults(image, faults);
  ASSERT_EQ(cut.width, 30);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 30; ++x) {
      const bool is_spot = x >= 8 && x < 10 && y >= 6 && y < 8;
      ASSERT_EQ(LevelAt(cut, x, y), is_spot ? 240 : 10) << x << " " << y;
    }
  }
}

TEST(PictureToolsTest, FindsRegionsLargestFirst) {
  const Image empty = MakeGrey(100, 80, 120);
  Image picture = empty;
  Paint(picture, 10, 20, 14, 24, 30);
  Paint(picture, 40, 30, 70, 50, 220);
  const auto regions = LoadPictureTools().find_regions(picture, empty, DifferenceRule());
  ASSERT_EQ(regions.size(), 2u);
  EXPECT_NEAR(regions[0].area, 30.0 * 20.0, 5.0);
  EXPECT_NEAR(regions[1].area, 4.0 * 4.0, 2.0);
  double left = 100.0, right = 0.0;
  for (const Vector2d& p : regions[0].contour) {
    left = std::min(left, p.x());
    right = std::max(right, p.x());
  }
  EXPECT_EQ(left, 40.5);  // middles of the outermost pixels
  EXPECT_EQ(right, 69.5);
}

// Up to the darkest: beyond, a thing is black, not in the shade.
TEST(PictureToolsTest, AShadowIsNoDifference) {
  Image empty = MakeGrey(60, 60, 0);
  for (size_t i = 0; i < empty.rgb.size(); i += 3) {
    empty.rgb[i] = 180;
    empty.rgb[i + 1] = 80;
    empty.rgb[i + 2] = 150;
  }
  for (const auto& [share, is_seen] : {std::pair(0.6, false), {1.05, false}, {0.2, true}}) {
    Image picture = empty;
    for (uint8_t& level : picture.rgb) level = static_cast<uint8_t>(share * level + 0.5);
    EXPECT_EQ(!LoadPictureTools().find_regions(picture, empty, DifferenceRule()).empty(), is_seen)
        << share;
  }
}

// This program needs OpenCV, and has it only since it asked.
TEST(PictureToolsTest, OpenCvIsLoadedAtFirstUse) {
  const auto is_loaded = [] {
    std::ifstream maps("/proc/self/maps");
    return std::string(std::istreambuf_iterator<char>(maps), {}).find("opencv") !=
           std::string::npos;
  };
  // Tests may run in one program or each in its own; only the latter tells.
  if (::testing::UnitTest::GetInstance()->test_to_run_count() == 1) {
    EXPECT_FALSE(is_loaded());
  }
  LoadPictureTools();
  EXPECT_TRUE(is_loaded());
}

}  // namespace
}  // namespace graspbench
