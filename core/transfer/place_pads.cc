#include "core/transfer/place_pads.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/NonLinearOptimization>
#include <unsupported/Eigen/NumericalDiff>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/develop/hand_pads.h"
#include "core/grasp/placement.h"

namespace graspbench {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using Eigen::VectorXd;

// Relevant deviations from the goals.
constexpr double kDirection = 0.2;         // of unit vectors, measured
constexpr double kSurfaceDirection = 0.7;  // likewise, taken from the surface
constexpr double kAxis = 0.7;              // of the last phalanx, unit vectors
constexpr double kPalmDirection = 0.5;     // of unit vectors
constexpr double kBeyondLimit = 0.05;      // ranges of a joint
constexpr double kShift = 0.05;            // of the hand per unit of its coordinate [m]
constexpr double kSelfOverlap = 0.002;     // relevant penetration of links [m]
constexpr double kSelfRoom = 5e-4;         // clearance between links [m]
constexpr double kLinkRoom = 1e-3;         // clearance of other links from the object [m]

std::vector<std::string> NamesOfDigits(const Hand& hand) {
  std::vector<std::string> names;
  for (const Digit& digit : hand.digits) names.push_back(digit.id);
  return names;
}

double AngleBetween(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

/** Penetration by link, positive inside [m]. */
struct PadPlacer::Depths {
  std::vector<double> object, table;
  double self = -std::numeric_limits<double>::infinity();
  int self_a = 0, self_b = 0;  ///< links
};

/** The objective in the form that Eigen's solver requires. Coordinates are joints in shares of
their range, then the hand's rotation [rad] and shift from the start. */
struct PadPlacer::Functor {
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const PadPlacer& placer;
  const PadTask& task;
  const PlacedPosture& start;
  std::vector<int> joints;
  std::vector<bool> is_tip;

  int inputs() const { return static_cast<int>(joints.size()) + (task.moves_hand ? 6 : 0); }
  int values() const {
    return static_cast<int>(9 * task.goals.size() + 2 * joints.size() +
                            2 * placer.hand_.links.size() + 4);
  }
  double Range(size_t k) const {
    const HandJoint& joint = placer.hand_.joints[static_cast<size_t>(joints[k])];
    return std::max(joint.upper - joint.lower, 1e-9);
  }
  PlacedPosture Make(const VectorXd& x) const {
    PlacedPosture placed = {start.X_OH, task.q_standard};
    for (size_t k = 0; k < joints.size(); ++k) {
      placed.q[joints[k]] = placer.hand_.joints[static_cast<size_t>(joints[k])].lower +
                            Range(k) * std::clamp(x[static_cast<Index>(k)], 0.0, 1.0);
    }
    ApplyCoupling(placer.hand_, placed.q);
    if (!task.moves_hand) return placed;
    const Vector3d turn = x.segment<3>(static_cast<Index>(joints.size()));
    const double angle = turn.norm();
    if (angle > 0.0) placed.X_OH.prerotate(Eigen::AngleAxisd(angle, turn / angle));
    placed.X_OH.translation() = start.X_OH.translation() + kShift * x.tail<3>();
    return placed;
  }
  VectorXd Coordinates() const {
    VectorXd x = VectorXd::Zero(inputs());
    for (size_t k = 0; k < joints.size(); ++k) {
      const auto j = static_cast<size_t>(joints[k]);
      x[static_cast<Index>(k)] = (start.q[joints[k]] - placer.hand_.joints[j].lower) / Range(k);
    }
    return x;
  }
  int operator()(const VectorXd& x, VectorXd& residuals) const {
    residuals = VectorXd::Zero(values());
    const PlacedPosture placed = Make(x);
    Index next = 0;
    for (size_t k = 0; k < joints.size(); ++k) {
      const double share = x[static_cast<Index>(k)];
      residuals[next++] = (share - std::clamp(share, 0.0, 1.0)) / kBeyondLimit;
      residuals[next++] =
          (placed.q[joints[k]] - task.q_standard[joints[k]]) / Range(k) / task.to_standard;
    }
    placer.AddResiduals(task, placed, is_tip, residuals, next);
    return 0;
  }
};

PadPlacer::PadPlacer(const Hand& hand, const GraspObject& object)
    : hand_(hand), object_(object), pairs_(FindCapsulePairs(hand)) {}

std::vector<bool> PadPlacer::FindTips(const std::vector<PadGoal>& goals) const {
  std::vector<bool> is_tip(hand_.links.size(), false);
  for (const PadGoal& goal : goals) {
    is_tip[static_cast<size_t>(hand_.digits[static_cast<size_t>(goal.digit)].distal_link)] = true;
  }
  return is_tip;
}

PadPlacer::Depths PadPlacer::CalcDepths(const PlacedPosture& placed,
                                        const std::vector<Pose>& X_HL) const {
  constexpr double kNone = -1.0;  // no penetration [m]
  Depths depths;
  depths.object.assign(hand_.links.size(), kNone);
  depths.table.assign(hand_.links.size(), kNone);
  const double table = -0.5 * object_.size.z();
  for (const ContactSphere& sphere : hand_.contact_spheres) {
    const auto link = static_cast<size_t>(sphere.link);
    const Vector3d p_OS = placed.X_OH * (X_HL[link] * sphere.p_LS);
    depths.object[link] =
        std::max(depths.object[link], sphere.radius - object_.field->CalcDistance(p_OS));
    depths.table[link] = std::max(depths.table[link], sphere.radius - (p_OS.z() - table));
  }
  for (const CapsulePair& pair : pairs_) {
    const double depth = -CalcCapsuleGap(hand_, pair, X_HL);
    if (depth <= depths.self) continue;
    depths.self = depth;
    depths.self_a = hand_.capsules[static_cast<size_t>(pair.a)].link;
    depths.self_b = hand_.capsules[static_cast<size_t>(pair.b)].link;
  }
  return depths;
}

void PadPlacer::AddResiduals(const PadTask& task, const PlacedPosture& placed,
                             const std::vector<bool>& is_tip, VectorXd& residuals,
                             Index& next) const {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand_, placed.q);
  const Eigen::Matrix3d& R_OH = placed.X_OH.linear();
  Vector3d middle = Vector3d::Zero();
  for (const PadGoal& goal : task.goals) {
    const PadState pad = CalcPadState(hand_, hand_.digits[static_cast<size_t>(goal.digit)], X_HL);
    const double direction = goal.is_direction_measured ? kDirection : kSurfaceDirection;
    residuals.segment<3>(next) = (placed.X_OH * pad.p_HPad - goal.p_O) / task.pad_length;
    residuals.segment<3>(next + 3) = (R_OH * pad.nhat_H - goal.nhat_O) / direction;
    if (!goal.axis_O.isZero(0.0)) {
      residuals.segment<3>(next + 6) = (R_OH * pad.axis_H - goal.axis_O) / kAxis;
    }
    next += 9;
    middle += goal.p_O / static_cast<double>(task.goals.size());
  }
  const Depths depths = CalcDepths(placed, X_HL);
  for (size_t link = 0; link < hand_.links.size(); ++link) {
    const double room = task.room > 0.0 ? task.room : is_tip[link] ? -kTipSink : kLinkRoom;
    residuals[next++] = std::max(0.0, depths.object[link] + room) / task.collision;
    residuals[next++] = std::max(0.0, depths.table[link] + 2.0 * kTableClearance) / task.collision;
  }
  residuals[next++] = std::max(0.0, depths.self + kSelfRoom) / task.collision;
  if (task.palm_O) {
    const Vector3d palm = (placed.X_OH * hand_.p_HCentre - middle).normalized();
    residuals.segment<3>(next) = (palm - *task.palm_O) / kPalmDirection;
  }
  next += 3;
}

PlacedPosture PadPlacer::Place(const PadTask& task, const PlacedPosture& start, int calls,
                               double& cost) const {
  constexpr double kDifference = 1e-8;  // squared step of the finite differences
  const Functor functor{*this, task, start, FindGraspJoints(hand_, NamesOfDigits(hand_)),
                        FindTips(task.goals)};
  Eigen::NumericalDiff<Functor> differences(functor, kDifference);
  Eigen::LevenbergMarquardt<Eigen::NumericalDiff<Functor>> solver(differences);
  solver.parameters.maxfev = calls;
  solver.parameters.ftol = solver.parameters.xtol = 1e-5;
  VectorXd x = functor.Coordinates();
  solver.minimize(x);
  VectorXd residuals;
  functor(x, residuals);
  cost = residuals.norm();
  return functor.Make(x);
}

PlacedPosture PadPlacer::PlaceAnywhere(const PadTask& task) const {
  constexpr int kFirstCalls = 300, kLastCalls = 2500;
  constexpr double kAside = RadFromDeg(40.0);  // of starts from the palm's direction
  constexpr int kNumRound = 8;
  constexpr double kTowardsMiddle = 0.6;  // share of the joint ranges, for other starts
  constexpr double kLastLength = 0.5;     // share of the pads' length, at the end
  constexpr double kDeepestPalm = -0.5;   // below it the palm starts under the table
  Vector3d middle = Vector3d::Zero(), fingers = Vector3d::Zero();
  const auto num_goals = static_cast<double>(task.goals.size());
  for (size_t g = 0; g < task.goals.size(); ++g) {
    middle += task.goals[g].p_O / num_goals;
    if (g > 0) fingers += task.goals[g].p_O / (num_goals - 1.0);
  }
  const Vector3d axis = (fingers - task.goals[0].p_O).normalized();
  Vector3d to_palm = task.palm_O.value_or(Vector3d::UnitZ());
  to_palm -= to_palm.dot(axis) * axis;
  to_palm = to_palm.norm() > 0.1 ? to_palm.normalized() : axis.unitOrthogonal();
  std::vector<double> turns;
  if (task.palm_O) {
    turns = {0.0, kAside, -kAside};
  } else {
    for (int k = 0; k < kNumRound; ++k) turns.push_back(2.0 * kPi * k / kNumRound);
  }

  PlacedPosture best;
  double least = std::numeric_limits<double>::infinity();
  const auto num_points = static_cast<Index>(task.goals.size()) + 1;
  Eigen::Matrix3Xd p_H(3, num_points), p_O(3, num_points);
  for (const double bend : {0.0, kTowardsMiddle}) {
    const VectorXd q = BendTowardsMiddle(task.q_standard, bend);
    const std::vector<Pose> X_HL = CalcLinkPoses(hand_, q);
    Vector3d middle_H = Vector3d::Zero();
    for (size_t g = 0; g < task.goals.size(); ++g) {
      const Digit& digit = hand_.digits[static_cast<size_t>(task.goals[g].digit)];
      p_H.col(static_cast<Index>(g)) = CalcPadState(hand_, digit, X_HL).p_HPad;
      p_O.col(static_cast<Index>(g)) = task.goals[g].p_O;
      middle_H += p_H.col(static_cast<Index>(g)) / num_goals;
    }
    p_H.col(num_points - 1) = hand_.p_HCentre;
    for (const double turn : turns) {
      const Vector3d palm = Eigen::AngleAxisd(turn, axis) * to_palm;
      if (palm.z() < kDeepestPalm && turns.size() > 3) continue;
      p_O.col(num_points - 1) = middle + (hand_.p_HCentre - middle_H).norm() * palm;
      const Eigen::Matrix4d aligned = Eigen::umeyama(p_H, p_O, false);
      const PlacedPosture start = {
          MakePose(aligned.topLeftCorner<3, 3>(), aligned.topRightCorner<3, 1>()), q};
      double cost = 0.0;
      const PlacedPosture placed = Place(task, start, kFirstCalls, cost);
      if (cost >= least) continue;
      least = cost;
      best = placed;
    }
  }
  // Positions have priority over directions.
  PadTask last = task;
  last.pad_length *= kLastLength;
  last.collision *= kLastLength;
  const bool are_measured =
      std::all_of(task.goals.begin(), task.goals.end(),
                  [](const PadGoal& goal) { return !goal.axis_O.isZero(0.0); });
  if (are_measured) {  // digits then determine the palm, and the standard grasp counts little
    last.palm_O.reset();
    last.to_standard *= 10.0;
  }
  return Place(last, Place(task, best, kLastCalls, least), kLastCalls, least);
}

VectorXd PadPlacer::BendTowardsMiddle(const VectorXd& q, double share) const {
  VectorXd bent = q;
  for (const int joint : FindGraspJoints(hand_, NamesOfDigits(hand_))) {
    const HandJoint& own = hand_.joints[static_cast<size_t>(joint)];
    bent[joint] += share * (0.5 * (own.lower + own.upper) - bent[joint]);
  }
  ApplyCoupling(hand_, bent);
  return bent;
}

std::vector<PadMiss> PadPlacer::CalcMisses(const std::vector<PadGoal>& goals,
                                           const PlacedPosture& placed) const {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand_, placed.q);
  std::vector<PadMiss> misses;
  for (const PadGoal& goal : goals) {
    const Digit& digit = hand_.digits[static_cast<size_t>(goal.digit)];
    const PadState pad = CalcPadState(hand_, digit, X_HL);
    misses.push_back({digit.id, goal.person, (placed.X_OH * pad.p_HPad - goal.p_O).norm(),
                      AngleBetween(placed.X_OH.linear() * pad.nhat_H, goal.nhat_O)});
  }
  return misses;
}

