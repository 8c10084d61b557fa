#include "core/grasp/predict_grasp.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "core/grasp/placement.h"
#include "core/hand/hand.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;

constexpr double kFarthest = 0.1;     ///< length of the approach path that is checked [m]
constexpr double kLeastStep = 0.001;  ///< least step along it [m]
constexpr int kPredictionSteps = 100;
constexpr int kOpeningSteps = 10;                ///< steps of additional opening, up to the path
                                                 ///< from target to pre-grasp
constexpr double kPalmNear = kPalmGap + 0.0005;  ///< beyond this distance, closing moves an object
                                                 ///< [m]

bool IsGrasping(const Grasp& grasp, const Digit& digit) {
  return std::count(grasp.digits.begin(), grasp.digits.end(), digit.id) > 0;
}

/** Contact spheres of the digits; centres in O's axes about the nominal p_WO. */
struct Ball {
  Vector3d p;
  double radius;
  int digit;
};

std::vector<Ball> ListDigitBalls(const Hand& hand, const Placement& placement, double height,
                                 const Eigen::VectorXd& q) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  const Vector3d p_WO(0.0, 0.0, 0.5 * height);
  std::vector<Ball> balls;
  for (const ContactSphere& sphere : hand.contact_spheres) {
    const int digit = hand.FindDigitOfLink(sphere.link);
    if (digit < 0) continue;
    const auto link = static_cast<size_t>(sphere.link);
    balls.push_back({placement.X_WH * (X_HL[link] * sphere.p_LS) - p_WO, sphere.radius, digit});
  }
  return balls;
}

using CalcObstacle = std::function<double(const Vector3d& p_O)>;

/** Smallest gap on the path to the grasp position. @param balls  in the grasp position. */
double CalcGapOnWay(const std::vector<Ball>& balls, const Vector3d& approach_W, const Pose& X_ON,
                    const CalcObstacle& calc_obstacle) {
  double smallest = std::numeric_limits<double>::infinity();
  for (double back = 0.0; back < kFarthest;) {
    double gap = std::numeric_limits<double>::infinity();
    for (const Ball& ball : balls) {
      gap = std::min(gap, calc_obstacle(X_ON * Vector3d(ball.p - back * approach_W)) - ball.radius);
    }
    smallest = std::min(smallest, gap);
    // No ball moves faster than the hand, so the gap stays above `smallest` within this step.
    back += std::max(kLeastStep, gap - smallest);
  }
  return smallest;
}

double CalcRoom(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                const Placement& placement, const CalcObstacle& calc_obstacle) {
  const std::vector<Ball> balls =
      ListDigitBalls(hand, placement, object.size.z(), CalcClosingPosture(hand, grasp, 0.0));
  double room = CalcGapOnWay(balls, placement.approach_W, Pose::Identity(), calc_obstacle);
  for (const double x : {-kPlacementOffset, kPlacementOffset}) {
    for (const double y : {-kPlacementOffset, kPlacementOffset}) {
      for (const double yaw : {-kPlacementYaw, kPlacementYaw}) {
        const Pose X_NO = MakePose(MakeRotationRpy(0.0, 0.0, yaw), Vector3d(x, y, 0.0));
        room = std::min(room,
                        CalcGapOnWay(balls, placement.approach_W, X_NO.inverse(), calc_obstacle));
      }
    }
  }
  return room;
}

CalcObstacle MakeObstacle(const GraspObject& object) {
  return [&object](const Vector3d& p_O) { return object.field->CalcDistance(p_O); };
}

/** Distance from base to tip of the longest grasping digit, with its joints at rest [m]. */
double CalcDigitLength(const Hand& hand, const Grasp& grasp) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  double length = 0.0;
  for (const Digit& digit : hand.digits) {
    if (!IsGrasping(grasp, digit)) continue;
    const Vector3d p_HBase = X_HL[static_cast<size_t>(digit.links.front())].translation();
    const Vector3d p_HTip = X_HL[static_cast<size_t>(digit.distal_link)] * digit.p_LTip;
    length = std::max(length, (p_HTip - p_HBase).norm());
  }
  return length;
}

