#include "core/vision/camera_config.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

TEST(CameraConfigTest, AColourIsReadAsOnAWebPage) {
  const auto colour = ParseColour("#ff8000");
  ASSERT_TRUE(colour);
  EXPECT_FLOAT_EQ(colour->x(), 1.0f);
  EXPECT_FLOAT_EQ(colour->y(), 128.0f / 255.0f);
  EXPECT_FLOAT_EQ(colour->z(), 0.0f);
  EXPECT_TRUE(ParseColour(CameraConfig().table_colour));
  for (const char* wrong : {"", "#", "ff8000", "#ff800", "#ff80000", "#ff80g0", "#-f8000", "red"}) {
    EXPECT_FALSE(ParseColour(wrong)) << wrong;
  }
}

}  // namespace
}  // namespace graspbench
