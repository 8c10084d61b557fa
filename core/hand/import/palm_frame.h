#pragma once
/** @file
Where the digits of a hand can meet, and so which way its palm faces.

Each pair of the thumb and another digit closes, each digit by its own share of its range; where
the pads come nearest to each other, at half their open distance or less, they meet. When closing
alone brings no pair together, all joints of the pair are searched. The palm faces from the middle
of the digits' bases to the middle of the meeting points. */

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/hand/hand.h"

namespace graspbench {

struct DigitMeeting {
  Eigen::Vector3d p_H = Eigen::Vector3d::Zero();  ///< mean of where pairs meet [m]
  Eigen::Vector3d direction =
      Eigen::Vector3d::Zero();  ///< from the digits' bases to it; unit, or 0
  double gap = 0.0;             ///< of the pads that come nearest [m]
};

/** Nothing: no pair meets. @param left_out  by digit: it is not asked; the thumb always is.
@pre digits with tips and pads, one of them the thumb. */
std::optional<DigitMeeting> FindMeeting(const Hand& hand, const std::vector<bool>& left_out);

/** Postures that move all joints of two digits, evenly spread (Kronecker sequence); the others stay
as in `open`. @param number  from 1. */
Eigen::VectorXd MakePairSample(const Hand& hand, const Eigen::VectorXd& open, const Digit& a,
                               const Digit& b, int number);

}  // namespace graspbench
