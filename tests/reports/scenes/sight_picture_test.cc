#include "reports/scenes/sight_picture.h"

#include <gtest/gtest.h>

#include <cstdio>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/standard_grasp.h"
#include "core/hand/load_hand.h"
#include "core/hand/tactile.h"
#include "objects/catalogue.h"
#include "tests/reports/report_fixture.h"

namespace graspbench {

namespace {

std::string Draw(const PlanarPose& pose, const PlanarPose& supposed) {
  const auto hand = std::make_shared<const Hand>(LoadHand("tum"));
  const auto object = LoadObject("remote_control");
  WristCamera camera(hand, object, CameraConfig());
  const Pose X_WO = MakePose(MakeRotationRpy(0.0, 0.0, pose.yaw),
                             Eigen::Vector3d(pose.x, pose.y, OutlineModel(object->mesh).middle()));
  return DrawSight(camera, *object, X_WO, LoadStandardGrasps(*hand)[0].q_pre, supposed, "remote")
      .markup();
}

size_t Count(const std::string& text, const std::string& part) {
  size_t count = 0;
  for (size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++count;
  return count;
}

// 186 discs; the strongest is full, an idle one empty, each with its number.
TEST(HandMapTest, EveryElementIsADiscShadedByItsForce) {
  const Hand hand = LoadHand("shadow");
  std::vector<double> force(hand.skin->elements.size(), 0.0);
  force[0] = 4.0;
  force[1] = 1.0;
  const std::string map = DrawHandMap(hand, force, {"Map", "Forces."}).markup();
  EXPECT_EQ(Count(map, "<ellipse "), 186u);
  EXPECT_EQ(Count(map, "fill-opacity=\"1.00\""), 1u);
  EXPECT_EQ(Count(map, "fill-opacity=\"0.25\""), 1u);
  EXPECT_EQ(Count(map, "fill-opacity=\"0.00\""), 184u);
  EXPECT_EQ(Count(map, "ffdistal: 4.00 N"), 1u);
  EXPECT_EQ(Count(map, "<title>Map</title>"), 1u);
}

// The camera stands above the supposed place and is turned with it, so that an object that lies
// there is in the middle (120, 90) of the drawing, with its length across.
TEST(SightPictureTest, WhatLiesWhereItShouldIsInTheMiddle) {
  const std::string svg = Draw({0.03, -0.02, 0.6}, {0.03, -0.02, 0.6});
  ExpectParts(svg, {"data:image/webp;base64,", "sight outline", "sight rectangle"});
  const size_t axis = svg.find("class=\"sight axis\"");
  ASSERT_NE(axis, svg.npos);
  double x1 = 0.0, y1 = 0.0, x2 = 0.0, y2 = 0.0;
  ASSERT_EQ(std::sscanf(svg.c_str() + axis,
                        "class=\"sight axis\" x1=\"%lf\" y1=\"%lf\" x2=\"%lf\" y2=\"%lf\"", &x1,
                        &y1, &x2, &y2),
            4);
  EXPECT_NEAR(0.5 * (x1 + x2), 120.0, 1.0);
  EXPECT_NEAR(0.5 * (y1 + y2), 90.0, 1.0);
  EXPECT_NEAR(y1, y2, 2.0);
  EXPECT_GT(std::abs(x2 - x1), 80.0);
}

TEST(SightPictureTest, WhatIsNotFoundIsSaid) {
  const std::string svg = Draw({0.25, 0.0, 0.0}, {});
  EXPECT_EQ(svg.find("sight outline"), svg.npos);
  ExpectParts(svg, {"Not found: "});
}

}  // namespace

}  // namespace graspbench
