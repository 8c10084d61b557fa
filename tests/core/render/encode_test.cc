#include <gtest/gtest.h>
#include <png.h>
#include <webp/decode.h>
#include <webp/demux.h>

#include <cstdlib>

#include "core/base/error.h"
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

// Smooth like a rendered surface, with one sharp edge.
Image MakeGradient(int width, int height) {
  Image image;
  image.width = width;
  image.height = height;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      const int grey = u < width / 2 ? 40 + 80 * v / height : 237;
      for (int i = 0; i < 3; ++i) image.rgb.push_back(static_cast<uint8_t>(grey));
    }
  }
  return image;
}

TEST(EncodeWebpTest, LibwebpReadsBackNearlyTheSamePixels) {
  const Image image = MakeGradient(120, 90);
  const std::string bytes = EncodeWebp(image);
  int width = 0;
  int height = 0;
  uint8_t* rgb =
      WebPDecodeRGB(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size(), &width, &height);
  ASSERT_NE(rgb, nullptr);
  EXPECT_EQ(width, 120);
  EXPECT_EQ(height, 90);
  double sum = 0.0;
  for (size_t i = 0; i < image.rgb.size(); ++i) sum += std::abs(rgb[i] - image.rgb[i]);
  WebPFree(rgb);
  EXPECT_LT(sum / image.rgb.size(), 1.5);
  EXPECT_EQ(EncodeWebp(image), bytes);
}

TEST(EncodeWebpTest, RefusesWhatTheFormatCannotHold) {
  Image image;
  image.width = 20000;
  image.height = 1;
  image.rgb.resize(3 * 20000);
  try {
    EncodeWebp(image);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kUnsupported);
    EXPECT_STREQ(error.what(),
                 "cannot write a WebP picture of 20000 x 1 pixels; expected 1 to 16383 on each "
                 "side");
  }
}

constexpr int kWidth = 40, kHeight = 30;

Image MakePlain(uint8_t red, uint8_t green, uint8_t blue) {
  Image image = {kWidth, kHeight, {}};
  for (int i = 0; i < kWidth * kHeight; ++i) {
    image.rgb.insert(image.rgb.end(), {red, green, blue});
  }
  return image;
}

/** Read back by libwebp's own decoder. */
TEST(AnimatedWebp, PicturesComeBackAtTheirTimes) {
  AnimatedWebp film(kWidth, kHeight);
  const uint8_t colours[3][3] = {{200, 30, 30}, {30, 200, 30}, {30, 30, 200}};
  const double times[3] = {0.0, 0.05, 0.25};
  for (int i = 0; i < 3; ++i) {
    film.Add(MakePlain(colours[i][0], colours[i][1], colours[i][2]), times[i]);
  }
  const std::string bytes = film.Finish(1.0);
  const WebPData data = {reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()};
  WebPAnimDecoder* decoder = WebPAnimDecoderNew(&data, nullptr);
  ASSERT_NE(decoder, nullptr);
  WebPAnimInfo info;
  WebPAnimDecoderGetInfo(decoder, &info);
  EXPECT_EQ(info.frame_count, 3u);
  EXPECT_EQ(info.canvas_width, static_cast<uint32_t>(kWidth));
  EXPECT_EQ(info.loop_count, 0u);
  const int ends_ms[3] = {50, 250, 1000};
  for (int i = 0; i < 3; ++i) {
    uint8_t* rgba = nullptr;
    int end_ms = 0;
    ASSERT_TRUE(WebPAnimDecoderGetNext(decoder, &rgba, &end_ms)) << i;
    EXPECT_EQ(end_ms, ends_ms[i]);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(rgba[4 * (kWidth * 15 + 20) + c], colours[i][c], 8) << i;  // lossy
    }
  }
  WebPAnimDecoderDelete(decoder);
}

}  // namespace
}  // namespace graspbench