void PredictContacts(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                     const Placement& placement, GraspPrediction& prediction) {
  const size_t num_digits = hand.digits.size();
  std::vector<bool> touches(num_digits, false);
  std::vector<Vector3d> normals(num_digits, Vector3d::Zero());
  std::vector<double> heights(num_digits, 0.0);
  for (int k = 0; k <= kPredictionSteps; ++k) {
    const Eigen::VectorXd q =
        CalcClosingPosture(hand, grasp, static_cast<double>(k) / kPredictionSteps);
    std::vector<double> deepest(num_digits, 0.0);
    std::vector<bool> met = touches;
    for (const Ball& ball : ListDigitBalls(hand, placement, object.size.z(), q)) {
      const auto d = static_cast<size_t>(ball.digit);
      if (touches[d] || !IsGrasping(grasp, hand.digits[d])) continue;
      const double gap = object.field->CalcDistance(ball.p) - ball.radius;
      if (gap > deepest[d]) continue;
      deepest[d] = gap;
      normals[d] = object.field->Query(ball.p).gradient;
      heights[d] = ball.p.z() - ball.radius * normals[d].z();
      met[d] = true;
    }
    touches = met;
  }
  const auto opposing = static_cast<size_t>(FindOpposingDigit(hand, grasp));
  Vector3d others = Vector3d::Zero(), all = Vector3d::Zero();
  double height_of_others = 0.0;
  for (size_t d = 0; d < num_digits; ++d) {
    if (!touches[d]) continue;
    ++prediction.num_touching;
    all += normals[d];
    if (d == opposing) continue;
    others += normals[d];
    height_of_others += heights[d];
  }
  prediction.thumb_touches = touches[opposing];
  if (!prediction.thumb_touches || prediction.num_touching < 2) return;
  const double friction_angle = std::atan(object.surface.friction_static);
  const double between =
      std::acos(std::clamp(-normals[opposing].dot(others.stableNormalized()), -1.0, 1.0));
  prediction.opposes = between <= 2.0 * friction_angle;
  prediction.lifts = all.z() / prediction.num_touching <= std::sin(friction_angle);
  prediction.contact_height =
      0.5 * (heights[opposing] + height_of_others / (prediction.num_touching - 1)) -
      object.mass_properties.p_OOcm.z();
}

bool ComesFromSide(const Placement& placement) { return std::abs(placement.approach_W.z()) < 0.5; }

/** Whether the palm stops within kPalmNear of the near face of the object's box, along the
approach. */
bool IsPalmNear(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                const Placement& placement) {
  if (!grasp.palm_may_touch) return false;
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, grasp.q_pre);
  double palm = -std::numeric_limits<double>::infinity();
  for (const ContactSphere& sphere : hand.contact_spheres) {
    if (sphere.link != hand.palm_link) continue;
    const Vector3d p_WS = placement.X_WH * (X_HL[static_cast<size_t>(sphere.link)] * sphere.p_LS);
    palm = std::max(palm, placement.approach_W.dot(p_WS) + sphere.radius);
  }
  return CalcNearFace(object, placement.approach_W) - palm <= kPalmNear;
}

double CalcNeededRoom(const Hand& hand, const Grasp& grasp) {
  return hand.joint_accuracy * CalcDigitLength(hand, grasp);
}

/** Opens the pre-grasp by an additional `share` of the path from target to pre-grasp. */
Grasp Open(const Hand& hand, const Grasp& grasp, double share) {
  Grasp opened = grasp;
  opened.q_pre += share * (grasp.q_pre - grasp.q_target);
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    double& q = opened.q_pre[static_cast<Eigen::Index>(j)];
    q = std::clamp(q, hand.joints[j].lower, hand.joints[j].upper);
  }
  ApplyCoupling(hand, opened.q_pre);
  return opened;
}

/** Opens the grasp until it is clear; nullopt if it cannot be clear and reach the object. */
std::optional<Grasp> OpenUntilClear(const Hand& hand, const Grasp& grasp,
                                    const GraspObject& object) {
  for (int k = 0; k <= kOpeningSteps; ++k) {
    Grasp opened = k == 0 ? grasp : Open(hand, grasp, static_cast<double>(k) / kOpeningSteps);
    const Placement placement = CalcPlacement(hand, opened, object);
    if (!placement.reaches_object) continue;
    if (CalcRoom(hand, opened, object, placement, MakeObstacle(object)) >=
        CalcNeededRoom(hand, opened)) {
      return opened;
    }
  }
  return std::nullopt;
}

}  // namespace

