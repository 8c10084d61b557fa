#include "core/physics/world.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

// A pad that stands still can be at its limit, by its torsion: it does not slide.
TEST(World, AContactSlidesOnlyWhereItsSurfacesMove) {
  HandContact contact;
  contact.slip_speed = 0.01;  // the bristle gives way
  EXPECT_STREQ(DescribeState(contact), "sticks");
  contact.is_at_limit = true;
  EXPECT_STREQ(DescribeState(contact), "slides");
  EXPECT_TRUE(IsSliding(contact));
  contact.slip_speed = 0.0005;
  EXPECT_STREQ(DescribeState(contact), "at its limit");
  EXPECT_FALSE(IsSliding(contact));
}

TEST(World, TheConeShareIsThatOfTheTangentialForce) {
  HandContact contact;
  contact.normal_force = 2.0;
  contact.friction_W = Eigen::Vector3d(0.3, 0.4, 0.0);
  EXPECT_TRUE(std::isnan(CalcConeShare(contact)));
  contact.mu = 0.5;
  EXPECT_DOUBLE_EQ(CalcConeShare(contact), 0.5);
}

}  // namespace
}  // namespace graspbench
