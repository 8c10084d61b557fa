#include "core/hand/hand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace graspbench {
namespace {

TEST(HandTest, PeopleReadDegreesAndMillimetres) {
  HandJoint turn, slide;
  slide.is_prismatic = true;
  EXPECT_EQ(DisplayUnitOf(turn), std::string("deg"));
  EXPECT_EQ(DisplayUnitOf(slide), std::string("mm"));
  EXPECT_DOUBLE_EQ(ToDisplayUnits(turn, M_PI / 6.0), 30.0);
  EXPECT_DOUBLE_EQ(ToDisplayUnits(slide, 0.0125), 12.5);
  EXPECT_DOUBLE_EQ(FromDisplayUnits(turn, 30.0), M_PI / 6.0);
  EXPECT_DOUBLE_EQ(FromDisplayUnits(slide, 12.5), 0.0125);
}

}  // namespace
}  // namespace graspbench