GraspPrediction PredictGrasp(const Hand& hand, const Grasp& grasp, const GraspObject& object) {
  GraspPrediction prediction;
  const Placement placement = CalcPlacement(hand, grasp, object);
  prediction.reach_miss = CalcReachMiss(hand, grasp, object, placement);
  prediction.room = CalcRoom(hand, grasp, object, placement, MakeObstacle(object));
  prediction.needed_room = CalcNeededRoom(hand, grasp);
  prediction.num_digits = static_cast<int>(grasp.digits.size());
  PredictContacts(hand, grasp, object, placement, prediction);
  prediction.palm_is_near = IsPalmNear(hand, grasp, object, placement);
  return prediction;
}

bool ClearsBoundingBox(const Hand& hand, const Grasp& grasp, const GraspObject& object) {
  const Placement placement = CalcBoxPlacement(hand, grasp, object);
  if (!placement.reaches_object) return false;
  const auto calc_box = [&](const Vector3d& p_O) { return CalcBoxDistance(object.size, p_O); };
  return CalcRoom(hand, grasp, object, placement, calc_box) >= CalcNeededRoom(hand, grasp);
}

GraspRank RankGrasp(const Grasp& grasp, const GraspPrediction& prediction) {
  constexpr double kLeastHeldShare = 0.5;
  GraspRank rank;
  rank.meets = prediction.reaches() + (prediction.reaches() && prediction.meets());
  rank.has_held = !(grasp.held_share < kLeastHeldShare);
  rank.num_kept = prediction.is_clear() + (prediction.opposes && prediction.lifts) +
                  (prediction.num_touching == prediction.num_digits) + prediction.palm_is_near;
  rank.depth = -prediction.contact_height;
  return rank;
}

Grasp FitGraspAt(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                 const PlaceChange& change, double opening) {
  std::optional<Grasp> as_it_is;
  for (int k = 0; k <= kOpeningSteps; k += 2) {
    Grasp opened = Open(hand, grasp, opening + static_cast<double>(k) / kOpeningSteps);
    opened.placement = CalcPlacement(hand, opened, object, change);
    if (!as_it_is) as_it_is = opened;
    if (!opened.placement->reaches_object) continue;
    if (CalcRoom(hand, opened, object, *opened.placement, MakeObstacle(object)) >=
        CalcNeededRoom(hand, opened)) {
      return opened;
    }
  }
  return *as_it_is;
}

Grasp FitGrasp(const Hand& hand, const Grasp& grasp, const GraspObject& object) {
  if (grasp.placement || !grasp.object.empty()) return grasp;
  const std::optional<Grasp> fitted = OpenUntilClear(hand, grasp, object);
  if (grasp.approach != Approach::kAutomatic || object.approach != Approach::kAutomatic) {
    return fitted.value_or(grasp);
  }
  const auto meets = [&](const Grasp& way) { return PredictGrasp(hand, way, object).meets(); };
  const auto palm_bears = [&](const Grasp& way) {
    const GraspPrediction prediction = PredictGrasp(hand, way, object);
    return prediction.palm_is_near && prediction.holds();
  };
  if (fitted && (!grasp.palm_may_touch || palm_bears(*fitted))) return *fitted;
  Grasp other = grasp;
  other.approach =
      ComesFromSide(CalcPlacement(hand, grasp, object)) ? Approach::kAbove : Approach::kSide;
  const std::optional<Grasp> other_fitted = OpenUntilClear(hand, other, object);
  if (other_fitted && (fitted ? palm_bears(*other_fitted) : meets(*other_fitted))) {
    return *other_fitted;
  }
  if (fitted) return *fitted;
  const auto is_palm_near = [&](const Grasp& way) {
    return IsPalmNear(hand, way, object, CalcPlacement(hand, way, object));
  };
  return is_palm_near(other) && !is_palm_near(grasp) && meets(other) ? other : grasp;
}

}  // namespace graspbench
