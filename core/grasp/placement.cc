#include "core/grasp/placement.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/hand/hand.h"

namespace graspbench {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLowestGrasp = 0.009;  ///< smallest h_g [m]
constexpr double kBelowTop = 0.008;     ///< h_g stays this far below the object's top [m]
constexpr double kLeastHold = 0.003;    ///< distance by which pads must reach past the near face
                                        ///< [m]
constexpr double kFarAway = 1.0;        ///< largest distance from which a hand comes [m]
constexpr int kClosingSteps = 200;

struct Pads {
  Vector3d p_HThumb;
  Vector3d p_HFingers;  ///< mean of the other grasping digits' pads
};

Pads CalcPads(const Hand& hand, const Grasp& grasp, const std::vector<Pose>& X_HL) {
  Pads pads{Vector3d::Zero(), Vector3d::Zero()};
  const Digit& opposing = hand.digits[FindOpposingDigit(hand, grasp)];
  for (const Digit& digit : hand.digits) {
    if (!std::count(grasp.digits.begin(), grasp.digits.end(), digit.id)) continue;
    const Vector3d p_HPad = X_HL[digit.distal_link] * digit.p_LPad;
    if (digit.id == opposing.id) {
      pads.p_HThumb = p_HPad;
    } else {
      pads.p_HFingers += p_HPad / static_cast<double>(grasp.digits.size() - 1);
    }
  }
  return pads;
}

/** Axis about which the fingers flex, at rest. It is that of the outermost joint that rotates
across the palm's normal, of the first finger that has one. */
Vector3d CalcFlexionAxis(const Hand& hand) {
  constexpr double kMostAlong = 0.7;
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  for (const Digit& digit : hand.digits) {
    if (digit.is_thumb) continue;
    for (size_t k = digit.links.size(); k-- > 0;) {
      const HandLink& link = hand.links[digit.links[k]];
      if (link.joint < 0 || hand.joints[link.joint].is_prismatic) continue;
      const Vector3d axis_H = X_HL[digit.links[k]].linear() * link.axis;
      if (std::abs(axis_H.dot(hand.palm_normal)) < kMostAlong) return axis_H;
    }
  }
  return hand.palm_normal.unitOrthogonal();
}

/** Approximate reach of bent fingers beyond the palm, the height that they can hold from above. */
double CalcReach(const Hand& hand) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  double reach = 0.0;
  for (const Digit& digit : hand.digits) {
    if (digit.is_thumb) continue;
    const Vector3d p_HBase = X_HL[digit.links.front()].translation();
    reach = std::max(reach, (X_HL[digit.distal_link] * digit.p_LTip - p_HBase).norm());
  }
  return reach;
}

/** Largest coordinate along unit `direction_W` of the spheres of `link` (-1: all links). */
double CalcExtent(const Hand& hand, const std::vector<Pose>& X_HL, const Pose& X_WH, int link,
                  const Vector3d& direction_W) {
  double extent = -std::numeric_limits<double>::infinity();
  for (const ContactSphere& sphere : hand.contact_spheres) {
    if (link >= 0 && sphere.link != link) continue;
    const Vector3d p_WS = X_WH * (X_HL[sphere.link] * sphere.p_LS);
    extent = std::max(extent, direction_W.dot(p_WS) + sphere.radius);
  }
  return extent;
}

/** Signed distance of a point in O from the obstacle. */
using CalcObstacle = std::function<double(const Vector3d& p_O)>;

/** Distance along the approach by which the open hand must stop short of `placement` [m]. */
double CalcWayBack(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                   const CalcObstacle& calc_obstacle, const Placement& placement) {
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, CalcClosingPosture(hand, grasp, 0.0));
  const Vector3d p_WO(0.0, 0.0, 0.5 * object.size.z());
  const auto is_distal = [&](int link) {
    return std::any_of(hand.digits.begin(), hand.digits.end(),
                       [&](const Digit& digit) { return digit.distal_link == link; });
  };
  const auto calc_gap = [&](double back, bool of_distal_links) {
    double gap = kFarAway;
    for (const ContactSphere& sphere : hand.contact_spheres) {
      if (is_distal(sphere.link) != of_distal_links) continue;
      const double least = sphere.link == hand.palm_link && !grasp.palm_may_touch ? kPalmGap : 0.0;
      const Vector3d p_WS = placement.X_WH * (X_HL[sphere.link] * sphere.p_LS);
      const Vector3d p_OS = p_WS - back * placement.approach_W - p_WO;
      gap = std::min(gap, calc_obstacle(p_OS) - sphere.radius - least);
    }
    return gap;
  };
  // No point moves faster than the hand, so a gap is a safe step.
  constexpr double kNear = 1e-4;
  double back = kFarAway;
  while (back > 0.0) {
    const double gap = calc_gap(back, false);
    if (gap < kNear) break;
    back = std::max(0.0, back - gap);
  }
  for (double gap; (gap = calc_gap(back, true)) < 0.0 && back < kFarAway;) {
    back += std::max(-gap, kNear);
  }
  return back;
}

