#pragma once
/** @file
A hand of boxes: a palm of 80 x 30 x 100 mm, two fingers along z that bend towards -y and a thumb in
front of them that bends towards +y; each digit has links of 45 and 30 mm, 16 mm thick. */

#include <Eigen/Geometry>

#include "core/base/units.h"
#include "core/hand/import/weld_links.h"

namespace graspbench {

inline CollisionShape MakeBox(int link, const Eigen::Vector3d& middle,
                              const Eigen::Vector3d& size) {
  CollisionShape box;
  box.link = link;
  box.X_LS = MakePose(middle);
  box.kind = CollisionShape::Kind::kBox;
  box.size = size;
  return box;
}

/** Adds the digit's links 2 d + 1 and 2 d + 2. */
inline void AddBoxDigit(const std::string& name, const Pose& X_PJ, ImportedHand& imported) {
  Hand& hand = imported.hand;
  Digit digit;
  for (int k = 0; k < 2; ++k) {
    HandLink link;
    link.name = name + (k == 0 ? "_near" : "_far");
    link.parent = k == 0 ? 0 : static_cast<int>(hand.links.size()) - 1;
    link.joint = hand.num_joints();
    link.X_PJ = k == 0 ? X_PJ : MakePose(Eigen::Vector3d(0, 0, 0.045));
    HandJoint joint;
    joint.name = link.name + "_bend";
    joint.link = static_cast<int>(hand.links.size());
    joint.upper = 1.5;
    const double length = k == 0 ? 0.045 : 0.03;
    imported.shapes.push_back(MakeBox(joint.link, {0, 0, 0.5 * length}, {0.016, 0.016, length}));
    digit.links.push_back(joint.link);
    hand.links.push_back(link);
    hand.joints.push_back(joint);
  }
  digit.distal_link = digit.links.back();
  digit.p_LTip = {0, 0, 0.03};
  digit.p_LPad = {0, -0.008, 0.018};
  hand.digits.push_back(digit);
}

inline ImportedHand MakeBoxHand() {
  ImportedHand imported;
  imported.hand.links.resize(1);
  imported.hand.links[0].name = "palm";
  imported.shapes.push_back(MakeBox(0, {0, 0, 0.05}, {0.08, 0.03, 0.1}));
  AddBoxDigit("left", MakePose(Eigen::Vector3d(-0.02, 0, 0.102)), imported);
  AddBoxDigit("right", MakePose(Eigen::Vector3d(0.02, 0, 0.102)), imported);
  // Half a turn about z: its pad faces +y. In front of the palm, 60 mm from the fingers.
  AddBoxDigit("thumb", MakePose(MakeRotationRpy(0, 0, kPi), Eigen::Vector3d(0, -0.06, 0.09)),
              imported);
  imported.shapes.push_back(MakeBox(0, {0, -0.04, 0.08}, {0.02, 0.06, 0.02}));  // carries it
  return imported;
}

}  // namespace graspbench
