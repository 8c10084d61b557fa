#include "core/develop/propose_grasps.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "core/base/random.h"
#include "core/base/units.h"
#include "core/grasp/grasp_yaml.h"
#include "core/grasp/placement.h"
#include "core/hand/closing.h"
#include "core/hand/contact_shape.h"
#include "core/hand/hand.h"
#include "core/trial/measures/grasp_types.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/** Ranges to sample for a grasp type. Lengths in metres, `reach` in finger lengths. */
struct AimRanges {
  const char* taxon;
  int least_digits;
  int num_digits;  ///< 0: all
  DrawnRange opening, meeting, reach;
  bool is_reach_exact;
  DrawnRange lift_deg, tips_down, grip;
  DrawnRange pad_gap;
};
// clang-format off
constexpr AimRanges kAimRanges[] = {
    {"g1", 3, 0, {0.06, 0.11}, {0.006, 0.012}, {0.4, 0.8}, false, {-5, 15}, {0.3, 0.8}, {4, 14},
     {0.018, 0.03}},
    {"g2", 2, 2, {0.04, 0.08}, {0.004, 0.01}, {0.4, 0.8}, false, {-5, 10}, {0.4, 0.9}, {3, 9},
     {0.02, 0.02}},
    {"g3", 2, 0, {0.08, 0.14}, {0.01, 0.04}, {0.4, 0.8}, true, {10, 60}, {-0.7, 0.5}, {6, 20},
     {0.018, 0.035}},
    {"g4", 2, 2, {0.02, 0.045}, {0.002, 0.006}, {0.4, 0.8}, false, {-5, 5}, {0.6, 0.95}, {3, 9},
     {0.02, 0.02}},
    {"g5", 3, 3, {0.06, 0.1}, {0.006, 0.015}, {0.4, 0.8}, false, {-5, 15}, {0.3, 0.8}, {4, 14},
     {0.02, 0.04}},
    {"g6", 2, 0, {0.08, 0.13}, {0.01, 0.04}, {0.3, 0.6}, true, {0, 35}, {0.0, 0.7}, {6, 20},
     {0.018, 0.035}},
};
// clang-format on

const AimRanges& FindRanges(const GraspTaxon& taxon) {
  for (const AimRanges& ranges : kAimRanges) {
    if (taxon.id == ranges.taxon) return ranges;
  }
  throw Error(ErrorKind::kNotFound, "no rules to develop a grasp \"" + taxon.id + "\"");
}

/** Returns the thumb (or the first digit if there is none) and the others that the grasp type
requires, in the hand's order. */
std::vector<std::string> DrawDigits(const Hand& hand, const AimRanges& ranges,
                                    RandomStream& stream) {
  const int num_all = static_cast<int>(hand.digits.size());
  const int num_digits = ranges.num_digits == 0 ? num_all : ranges.num_digits;
  int thumb = 0;
  for (int d = 0; d < num_all; ++d) {
    if (hand.digits[d].is_thumb) thumb = d;
  }
  const GraspTypeRule* rule = FindGraspTypeRule(ranges.taxon);
  const bool is_index_asked = rule && rule->digits == TypeDigits::kThumbAndIndex;
  std::vector<int> others;
  for (int d = 0; d < num_all; ++d) {
    if (d == thumb) continue;
    if (!is_index_asked || num_all == 2 || hand.digits[d].id == FindIndexFinger(hand)) {
      others.push_back(d);
    }
  }
  while (static_cast<int>(others.size()) > num_digits - 1) {
    others.erase(others.begin() + stream.NextIndex(static_cast<int>(others.size())));
  }
  std::vector<std::string> digits;
  for (int d = 0; d < num_all; ++d) {
    if (d == thumb || std::count(others.begin(), others.end(), d)) {
      digits.push_back(hand.digits[d].id);
    }
  }
  return digits;
}

