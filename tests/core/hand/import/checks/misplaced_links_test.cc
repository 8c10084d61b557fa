#include "core/hand/import/checks/misplaced_links.h"

#include <gtest/gtest.h>

#include "tests/core/hand/import/checks/box_hand.h"

namespace graspbench {
namespace {

std::string TellMisplaced(const ImportedHand& imported) {
  Diagnostics problems;
  FindMisplacedLinks("hand.urdf", imported, problems);
  return problems.Format();
}

void ExpectTold(const ImportedHand& imported, const std::string& text) {
  EXPECT_NE(TellMisplaced(imported).find(text), std::string::npos) << TellMisplaced(imported);
}

TEST(MisplacedLinksTest, AHandWhoseLinksTouchOnlyIsNotDoubted) {
  EXPECT_EQ(TellMisplaced(MakeBoxHand()), "");
}

// 16 mm thick and 8 mm from each other: 8 mm deep, on the grid 7.
TEST(MisplacedLinksTest, AFingerInAnotherIsTold) {
  ImportedHand imported = MakeBoxHand();
  imported.hand.links[3].X_PJ = MakePose(Eigen::Vector3d(-0.012, 0, 0.102));
  ExpectTold(imported, "lies 7 mm deep in \"left_far\" of another digit");
}

TEST(MisplacedLinksTest, AFingerThroughThePalmIsTold) {
  ImportedHand imported = MakeBoxHand();
  imported.hand.links[1].X_PJ = MakePose(Eigen::Vector3d(-0.02, 0, 0));
  ExpectTold(imported, "link \"left_far\" lies 1");  // 15 mm to the face, a grid's cell less
  ExpectTold(imported, "mm deep in the palm");
}

TEST(MisplacedLinksTest, ALinkWithinTheOneBeforeIsTold) {
  ImportedHand imported = MakeBoxHand();
  imported.hand.links[2].X_PJ = MakePose(Eigen::Vector3d(0, 0, 0.01));
  ExpectTold(imported, "link \"left_far\" lies within \"left_near\" of its own digit");
}

// 60 mm above the palm, of which its box ends 2 mm below the joint: 62 mm of air.
TEST(MisplacedLinksTest, ADigitInTheAirIsTold) {
  ImportedHand imported = MakeBoxHand();
  imported.hand.links[1].X_PJ = MakePose(Eigen::Vector3d(-0.02, 0, 0.162));
  ExpectTold(imported,
             "link \"left_near\" hangs in the air, 63 mm from \"palm\", which carries it");
  ImportedHand::Visual& seen = imported.visuals.emplace_back();  // a rod that is only seen
  seen.link = 0;
  seen.visual.solid = MakeBox(0, {-0.02, 0, 0.13}, {0.01, 0.01, 0.06});
  EXPECT_EQ(TellMisplaced(imported), "");
}

TEST(MisplacedLinksTest, ShapesBesideTheirPictureAreTold) {
  ImportedHand imported = MakeBoxHand();
  ImportedHand::Visual& seen = imported.visuals.emplace_back();
  seen.link = 1;
  seen.visual.solid = MakeBox(1, {0, 0, 0.0225}, {0.016, 0.016, 0.045});
  EXPECT_EQ(TellMisplaced(imported), "");
  seen.visual.solid = MakeBox(1, {0.03, 0, 0.0225}, {0.016, 0.016, 0.045});
  ExpectTold(imported, "link \"left_near\": what it touches with lies 14 mm beside its picture");
  seen.visual.solid = MakeBox(1, {0, 0, 0.0225}, {0.04, 0.04, 0.12});
  ExpectTold(imported, "what it touches with is 45 mm long, its picture 120 mm");
}

}  // namespace
}  // namespace graspbench
