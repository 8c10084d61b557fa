#include "core/hand/import/checks/find_implausible.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/core/hand/import/box_hand.h"

namespace graspbench {
namespace {

std::string Tell(const ImportedHand& imported) {
  Diagnostics problems;
  FindImplausible("hand.urdf", imported, problems);
  return problems.Format();
}

/** A palm of 400 g, six links of 20 g; 322 cm^3 of boxes. */
ImportedHand MakeWeighedHand() {
  ImportedHand imported = MakeBoxHand();
  for (HandLink& link : imported.hand.links) link.mass = 0.02;
  imported.hand.links[0].mass = 0.4;
  return imported;
}

// What is wrong between digits: testdata/wrong. Here the numbers of the messages, by hand.
TEST(FindImplausibleTest, RangesSizesAndMassesOfNoHandAreTold) {
  const auto scale_masses = [](Hand& hand, double factor) {
    for (HandLink& link : hand.links) link.mass *= factor;
  };
  const std::pair<std::function<void(Hand&)>, const char*> cases[] = {
      {[](Hand& hand) { hand.joints[0].upper = 0.004; },
       "1 joint next to stuck, \"left_near_bend\": the first moves by 0.23 deg"},
      {[](Hand& hand) { hand.joints[0].upper = 3.7; },
       "1 joint (\"left_near_bend 212 deg\") may turn farther"},
      {[](Hand& hand) { hand.digits[0].p_LTip.z() = 0.23; }, "the longest digit is 275 mm long"},
      {[&](Hand& hand) { scale_masses(hand, 1e-6); }, "a mass of 0.00052 g in all"},
      {[&](Hand& hand) { scale_masses(hand, 9.8); }, "cm^3 of shapes, 1.6e+04 kg/m^3"},
      {[&](Hand& hand) { scale_masses(hand, 0.098); }, "cm^3 of shapes, 1.6e+02 kg/m^3"},
      {[](Hand& hand) { hand.links[0].mass = 6.5; }, "54 times as much as all digits, 120 g"}};
  EXPECT_EQ(Tell(MakeWeighedHand()), "");
  for (const auto& [change, told] : cases) {
    ImportedHand imported = MakeWeighedHand();
    change(imported.hand);
    EXPECT_NE(Tell(imported).find(told), std::string::npos) << told << "\n" << Tell(imported);
  }
}

// The palm's box reaches from the fingers to behind the thumb, which does not come out of it.
TEST(FindImplausibleTest, PadsWithThePalmBetweenThemDoNotOppose) {
  ImportedHand imported = MakeBoxHand();
  imported.hand.links[5].X_PJ =
      MakePose(MakeRotationRpy(0, 0, kPi), Eigen::Vector3d(0, -0.12, 0.09));
  imported.shapes[0] = MakeBox(0, {0, 0, 0.05}, {0.08, 0.03, 0.1});
  EXPECT_EQ(FindOpposedDigits(imported), (std::vector<bool>{true, true, true}));
  imported.shapes[0] = MakeBox(0, {0, -0.08, 0.1}, {0.2, 0.12, 0.2});
  EXPECT_EQ(FindOpposedDigits(imported), (std::vector<bool>{false, false, false}));
}

}  // namespace
}  // namespace graspbench