std::string PadPlacer::FindCollision(const std::vector<PadGoal>& goals, const PlacedPosture& placed,
                                     double allowed) const {
  const Depths depths = CalcDepths(placed, CalcLinkPoses(hand_, placed.q));
  const std::vector<bool> is_tip = FindTips(goals);
  double deepest = allowed;
  std::string text;
  const auto take = [&](double depth, size_t link, const std::string& in) {
    if (depth <= deepest) return;
    deepest = depth;
    text = hand_.links[link].name + " is " + FormatFixed(MmFromM(depth), 1) + " mm inside " + in;
  };
  for (size_t link = 0; link < hand_.links.size(); ++link) {
    take(depths.object[link] - (is_tip[link] ? kTipSink : 0.0), link, "the object");
    take(depths.table[link], link, "the table");
  }
  take(depths.self - kSelfOverlap, static_cast<size_t>(depths.self_a),
       hand_.links[static_cast<size_t>(depths.self_b)].name);
  return text;
}

double PadPlacer::CalcTableRoom(const PlacedPosture& placed) const {
  const Depths depths = CalcDepths(placed, CalcLinkPoses(hand_, placed.q));
  return -*std::max_element(depths.table.begin(), depths.table.end());
}

std::vector<std::string> PadPlacer::FindUndetermined(const std::vector<PadGoal>& goals,
                                                     const PlacedPosture& placed) const {
  constexpr double kStep = 1e-6;
  constexpr double kFree = 0.2;     // share of a joint's motion that does not move the pad
  constexpr double kNoMove = 1e-3;  // share of the largest singular value
  std::vector<std::string> names;
  for (const PadGoal& goal : goals) {
    const Digit& digit = hand_.digits[static_cast<size_t>(goal.digit)];
    const std::vector<int> joints = FindDrivenJoints(hand_, digit);
    Eigen::MatrixXd J(goal.is_direction_measured ? 6 : 3, joints.size());
    J.topRows<3>() = CalcPadJacobian(hand_, digit, placed.q, joints);
    for (size_t k = 0; goal.is_direction_measured && k < joints.size(); ++k) {
      VectorXd moved = placed.q;
      moved[joints[k]] += kStep;
      ApplyCoupling(hand_, moved);
      const Vector3d change = CalcPadState(hand_, digit, CalcLinkPoses(hand_, moved)).nhat_H -
                              CalcPadState(hand_, digit, CalcLinkPoses(hand_, placed.q)).nhat_H;
      J.col(static_cast<Index>(k)).tail<3>() = change / kStep * kPadTolerance / kDirection;
    }
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeFullV);
    const VectorXd& sigma = svd.singularValues();
    Index rank = 0;
    while (rank < sigma.size() && sigma[rank] > kNoMove * sigma[0]) ++rank;
    const Eigen::MatrixXd open = svd.matrixV().rightCols(J.cols() - rank);
    for (size_t k = 0; k < joints.size(); ++k) {
      if (open.row(static_cast<Index>(k)).norm() > kFree) {
        names.push_back(hand_.joints[static_cast<size_t>(joints[k])].name);
      }
    }
  }
  return names;
}

}  // namespace graspbench
