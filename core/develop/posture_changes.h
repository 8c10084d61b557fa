#pragma once
/** @file
Posture changes among which the development searches. They are few enough for some hundred
evaluations: similar fingers change together, the opposing digit separately.

A coordinate moves one joint of the opposing digit, or the same joint, counted from the base, of all
fingers with as many driven joints. It changes the pre-grasp or the target. Further coordinates are
the tilt, and the gap of a palm that may touch but is not sought. Joints with mirrored limits move
in opposite directions. The unit is a radian: the range of a slide counts as a quarter turn, and 40
mm of the gap as a radian. */

#include <Eigen/Core>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/optimise/methods/search.h"

namespace graspbench {

class PostureChanges {
 public:
  PostureChanges(const Hand& hand, Grasp grasp);

  /** The start is no change; the bounds are 30 degrees in either direction. */
  SearchSpace MakeSpace() const;
  /** Returns the changed grasp, within the joint limits. */
  Grasp Apply(const Eigen::VectorXd& change) const;

 private:
  struct Move {
    int joint = -1;
    double per_unit = 1.0;  ///< change per unit of the coordinate
  };

  const Hand& hand_;
  Grasp grasp_;
  std::vector<std::vector<Move>> groups_;  ///< joints that change together
};

}  // namespace graspbench
