#pragma once
/** @file
Pads as the rules of development see them: where they are in a posture, which way they face, and
how the fingertip that carries them points; so is the side of a fingertip. */

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"

namespace graspbench {

struct PadState {
  Eigen::Vector3d p_HPad = Eigen::Vector3d::Zero();   ///< middle of the pad's surface [m]
  Eigen::Vector3d nhat_H = Eigen::Vector3d::UnitX();  ///< unit, out of the pad
  Eigen::Vector3d axis_H = Eigen::Vector3d::UnitZ();  ///< unit, along the last link to its tip
};

/** Of one digit, in a posture whose link poses are known. The pad faces across the last link's
axis, which runs from its joint to its tip; of a finger without thickness, away from the nearest
ball of the link. */
PadState CalcPadState(const Hand& hand, const Digit& digit, const std::vector<Pose>& X_HL);

/** The side of a digit's last link, beside its pad: out of it along the axis about which the link
flexes, to the one side or the other.
@param side  1: along that axis; -1: against it.  @pre the digit has a joint that turns. */
PadState CalcSideState(const Hand& hand, const Digit& digit, double side,
                       const std::vector<Pose>& X_HL);

/** Length of the longest finger, thumb aside, base to tip with all joints nearest to zero [m]. */
double CalcFingerLength(const Hand& hand);

/** Joints of these digits that a drive moves, digit by digit from base to tip. */
std::vector<int> FindGraspJoints(const Hand& hand, const std::vector<std::string>& digits);

/** Movement of a digit's pad for a unit of each of `joints` (3 x size) [m/rad], [m/m]; followers
follow. */
Eigen::MatrixXd CalcPadJacobian(const Hand& hand, const Digit& digit, const Eigen::VectorXd& q,
                                const std::vector<int>& joints);

}  // namespace graspbench
