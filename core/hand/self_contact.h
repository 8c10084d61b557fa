#pragma once
/** @file
Which capsules of a hand can meet each other, and how near they are: fingers against each other and
against the palm. A finger cannot reach itself, what touches in the rest posture is built that way,
and Hand::apart names links that never count. */

#include <Eigen/Core>
#include <vector>

#include "core/base/pose.h"
#include "core/hand/hand.h"

namespace graspbench {

struct ClosestPoints {
  Eigen::Vector3d on_a, on_b;
};
/** Nearest points of two segments (Ericson 2005, section 5.1.9). */
ClosestPoints FindClosestPoints(const Eigen::Vector3d& a0, const Eigen::Vector3d& a1,
                                const Eigen::Vector3d& b0, const Eigen::Vector3d& b1);

/** Indices into hand.capsules. */
struct CapsulePair {
  int a = -1, b = -1;
};
std::vector<CapsulePair> FindCapsulePairs(const Hand& hand);

/** Between the surfaces of the pair; negative: inside each other [m]. */
double CalcCapsuleGap(const Hand& hand, const CapsulePair& pair, const std::vector<Pose>& X_HL);

}  // namespace graspbench
