#include "core/develop/posture_rules.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/hand/hand.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// Relevant deviations from the rules.
constexpr double kLength = 0.005;      // [m]
constexpr double kHeight = 0.004;      // of pads at one level [m]
constexpr double kStraight = 0.004;    // sideways [m]
constexpr double kFacing = 0.5;        // of a unit normal, met
constexpr double kFacingOpen = 1.2;    // likewise, open
constexpr double kWideGap = 0.015;     // excess of the gap of neighbouring pads [m]
constexpr double kCosine = 0.2;        // of fingertips
constexpr double kShare = 0.008;       // of the thumb's distance [m]
constexpr double kEase = 8.0;          // ranges of a joint
constexpr double kLeaderEase = 0.15;   // of a joint that should stay straight
constexpr double kDeepestTip = 0.012;  // tips below their pads [m]
constexpr double kAbovePads = 0.008;   // all other parts of the hand [m]
constexpr double kOutside = 0.05;      // ranges beyond a limit
constexpr double kOffPalm = 0.01;      // horizontal distance of pad centre and palm centre [m]

}  // namespace

/** Heights are along the approach: larger is nearer to the table. */
struct PostureRules::Stand {
  PadState thumb;
  std::vector<PadState> fingers;
  Vector3d p_HFingers = Vector3d::Zero();  ///< mean of their pads
  double opening = 0.0;                    ///< across the approach [m]
  Vector3d across_H = Vector3d::UnitX();   ///< unit, thumb to fingers
  double height = 0.0;                     ///< mean height of the pads [m]
  double tips = 0.0;                       ///< lowest point of the links with pads [m]
  double palm = 0.0;                       ///< lowest point of the palm [m]
  double rest = 0.0;                       ///< lowest point of all other links [m]
};

PostureRules::PostureRules(const Hand& hand, const PostureAim& aim, const VectorXd& q_rest)
    : hand_(hand), aim_(aim), q_rest_(q_rest), joints_(FindGraspJoints(hand, aim.digits)) {
  Grasp grasp;
  grasp.digits = aim.digits;
  opposing_ = &hand.digits[FindOpposingDigit(hand, grasp)];
  is_tip_.resize(hand.links.size(), false);
  for (const Digit& digit : hand.digits) {
    if (!std::count(aim.digits.begin(), aim.digits.end(), digit.id)) continue;
    is_tip_[digit.distal_link] = true;
    if (&digit != opposing_) fingers_.push_back(&digit);
  }
  GRASPBENCH_DEMAND(!fingers_.empty(), "a grasp needs two digits");
  FindSides();
  normal_H_ = CalcApproachDirection(hand, 0.0);
  forward_H_ = CalcApproachDirection(hand, 0.5 * kPi);
}

/** Selects the sides that face each other at rest. */
void PostureRules::FindSides() {
  sides_.assign(fingers_.size() + 1, 0.0);
  if (!aim_.by_side) return;
  const std::vector<Pose> X_HL = CalcLinkPoses(hand_, VectorXd::Zero(hand_.num_joints()));
  const auto find_side = [&](const Digit& digit, const Digit& other) {
    const PadState side = CalcSideState(hand_, digit, 1.0, X_HL);
    const Vector3d apart =
        X_HL[other.distal_link].translation() - X_HL[digit.distal_link].translation();
    return side.nhat_H.dot(apart) < 0.0 ? -1.0 : 1.0;
  };
  if (!opposing_->is_thumb) sides_[0] = find_side(*opposing_, *fingers_.front());
  for (size_t f = 0; f < fingers_.size(); ++f) {
    sides_[f + 1] = find_side(*fingers_[f], *opposing_);
  }
}

PadState PostureRules::CalcPad(const Digit& digit, double side,
                               const std::vector<Pose>& X_HL) const {
  return side == 0.0 ? CalcPadState(hand_, digit, X_HL) : CalcSideState(hand_, digit, side, X_HL);
}

PosturePair PostureRules::MakePair(const VectorXd& x) const {
  PosturePair pair{q_rest_, q_rest_, x[x.size() - 1]};
  const auto size = static_cast<Eigen::Index>(joints_.size());
  for (Eigen::Index k = 0; k < size; ++k) {
    const int j = joints_[k];
    const HandJoint& joint = hand_.joints[j];
    const double range = joint.upper - joint.lower;
    pair.q_open[j] = joint.lower + range * std::clamp(x[k], 0.0, 1.0);
    pair.q_met[j] = joint.lower + range * std::clamp(x[size + k], 0.0, 1.0);
  }
  ApplyCoupling(hand_, pair.q_open);
  ApplyCoupling(hand_, pair.q_met);
  return pair;
}