/** Two neighbouring fingers, in the hand's order, without the thumb, whose sides will meet. */
std::vector<std::string> DrawNeighbours(const Hand& hand, RandomStream& stream) {
  std::vector<std::string> fingers;
  for (const Digit& digit : hand.digits) {
    if (!digit.is_thumb) fingers.push_back(digit.id);
  }
  const auto first = static_cast<size_t>(stream.NextIndex(static_cast<int>(fingers.size()) - 1));
  return {fingers[first], fingers[first + 1]};
}

PostureAim DrawAim(const Hand& hand, const AimRanges& ranges, bool any_coupling,
                   RandomStream& stream) {
  const GraspTypeRule* rule = FindGraspTypeRule(ranges.taxon);
  PostureAim aim;
  aim.by_side = rule->opposition == Opposition::kSide && hand.digits.size() > 2;
  aim.is_over_palm = ranges.is_reach_exact;
  aim.digits = aim.by_side && stream.NextIndex(2) == 1 ? DrawNeighbours(hand, stream)
                                                       : DrawDigits(hand, ranges, stream);
  aim.opening = ranges.opening.Draw(stream);
  aim.meeting = ranges.meeting.Draw(stream);
  aim.thumb_share = stream.NextUniform(0.35, 0.65);
  aim.reach = CalcFingerLength(hand) * ranges.reach.Draw(stream);
  aim.is_reach_exact = ranges.is_reach_exact;
  aim.lift = RadFromDeg(ranges.lift_deg.Draw(stream));
  aim.tips_down = ranges.tips_down.Draw(stream);
  aim.pad_gap = ranges.pad_gap.Draw(stream);
  aim.leaders_straight = any_coupling && stream.NextIndex(2) == 1;
  return aim;
}

/** Samples the start of a search: closing joints open and half closed, others near their rest. */
PosturePair DrawStart(const Hand& hand, const std::vector<int>& closing, RandomStream& stream) {
  PosturePair start;
  start.q_open = CalcClosedPosture(hand, closing, stream.NextUniform(0.0, 0.4));
  start.q_met = CalcClosedPosture(hand, closing, stream.NextUniform(0.3, 0.8));
  for (int j = 0; j < hand.num_joints(); ++j) {
    const HandJoint& joint = hand.joints[j];
    const double away = 0.5 * stream.NextUniform(-1.0, 1.0) * (joint.upper - joint.lower);
    if (closing[j] != 0 || joint.coupled_to >= 0) continue;
    const double rest = std::clamp(0.0, joint.lower, joint.upper);
    start.q_open[j] = start.q_met[j] = std::clamp(rest + away, joint.lower, joint.upper);
  }
  start.tilt = RadFromDeg(stream.NextUniform(-10.0, 60.0));
  return start;
}

/** The rules in the form that Eigen's solver requires. */
struct RuleFunctor {
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const PostureRules& rules;
  int inputs() const { return rules.num_coordinates(); }
  int values() const { return rules.num_residuals(); }
  int operator()(const VectorXd& x, VectorXd& residuals) const {
    residuals = rules.CalcResiduals(x);
    return 0;
  }
};

PosturePair SolvePair(const PostureRules& rules, const PosturePair& start, double& miss) {
  constexpr double kDifference = 1e-8;  // squared step of the finite differences
  constexpr int kMaxCalls = 200;
  RuleFunctor functor{rules};
  Eigen::NumericalDiff<RuleFunctor> differences(functor, kDifference);
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<RuleFunctor>> solver(differences);
  solver.parameters.maxfev = kMaxCalls;
  solver.parameters.ftol = solver.parameters.xtol = 1e-4;
  VectorXd x = rules.MakeCoordinates(start);
  solver.minimize(x);
  miss = rules.CalcResiduals(x).norm();
  return rules.MakePair(x);
}

