#include "core/develop/posture_changes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/base/units.h"
#include "core/develop/propose_grasps.h"

namespace graspbench {
namespace {

constexpr double kFirstStep = RadFromDeg(3.0);
constexpr double kMostChange = RadFromDeg(30.0);
constexpr double kGapPerUnit = 0.04;   // [m/rad]
constexpr double kLargestGap = 0.015;  // [m]

double CalcUnit(const HandJoint& joint) {
  return joint.is_prismatic ? (joint.upper - joint.lower) / (0.5 * kPi) : 1.0;
}

/** Whether one range is the mirror image of the other, and is not symmetric itself. */
bool AreMirrored(const HandJoint& a, const HandJoint& b) {
  const double near = 0.05 * (a.upper - a.lower);
  return std::abs(a.lower + b.upper) < near && std::abs(a.upper + b.lower) < near &&
         std::abs(a.lower + a.upper) > 2.0 * near;
}

/** A palm that is sought is moved to the object, whatever its gap. */
bool HasGap(const Grasp& grasp) { return grasp.palm_may_touch && !grasp.seeks_palm; }

}  // namespace

PostureChanges::PostureChanges(const Hand& hand, Grasp grasp)
    : hand_(hand), grasp_(std::move(grasp)) {
  const int opposing = FindOpposingDigit(hand, grasp_);
  std::map<std::pair<size_t, size_t>, size_t> group_of_build;  // driven joints, index from base
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    const Digit& digit = hand.digits[d];
    if (!std::count(grasp_.digits.begin(), grasp_.digits.end(), digit.id)) continue;
    const std::vector<int> joints = FindDrivenJoints(hand, digit);
    for (size_t k = 0; k < joints.size(); ++k) {
      const HandJoint& joint = hand.joints[joints[k]];
      Move move{joints[k], CalcUnit(joint)};
      if (static_cast<int>(d) != opposing) {
        const auto [known, is_new] =
            group_of_build.emplace(std::pair(joints.size(), k), groups_.size());
        if (!is_new) {
          std::vector<Move>& group = groups_[known->second];
          const HandJoint& first = hand.joints[group.front().joint];
          if (AreMirrored(first, joint)) move.per_unit = -move.per_unit;
          group.push_back(move);
          continue;
        }
      }
      groups_.push_back({move});
    }
  }
}

SearchSpace PostureChanges::MakeSpace() const {
  const auto size = static_cast<Eigen::Index>(2 * groups_.size() + 1) + (HasGap(grasp_) ? 1 : 0);
  SearchSpace space;
  space.start = Eigen::VectorXd::Zero(size);
  space.lower = Eigen::VectorXd::Constant(size, -kMostChange);
  space.upper = Eigen::VectorXd::Constant(size, kMostChange);
  space.step = kFirstStep;
  return space;
}

Grasp PostureChanges::Apply(const Eigen::VectorXd& change) const {
  Grasp grasp = grasp_;
  const auto move = [&](const Move& moved, double by, Eigen::VectorXd& q) {
    const HandJoint& joint = hand_.joints[moved.joint];
    q[moved.joint] = std::clamp(q[moved.joint] + moved.per_unit * by, joint.lower, joint.upper);
  };
  const auto size = static_cast<Eigen::Index>(groups_.size());
  for (Eigen::Index g = 0; g < size; ++g) {
    for (const Move& moved : groups_[g]) {
      move(moved, change[g], grasp.q_pre);
      move(moved, change[size + g], grasp.q_target);
    }
  }
  grasp.tilt += change[2 * size];
  if (HasGap(grasp)) {
    grasp.palm_gap =
        std::clamp(grasp.palm_gap + kGapPerUnit * change[2 * size + 1], 0.0, kLargestGap);
  }
  RoundGrasp(hand_, grasp);
  return grasp;
}

}  // namespace graspbench
