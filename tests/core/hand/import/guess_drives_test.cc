#include <gtest/gtest.h>

#include "core/hand/import/guess_hand.h"
#include "tests/core/hand/import/box_hand.h"

namespace graspbench {
namespace {

/** Six joints of 20 g links, 75 mm to the tip. */
ImportedHand MakeDriven(double effort) {
  ImportedHand imported = MakeBoxHand();
  for (HandLink& link : imported.hand.links) {
    link.mass = 0.02;
    link.p_LLcm = {0, 0, 0.02};
  }
  imported.drives.resize(static_cast<size_t>(imported.hand.num_joints()));
  for (ForeignDrive& drive : imported.drives) drive.effort = effort;
  return imported;
}

std::string TellDrives(ImportedHand& imported) {
  Diagnostics problems;
  GuessDrives("hand.urdf", imported, problems);
  return problems.Format();
}

TEST(GuessDrivesTest, MoreThanAFingerHasAndPlaceholdersAreGuessedAndTold) {
  ImportedHand strong = MakeDriven(8.0);  // 107 N
  EXPECT_NE(TellDrives(strong).find("the effort of 6 joints"), std::string::npos);
  EXPECT_EQ(strong.hand.joints[0].drive.torque_limit, 1.0);
  ImportedHand one = MakeDriven(0.8);
  one.drives[0].effort = 6.0;
  EXPECT_EQ(TellDrives(one), "");
  ImportedHand gripper = MakeDriven(10.0);  // of two digits: 133 N
  gripper.hand.digits.pop_back();
  for (size_t j = 1; j < gripper.drives.size(); ++j) gripper.drives[j].effort = 0.5;
  EXPECT_EQ(TellDrives(gripper).find("effort"), std::string::npos) << TellDrives(gripper);
  for (size_t j = 0; j < 4; ++j) gripper.drives[j].effort = 10.0;
  EXPECT_NE(TellDrives(gripper).find("a placeholder"), std::string::npos);
}

// Both links stretched out, 20 g each with centres at 20 and 65 mm: 0.0167 N m; the far one 0.0039.
TEST(GuessDrivesTest, AnEffortBelowTheWeightOfWhatItMovesIsTold) {
  ImportedHand imported = MakeDriven(0.009);
  EXPECT_EQ(TellDrives(imported), "");
  imported.drives[0].effort = 0.008;
  EXPECT_NE(TellDrives(imported).find("the effort of 1 joint (\"left_near_bend\") bears less"),
            std::string::npos)
      << TellDrives(imported);
}

TEST(GuessDrivesTest, AnEffortThatAFingerCanHaveIsTaken) {
  ImportedHand imported = MakeDriven(5.0);  // 67 N at 75 mm
  EXPECT_EQ(TellDrives(imported), "");
  EXPECT_EQ(imported.hand.joints[0].drive.torque_limit, 5.0);
}

// 0.0167 N m of weight bend a drive of 0.21 N m/rad by 0.08 rad, one of 0.05 by 0.33 rad.
TEST(GuessDrivesTest, APublishedStiffnessThatBearsTheFingerIsKept) {
  ImportedHand imported = MakeDriven(1.0);
  for (ForeignDrive& drive : imported.drives) drive.stiffness = 0.21;
  EXPECT_EQ(TellDrives(imported), "");
  EXPECT_EQ(imported.hand.joints[0].drive.stiffness, 0.21);
  imported.drives[0].stiffness = 0.05;
  EXPECT_NE(TellDrives(imported).find("the stiffness of 1 drive (\"left_near_bend 0.05\")"),
            std::string::npos)
      << TellDrives(imported);
  EXPECT_EQ(imported.hand.joints[0].drive.stiffness, 0.21);  // of its digit
}

TEST(GuessDrivesTest, DampingThatCrawlsIsTold) {
  ImportedHand imported = MakeDriven(1.0);
  for (ForeignDrive& drive : imported.drives) {
    drive.stiffness = 2.0;
    drive.damping = 0.5;  // a quarter of a second
  }
  EXPECT_EQ(TellDrives(imported), "");
  imported.drives[2].damping = 5.0;
  EXPECT_NE(TellDrives(imported).find("the damping of 1 drive (\"right_near_bend 5\")"),
            std::string::npos)
      << TellDrives(imported);
  EXPECT_NEAR(imported.hand.joints[2].drive.damping, 0.2, 1e-12);
}

}  // namespace
}  // namespace graspbench
