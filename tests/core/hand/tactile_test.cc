#include "core/hand/tactile.h"

#include <gtest/gtest.h>

#include <map>

#include "core/base/units.h"
#include "core/hand/load_hand.h"
#include "tests/core/hand/ball_and_rod.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

double SumAreas(const std::vector<SurfacePoint>& points) {
  double area = 0.0;
  for (const SurfacePoint& point : points) area += point.area;
  return area;
}

// Roethling 2007, 3.1.2: 186 in all, 34 a fingertip, two on each finger's middle and proximal
// phalanx, none elsewhere; some seven a square centimetre.
TEST(TactileTest, TheShadowHandHas186) {
  const Hand hand = LoadHand("shadow");
  ASSERT_TRUE(hand.skin);
  EXPECT_EQ(hand.skin->elements.size(), 186u);
  EXPECT_EQ(hand.skin->response, TactileResponse::kExponential);
  std::map<int, int> counts;
  for (const TactileElement& element : hand.skin->elements) ++counts[element.link];
  EXPECT_EQ(counts.size(), 13u);
  for (const Digit& digit : hand.digits) {
    EXPECT_EQ(counts[digit.distal_link], 34) << digit.id;
    const SensedSurface* tip = hand.skin->FindSurface(digit.distal_link);
    ASSERT_TRUE(tip) << digit.id;
    EXPECT_NEAR(34.0 / (1e4 * SumAreas(tip->points)), 7.0, 0.2) << digit.id;
    if (digit.is_thumb) continue;
    EXPECT_EQ(counts[digit.links[digit.links.size() - 2]], 2) << digit.id;
    EXPECT_EQ(counts[digit.links[digit.links.size() - 3]], 2) << digit.id;
  }
}

TEST(TactileTest, TheTumHandHasOneForceSensorAFingertip) {
  const Hand hand = LoadHand("tum");
  ASSERT_TRUE(hand.skin);
  EXPECT_EQ(hand.skin->response, TactileResponse::kLinear);
  ASSERT_EQ(hand.skin->elements.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(hand.skin->elements[i].link, hand.digits[i].distal_link);
  }
  EXPECT_FALSE(LoadHand("tum-original").skin);
}

// No gap: every point has an element, of its own link and the nearest; the cells' areas are the
// file's.
TEST(TactileTest, CellsHaveNoGapsAndTheAreasOfTheFile) {
  for (const char* id : {"shadow", "tum"}) {
    const auto skin = LoadHand(id).skin;
    std::vector<double> areas(skin->elements.size(), 0.0);
    for (const SensedSurface& surface : skin->surfaces) {
      for (const SurfacePoint& point : surface.points) {
        ASSERT_GE(point.element, 0);
        const auto i = static_cast<size_t>(point.element);
        ASSERT_EQ(skin->elements[i].link, surface.part.link);
        areas[i] += point.area;
      }
    }
    for (size_t i = 0; i < areas.size(); ++i) {
      EXPECT_NEAR(areas[i] / skin->elements[i].area, 1.0, 0.01) << id << " " << i;
    }
  }
}

// Areas in closed form: a ball, a capsule, halves of both, and a ball's cap.
TEST(TactileTest, SurfacesHaveTheirAreas) {
  const Hand hand = MakeBallAndRod();
  const double ball = 4.0 * kPi * 1e-4, rod = 2.0 * kPi * 0.005 * 0.04;
  EXPECT_NEAR(SumAreas(SampleSurface(hand, {0})), ball, 1e-9 * ball);
  EXPECT_NEAR(SumAreas(SampleSurface(hand, {1})), rod, 1e-9 * rod);
  EXPECT_NEAR(SumAreas(SampleSurface(hand, {0, Vector3d::UnitX()})), ball / 2.0, 0.02 * ball);
  EXPECT_NEAR(SumAreas(SampleSurface(hand, {1, Vector3d::UnitX()})), rod / 2.0, 0.02 * rod);
  const SensedPart cap{0, Vector3d::Zero(), Vector3d::UnitZ(), 0.005};
  EXPECT_NEAR(SumAreas(SampleSurface(hand, cap)), ball / 4.0, 0.02 * ball);
  for (const SurfacePoint& point : SampleSurface(hand, cap)) {
    EXPECT_NEAR(point.p_L.norm(), 0.01, 1e-12);
    EXPECT_LT((point.p_L / 0.01 - point.normal_L).norm(), 1e-12);
  }
}

// Of two balls in one link only what is outside of both.
TEST(TactileTest, WhatLiesInsideTheLinkIsNoSurface) {
  Hand hand = MakeBallAndRod();
  hand.capsules[1] = {0, Vector3d(0.01, 0.0, 0.0), Vector3d(0.01, 0.0, 0.0), 0.01};
  // Two balls whose middles are one radius apart: each loses a cap of height r / 2.
  const double wanted = 2.0 * (4.0 - 1.0) * kPi * 1e-4;
  EXPECT_NEAR(SumAreas(SampleSurface(hand, {0})), wanted, 0.02 * wanted);
}

