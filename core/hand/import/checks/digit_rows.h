#pragma once
/** @file
Digits as rows of joints, to compare those that stand side by side. */

#include <Eigen/Core>
#include <vector>

#include "core/hand/hand.h"

namespace graspbench {

/** A digit's joints that bend it, from base to tip, and how it stands at the open hand. In H. */
struct DigitRow {
  const Digit* digit = nullptr;
  Eigen::Vector3d base = Eigen::Vector3d::Zero();   ///< of its first joint [m]
  Eigen::Vector3d along = Eigen::Vector3d::Zero();  ///< from there to its tip; unit, or 0
  std::vector<int> joints;
  std::vector<Eigen::Vector3d> turns;  ///< about which these close
  std::vector<Eigen::Vector3d> axes;   ///< by link of the digit, as described
};
std::vector<DigitRow> MakeDigitRows(const Hand& hand);

/** Fingers that stand in a row, along the axes about which they bend, with as many links: what is
built alike must be described alike. Half of their axes at least have that direction. */
bool AreSideBySide(const DigitRow& a, const DigitRow& b);

/** The digit stands in the row of two others that are side by side and bend the same way: parallel
to them, with as many links, whichever way it bends. @param off_line  of its base from the line
through theirs, at most [m]. */
bool IsInRowOf(const DigitRow& digit, const DigitRow& a, const DigitRow& b, double off_line);

/** From the base to the tip, at the open hand [m]. */
double CalcLongestDigit(const Hand& hand);

}  // namespace graspbench
