#pragma once

#include "core/hand/hand.h"

namespace graspbench {

/** A ball of 10 mm radius at the origin and a capsule beside it, on two links. */
inline Hand MakeBallAndRod() {
  Hand hand;
  hand.links.resize(2);
  hand.links[0].name = "ball";
  hand.links[1].name = "rod";
  hand.capsules = {{0, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.01},
                   {1, Eigen::Vector3d::Zero(), Eigen::Vector3d(0.0, 0.03, 0.0), 0.005}};
  return hand;
}

}  // namespace graspbench
