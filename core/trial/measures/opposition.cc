#include "core/trial/measures/opposition.h"

#include <cmath>

#include "core/base/error.h"

namespace graspbench {
namespace {

constexpr double kPalmShare = 0.1;
constexpr double kSideShare = 1.0 / 3.0;
const double kSideCosine = std::cos(RadFromDeg(45.0));

/** Unit axis, in W, of the digit's outermost revolute joint. */
Eigen::Vector3d FindFlexionAxis(const Hand& hand, const Digit& digit,
                                const std::vector<Pose>& X_WL) {
  for (size_t k = digit.links.size(); k-- > 0;) {
    const auto index = static_cast<size_t>(digit.links[k]);
    const HandLink& link = hand.links[index];
    if (link.joint < 0 || hand.joints[static_cast<size_t>(link.joint)].is_prismatic) continue;
    return X_WL[index].linear() * link.axis;
  }
  return Eigen::Vector3d::Zero();  // without a revolute joint there is no side
}

}  // namespace

Opposition FindOpposition(const Hand& hand, const std::vector<Pose>& X_WL,
                          const std::vector<HandContact>& contacts) {
  GRASPBENCH_DEMAND(!contacts.empty(), "a grasp without contacts");
  double all = 0.0, palm = 0.0, sides = 0.0;
  for (const HandContact& contact : contacts) {
    all += contact.normal_force;
    const int digit = hand.FindDigitOfLink(contact.link);
    if (digit < 0) {
      palm += contact.normal_force;
      continue;
    }
    const Eigen::Vector3d axis_W =
        FindFlexionAxis(hand, hand.digits[static_cast<size_t>(digit)], X_WL);
    if (std::abs(axis_W.dot(contact.nhat_W)) > kSideCosine) sides += contact.normal_force;
  }
  if (palm >= kPalmShare * all) return Opposition::kPalm;
  return sides >= kSideShare * all ? Opposition::kSide : Opposition::kPad;
}

}  // namespace graspbench
