#pragma once
/** @file
Direction in which the joints of a digit close. It is inferred from the joint limits and, for
prismatic joints, from the positions of the other digits. The heuristic holds for fingers as they
are usually described. */

#include <vector>

#include "core/hand/hand.h"

namespace graspbench {

/** Closing direction by joint, +1 or -1: the end of the range that bends the digit towards the
others. It is 0 if the joint spreads or twists the digit, follows another joint, or belongs to no
digit.

- A revolute joint bends its digit if its axis is roughly parallel to that of the digit's outermost
  joint. It closes towards the end farther from zero, provided that the ends differ by a fifth of
  the range. If this decides no joint of the hand, each digit closes so that its tip approaches the
  others.
- A prismatic joint closes towards the end at which its digit's tip is nearer to the other tips.
- If no amount of closing brings the tips of two digits without slides nearer together, all
  directions are reversed: a gripper that is closed at zero. */
std::vector<int> FindClosing(const Hand& hand);

/** Posture with every closing joint at `share` between its open (0) and its closed end (1). Other
joints are as near to zero as their range allows; coupled joints follow. */
Eigen::VectorXd CalcClosedPosture(const Hand& hand, const std::vector<int>& closing, double share);

/** Whether the joint moves a link of the digit, directly or through a joint that follows it. */
bool MovesDigit(const Hand& hand, int joint, const Digit& digit);

/** Sets only the closing joints of one digit in q; coupled joints also stay unchanged. */
void CloseDigit(const Hand& hand, const std::vector<int>& closing, const Digit& digit, double share,
                Eigen::VectorXd& q);

}  // namespace graspbench
