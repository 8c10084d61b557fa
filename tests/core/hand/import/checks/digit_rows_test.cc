#include "core/hand/import/checks/digit_rows.h"

#include <gtest/gtest.h>

#include "tests/core/hand/import/checks/finger_row.h"

namespace graspbench {
namespace {

TEST(DigitRowsTest, ARowHasTheJointsThatBendAndHowTheyTurn) {
  const ImportedHand imported = MakeRow(-1.0, 0.0, 1.5);
  const std::vector<DigitRow> rows = MakeDigitRows(imported.hand);
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1].joints, std::vector<int>{1});
  EXPECT_EQ(rows[1].base, Eigen::Vector3d(0, 0.03, 0.09));
  EXPECT_EQ(rows[1].along, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(rows[1].turns[0], Eigen::Vector3d(0, -1, 0));
  EXPECT_EQ(MakeDigitRows(MakeRow(-1.0, -1.5, 0.0).hand)[1].turns[0], Eigen::Vector3d(0, 1, 0));
}

TEST(DigitRowsTest, SideBySideAreParallelFingersApartAlongTheirAxes) {
  ImportedHand imported = MakeRow(1.0, 0.0, 1.5);
  const auto are_beside = [&] {
    const std::vector<DigitRow> rows = MakeDigitRows(imported.hand);
    return AreSideBySide(rows[0], rows[1]);
  };
  EXPECT_TRUE(are_beside());
  imported.hand.links[2].X_PJ = MakePose(Eigen::Vector3d(0.03, 0, 0.09));  // behind each other
  EXPECT_FALSE(are_beside());
  imported.hand.links[2].X_PJ =
      MakePose(MakeRotationRpy(0, 0.6, 0), Eigen::Vector3d(0, 0.03, 0.09));
  EXPECT_FALSE(are_beside());
}

TEST(DigitRowsTest, TheLongestDigitIsThatFromItsBaseToItsTip) {
  ImportedHand imported = MakeTwoJointRow();
  EXPECT_NEAR(CalcLongestDigit(imported.hand), 0.08, 1e-12);
  imported.hand.digits[2].p_LTip.z() = 0.07;
  EXPECT_NEAR(CalcLongestDigit(imported.hand), 0.1, 1e-12);
}

}  // namespace
}  // namespace graspbench