/** Raises the hand until it is clear of the table on its whole `course`. Objects thinner than the
lowest grasp are picked off the table, where the fingertips may slide on it until they meet the
object. */
void LiftOffTable(const Hand& hand, const std::vector<std::vector<Pose>>& course, double height,
                  Placement& placement) {
  const size_t first = height < kLowestGrasp ? course.size() - 1 : 0;
  double lowest = std::numeric_limits<double>::infinity();
  for (size_t k = first; k < course.size(); ++k) {
    lowest = std::min(lowest, -CalcExtent(hand, course[k], placement.X_WH, -1, -Vector3d::UnitZ()));
  }
  if (lowest < kTableClearance) {
    placement.X_WH.pretranslate((kTableClearance - lowest) * Vector3d::UnitZ());
  }
}

/** Height above the table: half the object's height; from above at most kBelowTop below its top. */
double CalcGraspHeight(double height, bool from_side) {
  if (from_side) return 0.5 * height;
  return std::max(kLowestGrasp, std::min(0.5 * height, height - kBelowTop));
}

/** Default approach. It is from the side if the palm is sought, since from above fingers reach
deeper than most objects are tall. Otherwise it is from the side if the palm may touch and the
object is taller than the fingers reach. */
bool ComesFromSide(const Hand& hand, const Grasp& grasp, double height) {
  if (grasp.approach != Approach::kAutomatic) return grasp.approach == Approach::kSide;
  return grasp.seeks_palm || (grasp.palm_may_touch && height > CalcReach(hand));
}

/** R_WH that turns two perpendicular directions of the hand into two of the world. */
Matrix3d CalcRotation(const Vector3d& a_H, const Vector3d& b_H, const Vector3d& a_W,
                      const Vector3d& b_W) {
  Matrix3d R_HX, R_WX;
  R_HX << a_H, b_H, a_H.cross(b_H);
  R_WX << a_W, b_W, a_W.cross(b_W);
  return R_WX * R_HX.transpose();
}

}  // namespace

Eigen::VectorXd CalcClosingPosture(const Hand& hand, const Grasp& grasp, double s) {
  Eigen::VectorXd q = grasp.q_pre + s * (grasp.q_target - grasp.q_pre);
  ApplyCoupling(hand, q);
  return q;
}

Vector3d CalcApproachDirection(const Hand& hand, double tilt) {
  Vector3d fingertips_H = Vector3d::Zero();
  const std::vector<Pose> X_HL_rest = CalcLinkPoses(hand, Eigen::VectorXd::Zero(hand.num_joints()));
  for (const Digit& digit : hand.digits) {
    if (!digit.is_thumb) fingertips_H += X_HL_rest[digit.distal_link] * digit.p_LTip;
  }
  Vector3d forward_H = hand.palm_normal.cross(CalcFlexionAxis(hand)).normalized();
  if (forward_H.dot(fingertips_H) < 0.0) forward_H = -forward_H;
  return std::cos(tilt) * hand.palm_normal + std::sin(tilt) * forward_H;
}

double CalcPreGraspWidth(const Hand& hand, const Grasp& grasp) {
  const Pads pads = CalcPads(hand, grasp, CalcLinkPoses(hand, grasp.q_pre));
  const Vector3d apart = pads.p_HFingers - pads.p_HThumb;
  return apart.cross(CalcApproachDirection(hand, grasp.tilt)).norm();
}

