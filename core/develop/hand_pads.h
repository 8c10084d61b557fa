#pragma once
/** @file
Pads as used by the rules of development: position and normal in a posture, and direction of the
fingertip that carries them; likewise for the side of a fingertip. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"

namespace graspbench {

struct PadState {
  Eigen::Vector3d p_HPad = Eigen::Vector3d::Zero();   ///< centre of the pad's surface [m]
  Eigen::Vector3d nhat_H = Eigen::Vector3d::UnitX();  ///< unit outward normal
  Eigen::Vector3d axis_H = Eigen::Vector3d::UnitZ();  ///< unit, along the last link to its tip
};

/** State of a digit's pad, in a posture with known link poses. The pad's normal is perpendicular to
the last link's axis, which runs from its joint to its tip. For a finger without thickness it points
away from the nearest ball of the link. */
PadState CalcPadState(const Hand& hand, const Digit& digit, const std::vector<Pose>& X_HL);

/** State of the side of a digit's last link, next to its pad. Its normal is along the axis about
which the link flexes, in either direction.
@param side  1: along that axis; -1: against it.  @pre the digit has a revolute joint. */
PadState CalcSideState(const Hand& hand, const Digit& digit, double side,
                       const std::vector<Pose>& X_HL);

/** Length of the longest finger except the thumb, base to tip, with all joints nearest to zero
[m]. */
double CalcFingerLength(const Hand& hand);

/** Driven joints of these digits, digit by digit from base to tip. */
std::vector<int> FindGraspJoints(const Hand& hand, const std::vector<std::string>& digits);

/** Jacobian of a digit's pad position with respect to `joints` (3 x size) [m/rad], [m/m]; coupled
joints follow. */
Eigen::MatrixXd CalcPadJacobian(const Hand& hand, const Digit& digit, const Eigen::VectorXd& q,
                                const std::vector<int>& joints);

}  // namespace graspbench
