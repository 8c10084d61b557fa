#pragma once
/** @file
Which way the joints of a digit close, judged from their limits and, for slides, from where the
other digits are; a guess that holds for fingers as they are usually described. */

#include <vector>

#include "core/hand/hand.h"

namespace graspbench {

/** By joint, +1 or -1: which end of its range bends the digit towards the others; 0: neither, it
spreads or turns the digit, follows another joint, or belongs to no digit.

- A joint that turns about the same direction as the outermost one of its digit bends it; it closes
  towards the end that is farther from zero, where that is decided by a fifth of its range; where
  that decides no joint of a hand, to where the digits' tips come nearer to each other.
- One that slides closes towards the end at which its digit's tip is nearer to the other digits'.
- When all that brings the tips of two digits without slides nowhere nearer to each other, it is
  turned round: a gripper that is closed at zero. */
std::vector<int> FindClosing(const Hand& hand);

/** A position between the open (0) and the closed end (1) of every closing joint; the others where
their range is nearest to zero. Followers follow. */
Eigen::VectorXd CalcClosedPosture(const Hand& hand, const std::vector<int>& closing, double share);

/** A link of the digit moves with the joint: it is its own, or leads one of its own. */
bool MovesDigit(const Hand& hand, int joint, const Digit& digit);

/** Sets only the closing joints of one digit; followers, too, stay as they are in q. */
void CloseDigit(const Hand& hand, const std::vector<int>& closing, const Digit& digit, double share,
                Eigen::VectorXd& q);

}  // namespace graspbench