Placement CalcPlacement(const Hand& hand, const Grasp& grasp, const Vector3d& object_size,
                        const Vector3d& p_OOcm) {
  GRASPBENCH_DEMAND(object_size.minCoeff() > 0.0, "an object's sizes must be positive");
  if (grasp.placement) return *grasp.placement;
  const double width = object_size.y();
  const double height = object_size.z();
  const bool from_side = ComesFromSide(hand, grasp, height);

  const Vector3d lateral_H = CalcFlexionAxis(hand);
  const Vector3d approach_H = CalcApproachDirection(hand, from_side ? 0.0 : grasp.tilt);

  // The opening as seen along the approach.
  const auto across = [&](const Vector3d& v) -> Vector3d {
    return v - v.dot(approach_H) * approach_H;
  };
  Placement placement;
  placement.closing_at_contact = 1.0;
  std::vector<std::vector<Pose>> course;  // link poses from s = 0 to s*
  Pads pads;
  for (int k = 0; k <= kClosingSteps; ++k) {
    const double s = static_cast<double>(k) / kClosingSteps;
    course.push_back(CalcLinkPoses(hand, CalcClosingPosture(hand, grasp, s)));
    pads = CalcPads(hand, grasp, course.back());
    if (across(pads.p_HFingers - pads.p_HThumb).norm() <= width) {
      placement.closing_at_contact = s;
      break;
    }
  }
  const Vector3d p_HG = 0.5 * (pads.p_HThumb + pads.p_HFingers);
  const Vector3d opposition_H = across(pads.p_HFingers - pads.p_HThumb).normalized();

  Matrix3d R_WH;
  if (from_side) {
    // The hand comes along +y of the world, with its thumb side up.
    const Vector3d up_H =
        lateral_H.dot(across(pads.p_HThumb)) < 0.0 ? Vector3d(-lateral_H) : lateral_H;
    placement.approach_W = Vector3d::UnitY();
    R_WH = CalcRotation(approach_H, up_H, placement.approach_W, Vector3d::UnitZ());
  } else {
    placement.approach_W = -Vector3d::UnitZ();
    const Vector3d opposition_W(std::cos(grasp.alpha), std::sin(grasp.alpha), 0.0);
    R_WH = CalcRotation(approach_H, opposition_H, placement.approach_W, opposition_W);
  }

  const double grasp_height = CalcGraspHeight(height, from_side);
  placement.X_WH = MakePose(R_WH, Vector3d(p_OOcm.x(), p_OOcm.y(), grasp_height) - R_WH * p_HG);

  if (grasp.palm_may_touch) {
    const double near_face = from_side ? -0.5 * width : -height;  // along the approach
    const double palm =
        CalcExtent(hand, course.front(), placement.X_WH, hand.palm_link, placement.approach_W);
    placement.X_WH.pretranslate((near_face - grasp.palm_gap - palm) * placement.approach_W);
  }

  LiftOffTable(hand, course, height, placement);
  return placement;
}

double CalcNearFace(const GraspObject& object, const Vector3d& approach_W) {
  const Vector3d p_WO(0.0, 0.0, 0.5 * object.size.z());
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector3d& p_O : object.mesh.vertices) {
    nearest = std::min(nearest, approach_W.dot(p_O + p_WO));
  }
  return nearest;
}

namespace {

/** Distance by which the pads, where they would meet the object, miss the depth that they need to
hold it [m]; negative: they reach it. */
double CalcShortfall(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                     const Placement& placement) {
  const Pads pads =
      CalcPads(hand, grasp,
               CalcLinkPoses(hand, CalcClosingPosture(hand, grasp, placement.closing_at_contact)));
  const Vector3d p_WG = placement.X_WH * Vector3d(0.5 * (pads.p_HThumb + pads.p_HFingers));
  return CalcNearFace(object, placement.approach_W) + kLeastHold - placement.approach_W.dot(p_WG);
}

/** Moves the hand back along the approach until it is clear, and updates `reaches_object`. */
Placement StopBefore(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                     const CalcObstacle& calc_obstacle, Placement placement) {
  const double back = CalcWayBack(hand, grasp, object, calc_obstacle, placement);
  if (back == 0.0) return placement;
  placement.X_WH.pretranslate(-back * placement.approach_W);
  placement.reaches_object = CalcShortfall(hand, grasp, object, placement) <= 0.0;
  return placement;
}

/** Raises a moved hand off the table on its course to s*. */
void RaiseOffTable(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                   Placement& placement) {
  std::vector<std::vector<Pose>> course;
  for (int k = 0; k <= kClosingSteps; ++k) {
    const double s = placement.closing_at_contact * k / kClosingSteps;
    course.push_back(CalcLinkPoses(hand, CalcClosingPosture(hand, grasp, s)));
  }
  LiftOffTable(hand, course, object.size.z(), placement);
}

/** As CalcPlacement, for a given obstacle. */
Placement PlaceBefore(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                      const CalcObstacle& calc_obstacle) {
  Grasp chosen = grasp;
  if (object.approach != Approach::kAutomatic) chosen.approach = object.approach;
  const Placement placement =
      CalcPlacement(hand, chosen, object.size, object.mass_properties.p_OOcm);
  if (grasp.placement) return placement;
  return StopBefore(hand, grasp, object, calc_obstacle, placement);
}

}  // namespace