/** Penetration of links, summed over postures from open to met [m]. Grasping fingertips are ignored
near the met posture, since they should meet. */
double CalcOverlap(const Hand& hand, const std::vector<std::string>& digits,
                   const std::vector<CapsulePair>& pairs, const PosturePair& pair) {
  const auto is_tip = [&](int link) {
    const int d = hand.FindDigitOfLink(link);
    return d >= 0 && hand.digits[d].distal_link == link &&
           std::count(digits.begin(), digits.end(), hand.digits[d].id) > 0;
  };
  double overlap = 0.0;
  for (const double share : {0.0, 0.5, 1.0}) {
    VectorXd q = pair.q_open + share * (pair.q_met - pair.q_open);
    ApplyCoupling(hand, q);
    const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
    double deepest = 0.0;
    for (const CapsulePair& capsules : pairs) {
      const double gap = CalcCapsuleGap(hand, capsules, X_HL);
      if (-gap <= deepest) continue;
      if (share > 0.5 && is_tip(hand.capsules[capsules.a].link) &&
          is_tip(hand.capsules[capsules.b].link)) {
        continue;
      }
      deepest = -gap;
    }
    overlap += deepest;
  }
  return overlap;
}

ProposedGrasp ProposeOne(const Hand& hand, const GraspTaxon& taxon, bool any_coupling,
                         const std::vector<int>& closing, const std::vector<CapsulePair>& pairs,
                         RandomStream& stream) {
  constexpr double kOverlap = 0.002;                      // relevant penetration [m]
  constexpr double kLargestSideAngle = RadFromDeg(35.0);  // beyond it pads grasp, not sides
  constexpr double kNoSide = 1e3;                         // ranks it behind grasps with sides
  const AimRanges& ranges = FindRanges(taxon);
  ProposedGrasp proposed;
  proposed.aim = DrawAim(hand, ranges, any_coupling, stream);
  proposed.grip = ranges.grip.Draw(stream);
  const PosturePair start = DrawStart(hand, closing, stream);
  // Digits that do not grasp stay open or are folded.
  const bool are_folded = stream.NextIndex(2) == 1;
  const VectorXd q_rest = CalcClosedPosture(hand, closing, are_folded ? 1.0 : 0.0);
  const PostureRules rules(hand, proposed.aim, q_rest);
  const PosturePair pair = SolvePair(rules, start, proposed.miss);
  if (rules.CalcWorstFacing(pair) > kLargestSideAngle && proposed.aim.by_side) {
    proposed.miss += kNoSide;
  }
  proposed.miss += CalcOverlap(hand, proposed.aim.digits, pairs, pair) / kOverlap;

  Grasp& grasp = proposed.grasp;
  grasp.id = taxon.id;
  grasp.type = taxon.type;
  grasp.approach_distance = taxon.approach_distance;
  grasp.alpha = taxon.alpha;
  grasp.tilt = pair.tilt;
  grasp.digits = proposed.aim.digits;
  grasp.palm_may_touch = proposed.aim.is_over_palm;
  grasp.seeks_palm = taxon.type == GraspType::kPower;
  if (grasp.seeks_palm) {
    grasp.palm_gap = 0.0;
  } else if (grasp.palm_may_touch) {
    grasp.palm_gap = stream.NextUniform(0.0, kPalmGap);
  }
  grasp.q_pre = pair.q_open;
  grasp.q_target = CalcSqueeze(hand, grasp.digits, pair.q_met,
                               CalcApproachDirection(hand, pair.tilt), proposed.grip);
  RoundGrasp(hand, grasp);
  return proposed;
}

}  // namespace

void RoundGrasp(const Hand& hand, Grasp& grasp) {
  const double scale = std::pow(10.0, kGraspDecimals);
  grasp.tilt = RadFromDeg(std::round(DegFromRad(grasp.tilt) * scale) / scale);
  grasp.palm_gap = MFromMm(std::round(MmFromM(grasp.palm_gap) * scale) / scale);
  grasp.q_pre = RoundPosture(hand, grasp.q_pre, kGraspDecimals);
  grasp.q_target = RoundPosture(hand, grasp.q_target, kGraspDecimals);
}

