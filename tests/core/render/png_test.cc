#include <gtest/gtest.h>
#include <png.h>

#include "core/render/scene.h"

namespace graspbench {
namespace {

Image MakeNoise(int width, int height) {
  Image image;
  image.width = width;
  image.height = height;
  uint32_t state = 1;  // a linear congruential generator is noise enough
  for (int i = 0; i < 3 * width * height; ++i) {
    state = 1664525u * state + 1013904223u;
    image.rgb.push_back(static_cast<uint8_t>(state >> 24));
  }
  return image;
}

TEST(EncodePngTest, LibpngReadsBackTheSamePixels) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(33, 7), std::pair(64, 48)}) {
    const Image image = MakeNoise(width, height);
    const std::string bytes = EncodePng(image);
    png_image reader = {};
    reader.version = PNG_IMAGE_VERSION;
    ASSERT_TRUE(png_image_begin_read_from_memory(&reader, bytes.data(), bytes.size()));
    EXPECT_EQ(static_cast<int>(reader.width), width);
    EXPECT_EQ(static_cast<int>(reader.height), height);
    reader.format = PNG_FORMAT_RGB;
    std::vector<uint8_t> rgb(PNG_IMAGE_SIZE(reader));
    ASSERT_TRUE(png_image_finish_read(&reader, nullptr, rgb.data(), 0, nullptr));
    EXPECT_EQ(rgb, image.rgb);
  }
}

TEST(EncodePngTest, CarriesNoTime) {
  const std::string bytes = EncodePng(MakeNoise(8, 8));
  EXPECT_EQ(bytes.find("tIME"), std::string::npos);
  EXPECT_EQ(bytes.find("tEXt"), std::string::npos);
  EXPECT_EQ(EncodePng(MakeNoise(8, 8)), bytes);
}

}  // namespace
}  // namespace graspbench
