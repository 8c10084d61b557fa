#include "core/trial/protocols/closing_stage.h"

#include <cmath>
#include <limits>

#include "core/hand/closing.h"
#include "core/shape/signed_distance_field.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kDifference = 1e-5;  ///< of a joint, for derivatives [rad], [m]

/** Where a link is nearest to the object. */
struct NearestPoint {
  int link = -1;
  double distance = std::numeric_limits<double>::infinity();  ///< below 0: inside [m]
  Vector3d p_LC = Vector3d::Zero();
  Vector3d nhat_O = Vector3d::Zero();  ///< out of the object
};

Vector3d CalcNormal(const SignedDistanceField& field, const Vector3d& p_O) {
  return field.CalcGradient(field.FindCell(p_O)).normalized();
}

std::vector<NearestPoint> FindNearest(const ProfiledScene& scene, const Pose& X_OH,
                                      const VectorXd& q) {
  const std::vector<Pose> X_HL = CalcLinkPoses(*scene.hand, q);
  std::vector<NearestPoint> nearest(scene.hand->links.size());
  for (const ContactSphere& sphere : scene.hand->contact_spheres) {
    const Pose X_OL = X_OH * X_HL[static_cast<size_t>(sphere.link)];
    const Vector3d p_OS = X_OL * sphere.p_LS;
    const double distance = scene.object->field->CalcDistance(p_OS) - sphere.radius;
    NearestPoint& point = nearest[static_cast<size_t>(sphere.link)];
    if (distance >= point.distance) continue;
    const Vector3d nhat_O = CalcNormal(*scene.object->field, p_OS);
    point = {sphere.link, distance, X_OL.inverse() * (p_OS - sphere.radius * nhat_O), nhat_O};
  }
  return nearest;
}

VectorXd CalcPressed(const ProfiledScene& scene, const ScriptedStage& stage,
                     const ProfileClosing& closing) {
  const Hand& hand = *scene.hand;
  const std::vector<NearestPoint> nearest = FindNearest(scene, stage.X_OH, stage.q);
  VectorXd command = stage.q;
  for (int joint = 0; joint < hand.num_joints(); ++joint) {
    if (hand.joints[static_cast<size_t>(joint)].coupled_to >= 0) continue;
    const auto place = [&](double difference) {
      VectorXd q = stage.q;
      q[joint] += difference;
      return CalcLinkPoses(hand, q);
    };
    const std::vector<Pose> before = place(-kDifference), after = place(kDifference);
    for (const NearestPoint& point : nearest) {
      if (point.link < 0 || point.distance >= closing.press_reach) continue;
      const auto link = static_cast<size_t>(point.link);
      const Vector3d moved_H = after[link] * point.p_LC - before[link] * point.p_LC;
      const Vector3d slope_O = stage.X_OH.linear() * moved_H / (2.0 * kDifference);
      command[joint] -= closing.press * slope_O.dot(point.nhat_O);
    }
  }
  return command;
}

VectorXd CalcAtLimits(const Hand& hand, VectorXd command) {
  const std::vector<int> closing = FindClosing(hand);
  for (size_t j = 0; j < closing.size(); ++j) {
    const HandJoint& joint = hand.joints[j];
    // A distal joint that its finger's drive bends closes with the middle one.
    const bool follows = joint.coupled_to >= 0 && !joint.is_mimic;
    const int towards = closing[follows ? static_cast<size_t>(joint.coupled_to) : j];
    if (towards == 0) continue;
    command[static_cast<Eigen::Index>(j)] = towards > 0 ? joint.upper : joint.lower;
  }
  return command;
}

}  // namespace

VectorXd CalcClosingCommand(const ProfiledScene& scene, const FreeSpaceProfile& profile) {
  const ScriptedStage& last = scene.stages.back();
  switch (RowFromName(kClosingRules, profile.closing.to, "rule for closing").value) {
    case ClosingRule::kStated:
      return last.q;
    case ClosingRule::kPress:
      return CalcPressed(scene, last, profile.closing);
    case ClosingRule::kLimits:
      return CalcAtLimits(*scene.hand, last.q);
  }
  return last.q;
}

}  // namespace graspbench