std::optional<ProposedGrasp> ProposeOwn(const Hand& hand, const std::vector<Grasp>& grasps,
                                        const GraspTaxon& taxon) {
  for (const Grasp& grasp : grasps) {
    ProposedGrasp own;
    own.grasp = grasp;
    own.grasp.as_called_share = kUnset;  // check its digits only
    if (grasp.id != taxon.id || !ListTypeFaults(hand, own.grasp).empty()) continue;
    own.is_own = true;
    if (taxon.type == GraspType::kPower) {
      own.grasp.palm_may_touch = own.grasp.seeks_palm = true;
      own.grasp.palm_gap = 0.0;
    }
    RoundGrasp(hand, own.grasp);
    return own;
  }
  return std::nullopt;
}

bool CanDevelop(const Hand& hand, const GraspTaxon& taxon) {
  return static_cast<int>(hand.digits.size()) >= FindRanges(taxon).least_digits;
}

VectorXd CalcSqueeze(const Hand& hand, const std::vector<std::string>& digits,
                     const VectorXd& q_met, const Vector3d& approach_H, double grip) {
  constexpr double kMostTorque = 0.5;  // share of a drive's limit
  Grasp grasp;
  grasp.digits = digits;
  const Digit& opposing = hand.digits[FindOpposingDigit(hand, grasp)];
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q_met);
  const double num_fingers = static_cast<double>(digits.size()) - 1.0;
  const Vector3d p_HThumb = CalcPadState(hand, opposing, X_HL).p_HPad;
  Vector3d across_H = -p_HThumb;
  for (const Digit& digit : hand.digits) {
    if (&digit == &opposing || !std::count(digits.begin(), digits.end(), digit.id)) continue;
    across_H += CalcPadState(hand, digit, X_HL).p_HPad / num_fingers;
  }
  across_H -= across_H.dot(approach_H) * approach_H;
  across_H.normalize();
  VectorXd q = q_met;
  for (const Digit& digit : hand.digits) {
    if (!std::count(digits.begin(), digits.end(), digit.id)) continue;
    const std::vector<int> joints = FindDrivenJoints(hand, digit);
    const Vector3d f_H =
        &digit == &opposing ? Vector3d(grip * across_H) : Vector3d(-grip / num_fingers * across_H);
    const VectorXd torques = CalcPadJacobian(hand, digit, q_met, joints).transpose() * f_H;
    for (size_t k = 0; k < joints.size(); ++k) {
      const HandJoint& joint = hand.joints[joints[k]];
      const double most = kMostTorque * joint.drive.torque_limit;
      const double torque = std::clamp(torques[k], -most, most);
      q[joints[k]] =
          std::clamp(q[joints[k]] + torque / joint.drive.stiffness, joint.lower, joint.upper);
    }
  }
  ApplyCoupling(hand, q);
  return q;
}

std::vector<ProposedGrasp> ProposeGrasps(const Hand& hand, const GraspTaxon& taxon, int num_drawn,
                                         int num_kept, bool any_coupling, RandomStream stream) {
  const std::vector<int> closing = FindClosing(hand);
  const std::vector<CapsulePair> pairs = FindCapsulePairs(hand);
  std::vector<ProposedGrasp> proposed;
  for (int k = 0; k < num_drawn; ++k) {
    proposed.push_back(ProposeOne(hand, taxon, any_coupling, closing, pairs, stream));
  }
  std::stable_sort(proposed.begin(), proposed.end(),
                   [](const ProposedGrasp& a, const ProposedGrasp& b) { return a.miss < b.miss; });
  proposed.resize(std::min(proposed.size(), static_cast<size_t>(num_kept)));
  return proposed;
}

}  // namespace graspbench
