#include "core/hand/import/find_implausible.h"

#include <gtest/gtest.h>

namespace graspbench {
namespace {

/** Three fingers of one joint in a row along y, 50 mm long along z, that bend about y. */
ImportedHand MakeRow(double axis_of_middle, double lower_of_middle, double upper_of_middle) {
  ImportedHand imported;
  Hand& hand = imported.hand;
  hand.links.resize(1);
  hand.links[0].name = "palm";
  hand.links[0].mass = 0.4;
  for (int i = 0; i < 3; ++i) {
    HandLink link;
    link.name = "finger_" + std::to_string(i);
    link.parent = 0;
    link.joint = i;
    link.X_PJ = MakePose(Eigen::Vector3d(0, 0.03 * i, 0.09));
    link.axis = (i == 1 ? axis_of_middle : 1.0) * Eigen::Vector3d::UnitY();
    link.mass = 0.02;
    HandJoint joint;
    joint.name = "bend_" + std::to_string(i);
    joint.link = i + 1;
    joint.lower = i == 1 ? lower_of_middle : 0.0;
    joint.upper = i == 1 ? upper_of_middle : 1.5;
    Digit digit;
    digit.links = {i + 1};
    digit.distal_link = i + 1;
    digit.p_LTip = {0, 0, 0.05};
    hand.links.push_back(link);
    hand.joints.push_back(joint);
    hand.digits.push_back(digit);
  }
  return imported;
}

std::string Tell(const ImportedHand& imported) {
  Diagnostics problems;
  FindImplausible("hand.urdf", imported, problems);
  return problems.Format();
}

TEST(FindImplausibleTest, AnAxisAgainstItsNeighboursIsTold) {
  EXPECT_EQ(Tell(MakeRow(1.0, 0.0, 1.5)), "");
  EXPECT_NE(Tell(MakeRow(-1.0, 0.0, 1.5)).find("joint \"bend_1\": its axis is the mirror image"),
            std::string::npos);
  EXPECT_EQ(Tell(MakeRow(-1.0, -1.5, 0.0)), "");  // the limits are mirrored as well: same motion
}

TEST(FindImplausibleTest, APalmOfFiftyTimesTheDigitsIsTold) {
  ImportedHand imported = MakeRow(1.0, 0.0, 1.5);
  imported.hand.links[0].mass = 2.9;  // 48 times 60 g
  EXPECT_EQ(Tell(imported), "");
  imported.hand.links[0].mass = 3.1;
  EXPECT_NE(Tell(imported).find("52 times as much as all digits, 60 g"), std::string::npos)
      << Tell(imported);
}

}  // namespace
}  // namespace graspbench