VectorXd PostureRules::MakeCoordinates(const PosturePair& pair) const {
  VectorXd x(num_coordinates());
  const auto size = static_cast<Eigen::Index>(joints_.size());
  for (Eigen::Index k = 0; k < size; ++k) {
    const int j = joints_[k];
    const HandJoint& joint = hand_.joints[j];
    const double range = std::max(joint.upper - joint.lower, 1e-9);
    x[k] = (pair.q_open[j] - joint.lower) / range;
    x[size + k] = (pair.q_met[j] - joint.lower) / range;
  }
  x[x.size() - 1] = pair.tilt;
  return x;
}

PostureRules::Stand PostureRules::CalcStand(const VectorXd& q, const Vector3d& approach_H) const {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand_, q);
  Stand stand;
  stand.thumb = CalcPad(*opposing_, sides_[0], X_HL);
  stand.height = stand.thumb.p_HPad.dot(approach_H);
  for (size_t f = 0; f < fingers_.size(); ++f) {
    stand.fingers.push_back(CalcPad(*fingers_[f], sides_[f + 1], X_HL));
    stand.p_HFingers += stand.fingers.back().p_HPad / static_cast<double>(fingers_.size());
    stand.height += stand.fingers.back().p_HPad.dot(approach_H);
  }
  stand.height /= static_cast<double>(fingers_.size() + 1);
  Vector3d across = stand.p_HFingers - stand.thumb.p_HPad;
  across -= across.dot(approach_H) * approach_H;
  stand.opening = across.norm();
  stand.across_H = stand.opening > 1e-6 ? Vector3d(across / stand.opening)
                                        : Vector3d(approach_H.unitOrthogonal());
  stand.palm = hand_.p_HCentre.dot(approach_H);
  stand.tips = stand.rest = stand.palm;
  for (const ContactSphere& ball : hand_.contact_spheres) {
    const auto link = static_cast<size_t>(ball.link);
    const double depth = (X_HL[link] * ball.p_LS).dot(approach_H) + ball.radius;
    double& deepest = is_tip_[link]                  ? stand.tips
                      : ball.link == hand_.palm_link ? stand.palm
                                                     : stand.rest;
    deepest = std::max(deepest, depth);
  }
  return stand;
}

double PostureRules::CalcWorstFacing(const PosturePair& pair) const {
  const Vector3d approach_H = std::cos(pair.tilt) * normal_H_ + std::sin(pair.tilt) * forward_H_;
  const Stand met = CalcStand(pair.q_met, approach_H);
  const auto calc_angle = [](const Vector3d& a, const Vector3d& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
  };
  double worst = calc_angle(met.thumb.nhat_H, met.across_H);
  for (const PadState& pad : met.fingers) {
    worst = std::max(worst, calc_angle(pad.nhat_H, -met.across_H));
  }
  return worst;
}

int PostureRules::num_residuals() const {
  const int num_fingers = static_cast<int>(fingers_.size());
  const int of_stand =
      1 + 1 + 2 * num_fingers + 3 * (num_fingers + 1) + (num_fingers + 1) + (num_fingers - 1) + 3;
  const int num_joints = static_cast<int>(joints_.size());
  return 3 * of_stand + 2 + 2 * (num_fingers + 1) + 1 + (aim_.is_over_palm ? 3 : 0) +
         2 * num_joints * 2;
}

