#include "core/arm/mounted_arm.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/shape/primitives.h"

namespace graspbench {
namespace {

struct MountRow {
  const char* name;
  Eigen::Vector3d axis_H;
};

const std::vector<MountRow>& ListMountRows() {
  static const std::vector<MountRow> rows = {
      {"x", Eigen::Vector3d::UnitX()}, {"-x", -Eigen::Vector3d::UnitX()},
      {"y", Eigen::Vector3d::UnitY()}, {"-y", -Eigen::Vector3d::UnitY()},
      {"z", Eigen::Vector3d::UnitZ()}, {"-z", -Eigen::Vector3d::UnitZ()}};
  return rows;
}

/** Of the root's pictures, else of its contact surface, along an axis of H [m]; 0: it has neither.
*/
double FindHindmost(const Hand& hand, const Eigen::Vector3d& axis_H) {
  double hindmost = std::numeric_limits<double>::infinity();
  const Pose& X_HL = hand.links.front().X_PJ;
  for (const LinkVisual& visual : hand.visuals) {
    if (visual.link != 0) continue;
    for (const Eigen::Vector3d& p : visual.mesh.vertices) {
      hindmost = std::min(hindmost, axis_H.dot(X_HL * p));
    }
  }
  if (hindmost < std::numeric_limits<double>::infinity()) return hindmost;
  for (const ContactSphere& ball : hand.contact_spheres) {
    if (ball.link == 0) hindmost = std::min(hindmost, axis_H.dot(X_HL * ball.p_LS) - ball.radius);
  }
  return hindmost < std::numeric_limits<double>::infinity() ? hindmost : 0.0;
}

}  // namespace

Pose CalcArmBase(const ArmConfig& config) {
  return MakePose(MakeRotationRpy(0.0, 0.0, config.yaw),
                  Eigen::Vector3d(config.x, config.y, config.z));
}

std::vector<std::string> ListMounts() {
  std::vector<std::string> names;
  for (const MountRow& row : ListMountRows()) names.push_back(row.name);
  return names;
}

MountedArm MountArm(const ArmConfig& config, std::shared_ptr<const Arm> arm, const Hand& hand) {
  const auto row = std::find_if(ListMountRows().begin(), ListMountRows().end(),
                                [&](const MountRow& r) { return r.name == config.mount; });
  GRASPBENCH_DEMAND(row != ListMountRows().end(), config.mount);
  MountedArm mounted;
  mounted.arm = std::move(arm);
  mounted.X_WB = CalcArmBase(config);
  const Eigen::Matrix3d R_FH =
      Eigen::Quaterniond::FromTwoVectors(row->axis_H, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  mounted.X_FH = MakePose(R_FH, Eigen::Vector3d(0.0, 0.0, -FindHindmost(hand, row->axis_H)));
  return mounted;
}

TriMesh MakeCapsuleMesh(const ArmCapsule& capsule) {
  return MakeTaperedCapsule(capsule.p_LA, capsule.radius, capsule.p_LB, capsule.radius);
}

std::string DescribeArmBase(const Pose& X_WB) {
  const Eigen::Vector3d& p = X_WB.translation();
  const double yaw = std::atan2(X_WB.linear()(1, 0), X_WB.linear()(0, 0));
  return "base at " + FormatFixed(p.x(), 3) + ", " + FormatFixed(p.y(), 3) + ", " +
         FormatFixed(p.z(), 3) + " m, turned by " + FormatFixed(DegFromRad(yaw), 1) + " deg";
}

std::string DescribeArmPlace(const MountedArm& arm) {
  return arm.arm->name + " (" + arm.arm->id + "), " + DescribeArmBase(arm.X_WB);
}

Json DescribeArm(const MountedArm& arm) {
  return {{"id", arm.arm->id},
          {"hash", arm.arm->content_hash},
          {"X_WB", JsonPose(arm.X_WB)},
          {"X_FH", JsonPose(arm.X_FH)},
          {"starts", "ready posture"}};
}

}  // namespace graspbench
