#include "human_study/recording/importers/glove.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/hand/coupling.h"
#include "core/hand/load_hand.h"

namespace graspbench {

std::vector<std::string> GloveMapping::ListColumns() const {
  std::vector<std::string> columns;
  for (const auto& [joint, column] : joints) columns.push_back(column);
  columns.insert(columns.end(), base.begin(), base.end());
  columns.insert(columns.end(), quaternion.begin(), quaternion.end());
  return columns;
}

GloveModel::GloveModel(const GloveMapping& mapping)
    : hand_(std::make_shared<const Hand>(LoadHand(mapping.hand))) {
  std::vector<std::string> known;
  for (const HandJoint& joint : hand_->joints) {
    if (!joint.is_mimic && !joint.is_prismatic) known.push_back(joint.name);
  }
  for (const auto& [name, column] : mapping.joints) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw Error(ErrorKind::kFormat, "glove: the hand " + mapping.hand + " has no joint \"" +
                                          name + "\" of its own that turns" +
                                          SuggestNames(name, known));
    }
    joints_.push_back(hand_->FindJoint(name));
  }
  factor_ = mapping.is_in_degrees ? kPi / 180.0 : 1.0;
  for (const Digit& digit : hand_->digits) labels_.push_back(digit.name + "_tip");
  labels_.push_back("wrist");
}

std::string GloveModel::Describe() const {
  return std::to_string(joints_.size()) + " of " + std::to_string(hand_->num_joints()) +
         " joints are named, the others are straight or coupled; the bones are those of " +
         hand_->name + ", not the person's";
}

std::vector<Eigen::Vector3d> GloveModel::CalcPoints(const std::vector<double>& cells,
                                                    double metres_per_unit) const {
  const size_t n = joints_.size();
  if (!std::all_of(cells.begin(), cells.end(), [](double cell) { return std::isfinite(cell); })) {
    return {};
  }
  Eigen::VectorXd q = Eigen::VectorXd::Zero(hand_->num_joints());
  ApplyCoupling(*hand_, q);
  for (size_t i = 0; i < n; ++i) q(joints_[i]) = factor_ * cells[i];
  // A linkage follows what was measured; a distal joint that was measured stays.
  Eigen::VectorXd coupled = q;
  ApplyCoupling(*hand_, coupled);
  for (int i = 0; i < hand_->num_joints(); ++i) {
    if (std::find(joints_.begin(), joints_.end(), i) == joints_.end()) q(i) = coupled(i);
  }
  const Eigen::Vector3d p = metres_per_unit * Eigen::Vector3d(cells[n], cells[n + 1], cells[n + 2]);
  const Eigen::Quaterniond rotation(cells[n + 6], cells[n + 3], cells[n + 4], cells[n + 5]);
  constexpr double kMaxOff = 0.01;  // of its length from 1
  if (std::abs(rotation.norm() - 1.0) > kMaxOff) return {};
  const Eigen::Matrix3d r = rotation.normalized().toRotationMatrix();
  std::vector<Eigen::Vector3d> points;
  for (const Digit& digit : hand_->digits) {
    const Eigen::Vector3d p_H = CalcLinkPose(*hand_, q, digit.distal_link) * digit.p_LPad;
    points.push_back((p + r * p_H) / metres_per_unit);
  }
  points.push_back(p / metres_per_unit);
  return points;
}

}  // namespace graspbench
