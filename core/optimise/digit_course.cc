#include "core/optimise/digit_course.h"

#include <algorithm>
#include <limits>

#include "core/base/error.h"
#include "core/hand/coupling.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kSteps = 100;

struct DigitPlace {
  double gap = std::numeric_limits<double>::infinity();     ///< to the object [m]
  double lowest = std::numeric_limits<double>::infinity();  ///< above the table [m]
};

DigitPlace CalcPlace(const Hand& hand, const GraspObject& object, const Pose& X_WH,
                     const Digit& digit, const VectorXd& q) {
  // As the object rests: frame O above the origin of W, axes parallel (placement.h).
  const Vector3d p_WO(0.0, 0.0, 0.5 * object.size.z());
  const std::vector<Pose> X_HL = CalcLinkPoses(hand, q);
  DigitPlace place;
  for (const ContactSphere& sphere : hand.contact_spheres) {
    if (!std::count(digit.links.begin(), digit.links.end(), sphere.link)) continue;
    const Vector3d p_WS = X_WH * (X_HL[static_cast<size_t>(sphere.link)] * sphere.p_LS);
    place.gap = std::min(place.gap, object.field->CalcDistance(p_WS - p_WO) - sphere.radius);
    place.lowest = std::min(place.lowest, p_WS.z() - sphere.radius);
  }
  return place;
}

}  // namespace

DigitCourse CalcDigitCourse(const Hand& hand, const GraspObject& object, const Grasp& grasp,
                            const Digit& digit, const VectorXd& q_pre, const VectorXd& deviation) {
  GRASPBENCH_DEMAND(grasp.placement, grasp.id);
  DigitCourse course;
  course.lowest = std::numeric_limits<double>::infinity();
  double last_gap = 0.0;
  for (int k = 0; k <= kSteps; ++k) {
    const double s = static_cast<double>(k) / kSteps;
    VectorXd q = q_pre + s * (grasp.q_target - q_pre);
    ApplyCoupling(hand, q);
    const DigitPlace place = CalcPlace(hand, object, grasp.placement->X_WH, digit, q + deviation);
    course.lowest = std::min(course.lowest, place.lowest);
    if (place.gap <= 0.0) {
      // Between two steps the gap changes linearly.
      course.touch = k == 0 ? 0.0 : s + place.gap / (last_gap - place.gap) / kSteps;
      return course;
    }
    last_gap = place.gap;
  }
  return course;
}

}  // namespace graspbench