TEST(TactileTest, ProjectsOntoTheSurface) {
  const Hand hand = MakeBallAndRod();
  EXPECT_LT(
      (ProjectOntoSurface(hand, 0, Vector3d(0.0, 0.02, 0.0)) - Vector3d(0.0, 0.01, 0.0)).norm(),
      1e-15);
  EXPECT_LT(
      (ProjectOntoSurface(hand, 1, Vector3d(0.004, 0.02, 0.0)) - Vector3d(0.005, 0.02, 0.0)).norm(),
      1e-15);
  EXPECT_LT(
      (ProjectOntoSurface(hand, 1, Vector3d(0.0, 0.05, 0.0)) - Vector3d(0.0, 0.035, 0.0)).norm(),
      1e-15);
}

TEST(TactileYamlTest, EveryFaultIsNamedWithItsLine) {
  const char* text =
      "response: quadratic\n"
      "surfaces:\n"
      "  - link: bal\n"
      "    elements: [{position_m: [0, 0, 0.01], normal: [0, 0, 1], area_m2: 0}]\n"
      "  - link: ball\n"
      "    elements: []\n"
      "    colour: red\n";
  Diagnostics problems;
  ParseTactile(text, "tactile.yaml", MakeBallAndRod(), problems);
  const std::string all = problems.Format();
  for (const char* wanted :
       {"tactile.yaml:1: ", "no response \"quadratic\"", "Known: linear, exponential",
        "tactile.yaml:3: ", "the hand has no link \"bal\"", "expected above 0",
        "expected a list with at least one entry", "colour"}) {
    EXPECT_NE(all.find(wanted), all.npos) << wanted << " in\n" << all;
  }
}

// Of somebody who works in millimetres and in square ones, and one whose normal is none. A ball of
// 10 mm radius has 12.6 cm2.
TEST(TactileYamlTest, WrongUnitsAreTold) {
  const char* text =
      "response: linear\n"
      "surfaces:\n"
      "  - link: ball\n"
      "    elements: [{position_m: [0, 0, 10], normal: [0, 0, 1], area_m2: 1.0e-5}]\n"
      "  - link: rod\n"
      "    elements: [{position_m: [0.005, 0, 0], normal: [0, 0, 0], area_m2: 14}]\n";
  Diagnostics problems;
  ParseTactile(text, "tactile.yaml", MakeBallAndRod(), problems);
  const std::string all = problems.Format();
  for (const char* wanted : {"tactile.yaml:4: error: element of ball, position_m: lies 9990.0 mm "
                             "from the contact surface "
                             "of its link; expected "
                             "metres, in the link's frame",
                             "tactile.yaml:6: error: element of rod, normal: is no direction",
                             "their areas sum to 140000.0 cm2 on a surface of "
                             "12.6 cm2; expected square metres"}) {
    EXPECT_NE(all.find(wanted), all.npos) << wanted << " in\n" << all;
  }
}

// On top of the ball: a normal downwards leads into it.
TEST(TactileYamlTest, ANormalIntoTheHandIsTold) {
  Diagnostics problems;
  ParseTactile(
      "response: linear\n"
      "surfaces:\n"
      "  - {link: ball, elements: [{position_m: [0, 0, 0.01], normal: [0, 0, -1], area_m2: "
      "1e-5}]}\n",
      "tactile.yaml", MakeBallAndRod(), problems);
  EXPECT_NE(
      problems.Format().find("a normal points into the hand, at position_m [0.00000, 0.00000, "
                             "0.01000]; expected out of it"),
      std::string::npos)
      << problems.Format();
}

// Directions need no length: twice an axis cuts where the axis cuts.
TEST(TactileYamlTest, DirectionsAreMadeUnit) {
  const auto count = [](const char* along) {
    Diagnostics problems;
    const TactileSkin skin = ParseTactile(
        std::string("response: linear\nsurfaces:\n  - {link: ball, from_m: 0.005, along: ") +
            along + ", elements: [{position_m: [0, 0, 0.01], normal: [0, 0, 3], area_m2: 1e-6}]}\n",
        "tactile.yaml", MakeBallAndRod(), problems);
    EXPECT_EQ(problems.num_errors(), 0) << problems.Format();
    EXPECT_NEAR(skin.elements.at(0).normal_L.norm(), 1.0, 1e-15);
    return skin.surfaces.at(0).points.size();
  };
  EXPECT_EQ(count("[0, 0, 2]"), count("[0, 0, 1]"));
}

}  // namespace
}  // namespace graspbench