void PostureRules::AddStand(const Stand& stand, const Vector3d& approach_H, bool is_open,
                            double opening, std::vector<double>& residuals) const {
  const auto add = [&](double value) { residuals.push_back(value); };
  const auto add_beyond = [&](double value) { residuals.push_back(std::max(0.0, value)); };
  const auto add_facing = [&](const Vector3d& nhat_H, const Vector3d& towards_H) {
    const Vector3d wanted = std::cos(aim_.lift) * towards_H - std::sin(aim_.lift) * approach_H;
    const Vector3d off = (nhat_H - wanted) / (is_open ? kFacingOpen : kFacing);
    for (int k = 0; k < 3; ++k) add(off[k]);
  };
  const auto calc_height = [&](const PadState& pad) { return pad.p_HPad.dot(approach_H); };

  add((stand.opening - opening) / kLength);
  add((calc_height(stand.thumb) - stand.p_HFingers.dot(approach_H)) / kHeight);
  add_facing(stand.thumb.nhat_H, stand.across_H);
  add_beyond((aim_.tips_down - stand.thumb.axis_H.dot(approach_H)) / kCosine);
  for (const PadState& pad : stand.fingers) {
    const Vector3d off = pad.p_HPad - stand.p_HFingers;
    add(off.dot(approach_H) / kHeight);
    add(off.dot(stand.across_H) / kLength);
    add_facing(pad.nhat_H, -stand.across_H);
    add_beyond((aim_.tips_down - pad.axis_H.dot(approach_H)) / kCosine);
  }
  const Vector3d lateral_H = approach_H.cross(stand.across_H);
  std::vector<double> places;
  for (const PadState& pad : stand.fingers) places.push_back(pad.p_HPad.dot(lateral_H));
  std::sort(places.begin(), places.end());
  for (size_t k = 1; k < places.size(); ++k) {
    const double gap = places[k] - places[k - 1] - aim_.pad_gap;
    add(gap / (gap < 0.0 ? kLength : kWideGap));
  }
  add_beyond((stand.tips - stand.height - kDeepestTip) / kLength);
  add_beyond((stand.rest - stand.height + kAbovePads) / kLength);
  const double reach = stand.height - stand.palm - aim_.reach;
  aim_.is_reach_exact ? add(reach / kLength) : add_beyond(-reach / kLength);
}

VectorXd PostureRules::CalcResiduals(const VectorXd& x) const {
  const PosturePair pair = MakePair(x);
  const Vector3d approach_H = std::cos(pair.tilt) * normal_H_ + std::sin(pair.tilt) * forward_H_;
  VectorXd q_half = 0.5 * (pair.q_open + pair.q_met);
  ApplyCoupling(hand_, q_half);
  const Stand open = CalcStand(pair.q_open, approach_H);
  const Stand half = CalcStand(q_half, approach_H);
  const Stand met = CalcStand(pair.q_met, approach_H);

  std::vector<double> residuals;
  AddStand(open, approach_H, true, aim_.opening, residuals);
  AddStand(half, approach_H, false, 0.5 * (aim_.opening + aim_.meeting), residuals);
  AddStand(met, approach_H, false, aim_.meeting, residuals);
  residuals.push_back((open.height - half.height) / kHeight);
  residuals.push_back((half.height - met.height) / kHeight);
  const Vector3d lateral_H = approach_H.cross(half.across_H);
  for (const Stand* end : {&open, &met}) {
    const auto add_aside = [&](const Vector3d& p_HEnd, const Vector3d& p_HHalf) {
      residuals.push_back((p_HEnd - p_HHalf).dot(lateral_H) / kStraight);
    };
    add_aside(end->thumb.p_HPad, half.thumb.p_HPad);
    for (size_t f = 0; f < fingers_.size(); ++f) {
      add_aside(end->fingers[f].p_HPad, half.fingers[f].p_HPad);
    }
  }
  const double thumb_way = (met.thumb.p_HPad - open.thumb.p_HPad).dot(half.across_H);
  residuals.push_back((thumb_way - aim_.thumb_share * (aim_.opening - aim_.meeting)) / kShare);
  if (aim_.is_over_palm) {
    Vector3d off = 0.5 * (half.thumb.p_HPad + half.p_HFingers) - hand_.p_HCentre;
    off -= off.dot(approach_H) * approach_H;
    for (int k = 0; k < 3; ++k) residuals.push_back(off[k] / kOffPalm);
  }
  const auto size = static_cast<Eigen::Index>(joints_.size());
  const auto is_leader = [&](Eigen::Index k) {
    const int j = joints_[k % size];
    return aim_.leaders_straight &&
           std::any_of(hand_.joints.begin(), hand_.joints.end(), [j](const HandJoint& other) {
             return other.coupled_to == j && !other.is_mimic;
           });
  };
  for (Eigen::Index k = 0; k < 2 * size; ++k) {
    const HandJoint& joint = hand_.joints[joints_[k % size]];
    const double range = std::max(joint.upper - joint.lower, 1e-9);
    const double rest = (std::clamp(0.0, joint.lower, joint.upper) - joint.lower) / range;
    residuals.push_back((x[k] - rest) / (is_leader(k) ? kLeaderEase : kEase));
    residuals.push_back((x[k] - std::clamp(x[k], 0.0, 1.0)) / kOutside);
  }
  return Eigen::Map<const VectorXd>(residuals.data(), static_cast<Eigen::Index>(residuals.size()));
}

}  // namespace graspbench
