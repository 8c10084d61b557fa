#include "core/transfer/play_person.h"

#include <algorithm>
#include <cmath>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/grasp/placement.h"
#include "core/transfer/place_pads.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kLeastOpening = 0.005;  ///< of a digit, or of thumb and fingers [m]
constexpr double kPlayedDepth = 0.003;   ///< of links on their way [m]

std::vector<Vector3d> ListOpenings(const PersonGrasp& person) {
  std::vector<Vector3d> openings;
  for (const PersonDigit& digit : person.digits) openings.push_back(digit.opening_O);
  return openings;
}

/** Mean over the digits that a pad represents. */
Vector3d CalcMean(const std::vector<Vector3d>& values, const PersonGrasp& person,
                  const PadMiss& pad) {
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  for (size_t d = 0; d < person.digits.size(); ++d) {
    if (("+" + pad.person + "+").find("+" + person.digits[d].digit + "+") == std::string::npos) {
      continue;
    }
    sum += values[d];
    ++count;
  }
  return sum / std::max(1, count);
}

/** The person's hand at one instant. */
struct PersonInstant {
  Vector3d away;                   ///< of the midpoint, in O [m]
  std::vector<Vector3d> openings;  ///< by digit, in O [m]
  double width;                    ///< of thumb and fingers [m]
};

PersonInstant FindInstant(const std::vector<Vector3d>& tips, const std::vector<Vector3d>& met) {
  const Vector3d axis = CalcOpeningAxis(tips);
  const Vector3d away = tips[0] + 0.5 * axis - met[0] - 0.5 * CalcOpeningAxis(met);
  return {away, CalcDigitOpenings(tips, met), axis.norm()};
}

/** Posture at one instant of the course. */
VectorXd CalcCoursePosture(const Hand& hand, const Grasp& grasp, const GraspCourse& course,
                           size_t instant) {
  VectorXd q = grasp.q_pre;
  for (const Digit& digit : hand.digits) {
    const auto own = course.closing.find(digit.id);
    if (own == course.closing.end()) continue;
    for (const int joint : FindDrivenJoints(hand, digit)) {
      q[joint] += own->second[instant] * (grasp.q_target[joint] - grasp.q_pre[joint]);
    }
  }
  ApplyCoupling(hand, q);
  return q;
}

/** Why the hand cannot follow the course: what collides, and when; empty: it can. */
std::string FindCourseFault(const Hand& hand, const Grasp& grasp, const GraspCourse& course,
                            const GraspObject& object) {
  const PadPlacer placer(hand, object);
  std::vector<PadGoal> goals;
  for (size_t d = 0; d < hand.digits.size(); ++d) {
    if (course.closing.count(hand.digits[d].id) == 0) continue;
    goals.emplace_back().digit = static_cast<int>(d);
  }
  Pose X_OH = grasp.placement->X_WH;
  X_OH.pretranslate(Vector3d(0.0, 0.0, -0.5 * object.size.z()));
  for (size_t k = 0; k + 1 < course.p_HAway.size(); ++k) {
    const Pose placed = X_OH * MakePose(course.p_HAway[k]);
    const std::string collision = placer.FindCollision(
        goals, {placed, CalcCoursePosture(hand, grasp, course, k)}, k == 0 ? 0.0 : kPlayedDepth);
    if (collision.empty()) continue;
    const double before = course.duration() - course.period * static_cast<double>(k);
    return "on the person's way, " + FormatFixed(before, 2) + " s before contact, " + collision;
  }
  return "";
}

}  // namespace

PlayedReach PlayReach(const Hand& hand, const TransferredGrasp& found, const PersonGrasp& person,
                      const GraspObject& object) {
  const PersonReach& reach = person.reach;
  if (reach.p_OTips.size() < 2) return {"the person's reach was not recorded before contact", {}};
  const std::vector<Vector3d>& met = reach.p_OTips.front();
  std::vector<PersonInstant> instants;  // from contact backwards
  for (const std::vector<Vector3d>& tips : reach.p_OTips) {
    instants.push_back(FindInstant(tips, met));
    if (instants.back().away.norm() >= found.grasp.approach_distance) break;
  }
  std::reverse(instants.begin(), instants.end());

  const std::vector<Vector3d> widest = ListOpenings(person);
  std::vector<Vector3d> open = met;
  for (size_t d = 0; d < open.size(); ++d) open[d] += widest[d];
  const double width = CalcOpeningAxis(met).norm();
  const double range = CalcOpeningAxis(open).norm() - width;
  GraspCourse course;
  course.period = reach.period;
  const Eigen::Matrix3d R_HO = found.grasp.placement->X_WH.linear().transpose();
  for (const PersonInstant& instant : instants) course.p_HAway.emplace_back(R_HO * instant.away);
  course.p_HAway.back().setZero();
  course.closure_start = std::max(0.0, course.duration() - reach.from_widest);
  for (const PadMiss& pad : found.pads) {
    const auto& digits = found.grasp.digits;
    if (std::find(digits.begin(), digits.end(), pad.digit) == digits.end()) continue;
    const Vector3d own = CalcMean(widest, person, pad);
    if (own.norm() < kLeastOpening && range < kLeastOpening) {
      return {"the person opens " + pad.person + " by " + FormatFixed(MmFromM(own.norm()), 1) +
                  " mm only",
              {}};
    }
    std::vector<double>& closing = course.closing[pad.digit];
    for (const PersonInstant& instant : instants) {
      const double opened =
          own.norm() < kLeastOpening
              ? (instant.width - width) / range
              : CalcMean(instant.openings, person, pad).dot(own) / own.squaredNorm();
      closing.push_back(
          std::clamp(found.grasp.placement->closing_at_contact * (1.0 - opened), 0.0, 1.0));
    }
  }
  const std::string fault = FindCourseFault(hand, found.grasp, course, object);
  if (!fault.empty()) return {fault, {}};
  return {"", course};
}

}  // namespace graspbench
