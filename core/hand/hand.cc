#include "core/hand/hand.h"

#include <algorithm>

#include "core/base/enum_table.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

// A middle joint this close to its upper limit is at its end. It must come back twice as far before
// it moves again, so that an elastic limit does not make the mode flicker.
constexpr double kEndMargin = RadFromDeg(0.5);

}  // namespace

DistalRates CalcDistalRates(CouplingRule rule, double fixed_ratio, DistalMode mode) {
  switch (rule) {
    case CouplingRule::kEven:
      return {1.0, 1.0};
    case CouplingRule::kFixed:
      return {1.0, fixed_ratio};
    case CouplingRule::kMiddleFirst:
      break;
  }
  return mode == DistalMode::kMiddleMoves ? DistalRates{1.0, 0.0} : DistalRates{0.0, 1.0};
}

DistalMode FindDistalMode(double q_middle, double q_distal, double middle_upper, bool closing,
                          bool middle_is_blocked, DistalMode previous) {
  if (!closing) return q_distal > 0.0 ? DistalMode::kDistalMoves : DistalMode::kMiddleMoves;
  const double margin = previous == DistalMode::kDistalMoves ? 2.0 * kEndMargin : kEndMargin;
  const bool is_at_end = q_middle >= middle_upper - margin;
  const bool distal_may_close = q_distal < q_middle;
  return (middle_is_blocked || is_at_end) && distal_may_close ? DistalMode::kDistalMoves
                                                              : DistalMode::kMiddleMoves;
}

void ApplyCoupling(const Hand& hand, Eigen::VectorXd& q) {
  for (int j = 0; j < hand.num_joints(); ++j) {
    const HandJoint& joint = hand.joints[j];
    if (joint.coupled_to < 0) continue;
    if (joint.is_mimic) {
      q[j] = joint.mimic_offset + joint.mimic_ratio * q[joint.coupled_to];
      continue;
    }
    // Without contact, under middle-first, the distal joint has not begun to move.
    double distal = 0.0;
    if (hand.coupling != CouplingRule::kMiddleFirst) {
      const DistalRates rates =
          CalcDistalRates(hand.coupling, hand.fixed_coupling_ratio, DistalMode::kMiddleMoves);
      distal = rates.distal * q[joint.coupled_to];
    }
    q[j] = std::clamp(distal, joint.lower, joint.upper);
  }
}

namespace {

struct CouplingRuleRow {
  CouplingRule value;
  const char* name;
};
constexpr CouplingRuleRow kCouplingRules[] = {{CouplingRule::kMiddleFirst, "middle-first"},
                                              {CouplingRule::kEven, "even"},
                                              {CouplingRule::kFixed, "fixed"}};

template <class Item>
int FindByName(const std::vector<Item>& items, const std::string& name) {
  for (size_t i = 0; i < items.size(); ++i) {
    if (items[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace

std::string NameOf(CouplingRule rule) { return RowOf(kCouplingRules, rule).name; }

const std::vector<CouplingRule>& ListCouplingRules() {
  static const std::vector<CouplingRule> rules = [] {
    std::vector<CouplingRule> all;
    for (const CouplingRuleRow& row : kCouplingRules) all.push_back(row.value);
    return all;
  }();
  return rules;
}

int Hand::FindJoint(const std::string& joint_name) const { return FindByName(joints, joint_name); }
int Hand::FindLink(const std::string& link_name) const { return FindByName(links, link_name); }

int Hand::FindDigitOfLink(int link) const {
  for (size_t d = 0; d < digits.size(); ++d) {
    for (int l : digits[d].links) {
      if (l == link) return static_cast<int>(d);
    }
  }
  return -1;
}

std::vector<int> FindDrivenJoints(const Hand& hand, const Digit& digit) {
  std::vector<int> driven;
  for (int link : digit.links) {
    const int joint = hand.links[link].joint;
    if (joint >= 0 && hand.joints[joint].coupled_to < 0) driven.push_back(joint);
  }
  return driven;
}

double ToDisplayUnits(const HandJoint& joint, double position) {
  return joint.is_prismatic ? MmFromM(position) : DegFromRad(position);
}

double FromDisplayUnits(const HandJoint& joint, double displayed) {
  return joint.is_prismatic ? MFromMm(displayed) : RadFromDeg(displayed);
}

const char* DisplayUnitOf(const HandJoint& joint) { return joint.is_prismatic ? "mm" : "deg"; }

namespace {

/** X_HL from the pose X_HJ of the joint frame. */
Pose MoveJoint(const Hand& hand, const HandLink& link, Pose X_HJ, const Eigen::VectorXd& q) {
  if (link.joint < 0) return X_HJ;
  if (hand.joints[link.joint].is_prismatic) {
    X_HJ.translate(q[link.joint] * link.axis);
  } else {
    X_HJ.rotate(Eigen::AngleAxisd(q[link.joint], link.axis));
  }
  return X_HJ;
}

}  // namespace

std::vector<Pose> CalcLinkPoses(const Hand& hand, const Eigen::VectorXd& q) {
  std::vector<Pose> X_HL(hand.links.size(), Pose::Identity());
  for (size_t i = 0; i < hand.links.size(); ++i) {
    const HandLink& link = hand.links[i];
    X_HL[i] = MoveJoint(hand, link, link.parent < 0 ? link.X_PJ : X_HL[link.parent] * link.X_PJ, q);
  }
  return X_HL;
}

Pose CalcLinkPose(const Hand& hand, const Eigen::VectorXd& q, int index) {
  const HandLink& link = hand.links[index];
  return MoveJoint(hand, link,
                   link.parent < 0 ? link.X_PJ : CalcLinkPose(hand, q, link.parent) * link.X_PJ, q);
}

}  // namespace graspbench