Placement CalcPlacement(const Hand& hand, const Grasp& grasp, const GraspObject& object) {
  return PlaceBefore(hand, grasp, object,
                     [&](const Vector3d& p_O) { return object.field->CalcDistance(p_O); });
}

Placement CalcPlacement(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                        const PlaceChange& change) {
  const Matrix3d R_OV = MakeRotationRpy(0.0, 0.0, change.yaw);
  Eigen::AlignedBox3d box_V;
  for (const Vector3d& p_O : object.mesh.vertices) box_V.extend(R_OV.transpose() * p_O);
  const Vector3d p_OC = R_OV * box_V.center();
  Grasp placed = grasp;
  placed.placement.reset();
  if (object.approach != Approach::kAutomatic) placed.approach = object.approach;
  Placement placement = CalcPlacement(hand, placed, box_V.sizes(),
                                      R_OV.transpose() * (object.mass_properties.p_OOcm - p_OC));
  const Vector3d shift_V(change.along, 0.0, change.rise);
  const Pose X_WV = MakePose(R_OV, Vector3d(p_OC.x(), p_OC.y(), 0.0) + R_OV * shift_V);
  placement.X_WH = X_WV * placement.X_WH;
  placement.approach_W = R_OV * placement.approach_W;
  RaiseOffTable(hand, placed, object, placement);
  return StopBefore(
      hand, placed, object, [&](const Vector3d& p_O) { return object.field->CalcDistance(p_O); },
      placement);
}

Placement MovePlacement(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                        const Vector3d& shift_W, const Vector3d& turn_W) {
  GRASPBENCH_DEMAND(grasp.placement.has_value(), grasp.id);
  Placement placement = *grasp.placement;
  if (shift_W.isZero(0.0) && turn_W.isZero(0.0)) return placement;
  const Vector3d p_WO(0.0, 0.0, 0.5 * object.size.z());
  const double angle = turn_W.norm();
  const Vector3d axis_W = angle > 0.0 ? Vector3d(turn_W / angle) : Vector3d(Vector3d::UnitZ());
  const Matrix3d turn = Eigen::AngleAxisd(angle, axis_W).toRotationMatrix();
  const Pose& X_WH = grasp.placement->X_WH;
  placement.X_WH =
      MakePose(Matrix3d(turn * X_WH.linear()), p_WO + shift_W + turn * (X_WH.translation() - p_WO));
  RaiseOffTable(hand, grasp, object, placement);
  return StopBefore(
      hand, grasp, object, [&](const Vector3d& p_O) { return object.field->CalcDistance(p_O); },
      placement);
}

double CalcReachMiss(const Hand& hand, const Grasp& grasp, const GraspObject& object,
                     const Placement& placement) {
  return placement.reaches_object ? 0.0 : CalcShortfall(hand, grasp, object, placement);
}

double CalcBoxDistance(const Vector3d& size, const Vector3d& p_O) {
  const Vector3d beyond = p_O.cwiseAbs() - 0.5 * size;
  return beyond.cwiseMax(0.0).norm() + std::min(0.0, beyond.maxCoeff());
}

Placement CalcBoxPlacement(const Hand& hand, const Grasp& grasp, const GraspObject& object) {
  return PlaceBefore(hand, grasp, object,
                     [&](const Vector3d& p_O) { return CalcBoxDistance(object.size, p_O); });
}

}  // namespace graspbench
