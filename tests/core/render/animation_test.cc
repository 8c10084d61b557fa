#include "core/render/animation.h"

#include <gtest/gtest.h>
#include <webp/demux.h>

#include <cstdlib>

#include "core/base/error.h"

namespace graspbench {
namespace {

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

TEST(AnimatedWebp, RefusesImpossibleSizes) {
  EXPECT_THROW(AnimatedWebp(0, 10), Error);
  EXPECT_THROW(AnimatedWebp(10, 20000), Error);
}

}  // namespace
}  // namespace graspbench
