#pragma once
/** @file
The changes of a grasp's postures that the development searches among, few enough for some hundred
evaluations: fingers of one build change together, the opposing digit by itself.

A coordinate moves one joint of the opposing digit, or one of each finger with as many driven joints
(the same from the base), in the pre-grasp or in the target, or the tilt, or the gap of a palm that
may touch and is not sought. Joints with mirrored limits move against each other. The unit is a
radian; of a slide, its range counts as a quarter turn, of the gap 40 mm as a radian. */

#include <Eigen/Core>
#include <vector>

#include "core/grasp/standard_grasp.h"
#include "core/hand/hand.h"
#include "core/optimise/methods/search.h"

namespace graspbench {

class PostureChanges {
 public:
  PostureChanges(const Hand& hand, Grasp grasp);

  /** No change at the start; 30 degrees either way at most. */
  SearchSpace MakeSpace() const;
  /** The grasp, changed and within the joints' limits. */
  Grasp Apply(const Eigen::VectorXd& change) const;

 private:
  struct Move {
    int joint = -1;
    double per_unit = 1.0;  ///< of the coordinate
  };

  const Hand& hand_;
  Grasp grasp_;
  std::vector<std::vector<Move>> groups_;  ///< of joints that change together
};

}  // namespace graspbench
