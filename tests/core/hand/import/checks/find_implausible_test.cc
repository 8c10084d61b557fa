#include "core/hand/import/checks/find_implausible.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/base/units.h"
#include "tests/core/hand/import/checks/finger_row.h"

namespace graspbench {
namespace {

std::string Tell(const ImportedHand& imported) {
  Diagnostics problems;
  FindImplausible("hand.urdf", imported, problems);
  return problems.Format();
}

TEST(FindImplausibleTest, AJointThatHardlyMovesIsTold) {
  EXPECT_EQ(Tell(MakeRow(1.0, 0.0, 0.02)).find("next to stuck"), std::string::npos);
  EXPECT_NE(Tell(MakeRow(1.0, 0.0, 0.004))
                .find("1 joint next to stuck, \"bend_1\": the first moves by 0.23 deg"),
            std::string::npos);
}

TEST(FindImplausibleTest, AJointThatTurnsFartherThanAFingersIsTold) {
  EXPECT_EQ(Tell(MakeRow(1.0, 0.0, 2.6)), "");
  EXPECT_NE(Tell(MakeRow(1.0, 0.0, 3.7)).find("1 joint (\"bend_1 212 deg\") may turn farther"),
            std::string::npos)
      << Tell(MakeRow(1.0, 0.0, 3.7));
}

/** Two jaws that slide along y from 60 mm apart. */
ImportedHand MakeJaws(double axis_of_second, double lower, double upper) {
  ImportedHand imported;
  Hand& hand = imported.hand;
  hand.links.resize(1);
  hand.links[0].mass = 0.4;
  for (int i = 0; i < 2; ++i) {
    HandLink link;
    link.parent = 0;
    link.joint = i;
    link.X_PJ = MakePose(Eigen::Vector3d(0, i == 0 ? 0.03 : -0.06, 0));
    link.axis = (i == 1 ? axis_of_second : 1.0) * Eigen::Vector3d::UnitY();
    link.mass = 0.05;
    HandJoint joint;
    joint.name = i == 0 ? "first" : "second";
    joint.is_prismatic = true;
    joint.link = i + 1;
    joint.lower = i == 0 ? 0.0 : lower;
    joint.upper = i == 0 ? 0.025 : upper;
    Digit digit;
    digit.links = {i + 1};
    digit.distal_link = i + 1;
    digit.p_LTip = digit.p_LPad = {0, 0, 0.05};
    hand.links.push_back(link);
    hand.joints.push_back(joint);
    hand.digits.push_back(digit);
  }
  return imported;
}

TEST(FindImplausibleTest, JawsThatRunTheSameWayAreTold) {
  EXPECT_NE(Tell(MakeJaws(1.0, 0.0, 0.025)).find("jaws of \"first\" and \"second\" run the same"),
            std::string::npos)
      << Tell(MakeJaws(1.0, 0.0, 0.025));
  EXPECT_EQ(Tell(MakeJaws(-1.0, 0.0, 0.025)), "");
  EXPECT_EQ(Tell(MakeJaws(1.0, -0.025, 0.0)), "");
}

// 0.4 kg of a palm in a cube of 50 mm: 3200 kg/m^3; of 150 mm 119, of 25 mm 25600.
TEST(FindImplausibleTest, ADensityOfNoHandIsTold) {
  ImportedHand imported = MakeRow(1.0, 0.0, 1.5);
  CollisionShape& cube = imported.shapes.emplace_back();
  cube.link = 0;
  cube.kind = CollisionShape::Kind::kBox;
  cube.size.setConstant(0.05);
  EXPECT_EQ(Tell(imported), "");
  cube.size.setConstant(0.05 * 3.0);
  EXPECT_NE(Tell(imported).find("a mass of 0.4 kg in 3.37e+03 cm^3 of shapes, 1.2e+02 kg/m^3"),
            std::string::npos)
      << Tell(imported);
  cube.size.setConstant(0.05 * 0.5);
  EXPECT_NE(Tell(imported).find("cm^3 of shapes, 2.6e+04 kg/m^3"), std::string::npos)
      << Tell(imported);
}

TEST(FindImplausibleTest, ALengthOfNoHandIsTold) {
  ImportedHand imported = MakeRow(1.0, 0.0, 1.5);
  for (Digit& digit : imported.hand.digits) digit.p_LTip *= 5.2;
  EXPECT_NE(Tell(imported).find("the longest digit is 260 mm long"), std::string::npos);
  for (Digit& digit : imported.hand.digits) digit.p_LTip *= 0.1;
  EXPECT_NE(Tell(imported).find("the longest digit is 26 mm long"), std::string::npos);
}

TEST(FindImplausibleTest, AHandOfLessThanTenGramsIsTold) {
  ImportedHand imported = MakeRow(1.0, 0.0, 1.5);
  for (HandLink& link : imported.hand.links) link.mass *= 1e-6;
  EXPECT_NE(Tell(imported).find("a mass of 0.00046 g in all"), std::string::npos) << Tell(imported);
}

TEST(FindImplausibleTest, APalmOfFiftyTimesTheDigitsIsTold) {
  ImportedHand imported = MakeRow(1.0, 0.0, 1.5);
  imported.hand.links[0].mass = 2.9;  // 48 times 60 g
  EXPECT_EQ(Tell(imported), "");
  imported.hand.links[0].mass = 3.1;
  EXPECT_NE(Tell(imported).find("52 times as much as all digits, 60 g"), std::string::npos)
      << Tell(imported);
}

// A joint of the second finger that follows the first finger's, behind one with a drive of its own.
TEST(FindImplausibleTest, AJointTiedToAnotherDigitBehindADriveIsTold) {
  ImportedHand imported = MakeRow(1.0, 0.0, 1.5);
  HandLink link = imported.hand.links[2];
  link.name = "second_tip";
  link.parent = 2;
  link.joint = 3;
  HandJoint joint = imported.hand.joints[1];
  joint.name = "second_knee";
  joint.link = 4;
  joint.coupled_to = 1;
  joint.is_mimic = true;
  imported.hand.links.push_back(link);
  imported.hand.joints.push_back(joint);
  imported.hand.digits[1].links.push_back(4);
  imported.hand.digits[1].distal_link = 4;
  EXPECT_EQ(Tell(imported).find("tied to the wrong joint"), std::string::npos) << Tell(imported);
  imported.hand.joints[3].coupled_to = 0;
  EXPECT_NE(Tell(imported).find("joint \"second_knee\" follows \"bend_0\" of another digit, while "
                                "\"bend_1\" before it has a drive of its own"),
            std::string::npos)
      << Tell(imported);
}

}  // namespace
}  // namespace graspbench
