#include "core/hand/import/checks/unlike_digits.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/base/units.h"
#include "tests/core/hand/import/checks/finger_row.h"

namespace graspbench {
namespace {

std::string TellUnlike(const ImportedHand& imported) {
  Diagnostics problems;
  FindUnlikeDigits("hand.urdf", imported, problems);
  return problems.Format();
}

TEST(UnlikeDigitsTest, AnAxisAgainstItsNeighboursIsTold) {
  EXPECT_EQ(TellUnlike(MakeRow(1.0, 0.0, 1.5)), "");
  EXPECT_NE(
      TellUnlike(MakeRow(-1.0, 0.0, 1.5)).find("joint \"bend_1\": its axis is the mirror image"),
      std::string::npos);
  EXPECT_EQ(TellUnlike(MakeRow(-1.0, -1.5, 0.0)),
            "");  // the limits are mirrored as well: same motion
}

/** Three fingers of one joint about a hub, each turned to it. */
ImportedHand MakeRing(double axis_of_second) {
  ImportedHand imported = MakeRow(axis_of_second, 0.0, 1.5);
  for (int i = 0; i < 3; ++i) {
    HandLink& link = imported.hand.links[static_cast<size_t>(i + 1)];
    const double angle = 2.0 * kPi / 3.0 * i;
    link.X_PJ = MakePose(MakeRotationRpy(0, 0, angle),
                         Eigen::Vector3d(0.05 * std::cos(angle), 0.05 * std::sin(angle), 0.05));
    link.axis = -link.axis;
  }
  return imported;
}

TEST(UnlikeDigitsTest, ACopyThatClosesAwayFromTheOthersIsTold) {
  EXPECT_EQ(TellUnlike(MakeRing(1.0)), "");
  const std::string told = TellUnlike(MakeRing(-1.0));
  EXPECT_NE(told.find("joint \"bend_1\": its axis is the mirror image of that of \"bend_0\", "
                      "\"bend_2\" of another digit"),
            std::string::npos)
      << told;
  EXPECT_EQ(told.find("bend_0\":"), std::string::npos);
}

// Two jaws whose frames are not turned to each other: opposite axes, and both close.
TEST(UnlikeDigitsTest, DigitsThatFaceEachOtherMayHaveOppositeAxes) {
  ImportedHand imported = MakeRow(-1.0, 0.0, 1.5);
  imported.hand.digits.pop_back();
  imported.hand.joints.pop_back();
  imported.hand.links.pop_back();
  imported.hand.links[1].X_PJ = MakePose(Eigen::Vector3d(-0.04, 0, 0.05));
  imported.hand.links[2].X_PJ = MakePose(Eigen::Vector3d(0.04, 0, 0.05));
  EXPECT_EQ(TellUnlike(imported), "");
}

TEST(UnlikeDigitsTest, ALimitUnlikeThoseOfTheFingersBesideItIsTold) {
  EXPECT_NE(TellUnlike(MakeRow(1.0, 0.0, 2.8)).find("\"bend_1\" turns by 160 deg, the like joints"),
            std::string::npos)
      << TellUnlike(MakeRow(1.0, 0.0, 2.8));
  EXPECT_NE(TellUnlike(MakeRow(1.0, 0.0, 0.8)).find("\"bend_1\" turns by 46 deg, the like joints"),
            std::string::npos);
}

TEST(UnlikeDigitsTest, AnAxisOfAnotherDirectionIsTold) {
  ImportedHand imported = MakeTwoJointRow();
  EXPECT_EQ(TellUnlike(imported), "");
  imported.hand.links[5].axis = Eigen::Vector3d::UnitZ();
  EXPECT_NE(
      TellUnlike(imported).find("joint \"knee_1\": its axis is 90 deg from those of the like"),
      std::string::npos)
      << TellUnlike(imported);
}

// Turned about its length, all its axes are: it is in the row by its place and direction.
TEST(UnlikeDigitsTest, AFingerTurnedAboutItsLengthIsTold) {
  ImportedHand imported = MakeTwoJointRow();
  imported.hand.links[2].X_PJ =
      MakePose(MakeRotationRpy(0, 0, 0.5 * kPi), Eigen::Vector3d(0, 0.03, 0.09));
  EXPECT_NE(TellUnlike(imported).find("joint \"bend_1\": its axis is 90 deg from those"),
            std::string::npos)
      << TellUnlike(imported);
}

TEST(UnlikeDigitsTest, AFingerOffItsRowIsTold) {
  ImportedHand imported = MakeRow(1.0, 0.0, 1.5);
  imported.hand.links[2].X_PJ = MakePose(Eigen::Vector3d(0.025, 0.03, 0.09));
  EXPECT_EQ(TellUnlike(imported), "");
  imported.hand.links[2].X_PJ = MakePose(Eigen::Vector3d(0.04, 0.03, 0.09));
  EXPECT_NE(TellUnlike(imported).find("\"finger_1\" stands 40 mm off the row"), std::string::npos)
      << TellUnlike(imported);
}

// Three copies about a hub: none is beside another.
TEST(UnlikeDigitsTest, AnotherAxisOfOneOfThreeCopiesIsTold) {
  ImportedHand imported = MakeTwoJointRow();
  for (int i = 0; i < 3; ++i) {
    const double angle = 2.0 * kPi / 3.0 * i;
    imported.hand.links[static_cast<size_t>(i + 1)].X_PJ =
        MakePose(MakeRotationRpy(0, 0, angle),
                 Eigen::Vector3d(0.05 * std::cos(angle), 0.05 * std::sin(angle), 0.05));
  }
  EXPECT_EQ(TellUnlike(imported), "");
  imported.hand.links[2].axis = Eigen::Vector3d::UnitX();
  EXPECT_NE(TellUnlike(imported).find("joint \"bend_1\" turns about another axis of its frame"),
            std::string::npos)
      << TellUnlike(imported);
}

TEST(UnlikeDigitsTest, AnEffortAndARatioUnlikeThoseBesideThemAreTold) {
  ImportedHand imported = MakeTwoJointRow();
  imported.drives.resize(6);
  for (ForeignDrive& drive : imported.drives) drive.effort = 0.5;
  for (int i = 0; i < 3; ++i) {
    HandJoint& follower = imported.hand.joints[static_cast<size_t>(i + 3)];
    follower.coupled_to = i;
    follower.is_mimic = true;
    follower.mimic_ratio = 0.8;
  }
  EXPECT_EQ(TellUnlike(imported), "");
  imported.hand.joints[4].mimic_ratio = 0.08;
  EXPECT_NE(TellUnlike(imported).find("\"tip_1\" follows another by 0.08, the like links beside it "
                                      "0.8"),
            std::string::npos)
      << TellUnlike(imported);
  imported.drives[1].effort = 0.05;
  EXPECT_NE(
      TellUnlike(imported).find("\"bend_1\" has an effort of 0.05 N m, the like joints beside "
                                "it 0.5 N m"),
      std::string::npos)
      << TellUnlike(imported);
}

TEST(UnlikeDigitsTest, AMassUnlikeThoseBesideItIsTold) {
  ImportedHand imported = MakeRow(1.0, 0.0, 1.5);
  imported.hand.links[2].mass = 0.055;
  EXPECT_EQ(TellUnlike(imported), "");
  imported.hand.links[2].mass = 0.065;
  EXPECT_NE(
      TellUnlike(imported).find("link \"finger_1\" weighs 65 g, the like links beside it 20 g"),
      std::string::npos)
      << TellUnlike(imported);
}

TEST(UnlikeDigitsTest, ALengthUnlikeThoseBesideItIsTold) {
  ImportedHand imported = MakeRow(1.0, 0.0, 1.5);
  for (int link = 1; link <= 3; ++link) {
    CollisionShape& shape = imported.shapes.emplace_back();
    shape.link = link;
    shape.kind = CollisionShape::Kind::kBox;
    shape.size = {0.01, 0.01, link == 2 ? 0.07 : 0.04};
  }
  EXPECT_EQ(TellUnlike(imported), "");
  imported.shapes[1].size.z() = 0.08;
  EXPECT_NE(
      TellUnlike(imported).find("link \"finger_1\" has a length of 80 mm, the like links beside it "
                                "40 mm"),
      std::string::npos)
      << TellUnlike(imported);
}

TEST(UnlikeDigitsTest, AJointElsewhereThanThoseBesideItIsTold) {
  ImportedHand imported = MakeTwoJointRow();
  imported.hand.links[5].X_PJ = MakePose(Eigen::Vector3d(0, 0, 0.05));
  EXPECT_EQ(TellUnlike(imported), "");
  imported.hand.links[5].X_PJ = MakePose(Eigen::Vector3d(0, 0, 0.06));
  EXPECT_NE(
      TellUnlike(imported).find("\"tip_1\" has its joint from the one before by 60 mm, the like "
                                "links beside it 30 mm"),
      std::string::npos)
      << TellUnlike(imported);
}

// A thumb of three joints has no neighbour to be compared with.
TEST(UnlikeDigitsTest, AJointThatBendsItsDigitTheOtherWayIsTold) {
  ImportedHand imported;
  Hand& hand = imported.hand;
  hand.links.resize(1);
  Digit digit;
  for (int i = 0; i < 3; ++i) {
    HandLink link;
    link.parent = i;
    link.joint = i;
    link.X_PJ = MakePose(Eigen::Vector3d(0, 0, 0.03));
    link.axis = Eigen::Vector3d::UnitX();
    HandJoint joint;
    joint.name = "bend_" + std::to_string(i);
    joint.link = i + 1;
    joint.upper = 1.2;
    hand.links.push_back(link);
    hand.joints.push_back(joint);
    digit.links.push_back(i + 1);
  }
  digit.distal_link = 3;
  digit.p_LTip = {0, 0, 0.03};
  hand.digits.push_back(digit);
  EXPECT_EQ(TellUnlike(imported), "");
  hand.links[2].axis = -hand.links[2].axis;
  EXPECT_NE(
      TellUnlike(imported).find("joint \"bend_1\" bends its digit the other way than the 2 other"),
      std::string::npos)
      << TellUnlike(imported);
  hand.joints[1].lower = -1.2;  // and closes towards the other end: the same motion
  hand.joints[1].upper = 0.0;
  EXPECT_EQ(TellUnlike(imported), "");
}

}  // namespace
}  // namespace graspbench
