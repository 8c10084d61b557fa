#include "workbench/pictures/hand_picture.h"

#include <gtest/gtest.h>

#include "core/hand/load_hand.h"

namespace graspbench {
namespace {

/** The share of a panel that is not background. */
double CalcCover(const Image& image, int column, int row) {
  const int side = image.width / 3;
  int covered = 0;
  for (int y = row * side; y < (row + 1) * side; ++y) {
    for (int x = column * side; x < (column + 1) * side; ++x) {
      const uint8_t* pixel = &image.rgb[static_cast<size_t>(3 * (y * image.width + x))];
      covered += pixel[0] != 237 || pixel[1] != 238 || pixel[2] != 240;
    }
  }
  return static_cast<double>(covered) / (side * side);
}

// Pictures and contact shapes of a hand of the project cover each other, so both panels are filled
// alike and their union little more.
TEST(HandPictureTest, WhatTouchesIsWhereTheHandIsSeen) {
  const Image image = DrawHandShapes(std::make_shared<const Hand>(LoadHand("tum")));
  ASSERT_EQ(image.width * 2, image.height * 3);
  for (int row = 0; row < 2; ++row) {
    const double seen = CalcCover(image, 0, row), both = CalcCover(image, 1, row),
                 touched = CalcCover(image, 2, row);
    EXPECT_GT(seen, 0.05);
    EXPECT_GT(touched, 0.05);
    EXPECT_LT(both, 1.5 * std::max(seen, touched));
    EXPECT_GE(both, std::max(seen, touched));
    EXPECT_LT(both, 0.98);
  }
}

/** Whether the rim of a panel is all background. */
bool HasFreeRim(const Image& image, int column, int row) {
  const int side = image.width / 3;
  for (int k = 0; k < side; ++k) {
    for (const auto& [x, y] : {std::pair{k, 0}, {k, side - 1}, {0, k}, {side - 1, k}}) {
      const int at = 3 * ((row * side + y) * image.width + column * side + x);
      if (image.rgb[static_cast<size_t>(at)] != 237) return false;
    }
  }
  return true;
}

// The Shadow Hand has a forearm.
TEST(HandPictureTest, TheWholeHandIsInThePicture) {
  for (const char* id : {"tum", "shadow"}) {
    const Image image = DrawHandShapes(std::make_shared<const Hand>(LoadHand(id)));
    for (int panel = 0; panel < 6; ++panel) {
      EXPECT_TRUE(HasFreeRim(image, panel % 3, panel / 3)) << id << ", panel " << panel;
    }
  }
}

}  // namespace
}  // namespace graspbench
