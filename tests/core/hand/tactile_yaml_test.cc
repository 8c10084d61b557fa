#include "core/hand/tactile_yaml.h"

#include <gtest/gtest.h>

#include "tests/core/hand/ball_and_rod.h"

namespace graspbench {
namespace {

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
