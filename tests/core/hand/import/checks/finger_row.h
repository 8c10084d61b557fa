#pragma once
/** @file
Fingers in a row, for checks of what is described unlike its neighbours. */

#include "core/hand/import/weld_links.h"

namespace graspbench {

/** Three fingers of one joint in a row along y, 50 mm long along z, that bend about y. */
inline ImportedHand MakeRow(double axis_of_middle, double lower_of_middle, double upper_of_middle) {
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

/** The same with a second joint each, 30 mm from the first: knee_0 to knee_2, links tip_0 to 2. */
inline ImportedHand MakeTwoJointRow() {
  ImportedHand imported = MakeRow(1.0, 0.0, 1.5);
  Hand& hand = imported.hand;
  for (int i = 0; i < 3; ++i) {
    HandLink link = hand.links[static_cast<size_t>(i + 1)];
    link.name = "tip_" + std::to_string(i);
    link.parent = i + 1;
    link.joint = i + 3;
    link.X_PJ = MakePose(Eigen::Vector3d(0, 0, 0.03));
    HandJoint joint = hand.joints[static_cast<size_t>(i)];
    joint.name = "knee_" + std::to_string(i);
    joint.link = i + 4;
    Digit& digit = hand.digits[static_cast<size_t>(i)];
    digit.links.push_back(i + 4);
    digit.distal_link = i + 4;
    hand.links.push_back(link);
    hand.joints.push_back(joint);
  }
  return imported;
}

}  // namespace graspbench
