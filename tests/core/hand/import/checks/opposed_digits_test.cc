#include "core/hand/import/checks/opposed_digits.h"

#include <gtest/gtest.h>

#include "tests/core/hand/import/checks/box_hand.h"

namespace graspbench {
namespace {

using Digits = std::vector<bool>;

TEST(OpposedDigitsTest, AThumbInFrontOfFingersOpposesThem) {
  EXPECT_EQ(FindOpposedDigits(MakeBoxHand()), (Digits{true, true, true}));
}

// Its pad faces away from the fingers, and so it closes.
TEST(OpposedDigitsTest, AThumbThatClosesAwayOpposesNone) {
  ImportedHand imported = MakeBoxHand();
  imported.hand.links[5].X_PJ = MakePose(Eigen::Vector3d(0, -0.06, 0.09));
  EXPECT_EQ(FindOpposedDigits(imported), (Digits{false, false, false}));
}

// The palm's box reaches from the fingers to behind the thumb, which does not come out of it.
TEST(OpposedDigitsTest, PadsWithThePalmBetweenThemDoNotOppose) {
  ImportedHand imported = MakeBoxHand();
  imported.hand.links[5].X_PJ =
      MakePose(MakeRotationRpy(0, 0, kPi), Eigen::Vector3d(0, -0.12, 0.09));
  imported.shapes[0] = MakeBox(0, {0, 0, 0.05}, {0.08, 0.03, 0.1});
  EXPECT_EQ(FindOpposedDigits(imported), (Digits{true, true, true}));
  imported.shapes[0] = MakeBox(0, {0, -0.08, 0.1}, {0.2, 0.12, 0.2});
  EXPECT_EQ(FindOpposedDigits(imported), (Digits{false, false, false}));
}

TEST(OpposedDigitsTest, ADigitThatOpposesOneOfSeveralIsOpposed) {
  ImportedHand imported = MakeBoxHand();
  imported.hand.links[3].X_PJ = MakePose(Eigen::Vector3d(0.3, 0, 0.102));  // out of reach
  EXPECT_EQ(FindOpposedDigits(imported), (Digits{true, false, true}));
}

}  // namespace
}  // namespace graspbench
