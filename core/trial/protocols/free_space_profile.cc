#include "core/trial/protocols/free_space_profile.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/units.h"
#include "core/hand/closing.h"
#include "core/shape/signed_distance_field.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

/** Rounding of files that give angles with six digits is no violation [rad], [m]. */
constexpr double kLimitTolerance = 1e-4;

/** As an arm holds the hand (SimConfig), but at most as stiff as a joint's stop. */
JointDrive MakeHoldingDrive(const HandJoint& joint, const SimConfig& sim) {
  JointDrive drive = joint.drive;
  if (joint.is_prismatic) return drive;
  drive = JointDrive();
  drive.stiffness = sim.arm_angular_stiffness;
  drive.damping = sim.arm_angular_stiffness * sim.arm_damping_time;
  drive.torque_limit = sim.arm_moment_limit;
  return drive;
}

JointDrive MakeGivenDrive(const ProfileDrives& given, const JointDrive& own) {
  JointDrive drive;
  drive.stiffness = given.stiffness;
  drive.damping = given.damping;
  drive.torque_limit = given.torque_limit > 0.0 ? given.torque_limit : own.torque_limit;
  drive.friction_static = drive.friction_dynamic = given.friction;
  drive.armature = given.armature;
  return drive;
}

std::string DescribeViolation(const HandJoint& joint, const std::string& stage, double q) {
  return fmt::format("{} asks {} for {:.2f} {}, its limits are {:.2f} to {:.2f} {}", stage,
                     joint.name, ToDisplayUnits(joint, q), DisplayUnitOf(joint),
                     ToDisplayUnits(joint, joint.lower), ToDisplayUnits(joint, joint.upper),
                     DisplayUnitOf(joint));
}

std::vector<ScriptedStage> ChooseStages(std::vector<ScriptedStage> stages,
                                        const std::string& choice) {
  switch (RowFromName(kStageChoices, choice, "choice of stages").value) {
    case StageChoice::kAll:
      return stages;
    case StageChoice::kFirst:
      return {stages.front()};
    case StageChoice::kGrasp:
      for (const ScriptedStage& stage : stages) {
        if (stage.name == "grasp") return {stage};
      }
      return {stages.back()};
  }
  return stages;
}

/** Under middle-first the distal joint is never bent more than the middle one. */
void ApplyMiddleFirst(const Hand& hand, Eigen::VectorXd& q) {
  if (hand.coupling != CouplingRule::kMiddleFirst) return;
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    const HandJoint& joint = hand.joints[j];
    if (joint.coupled_to < 0 || joint.is_mimic) continue;
    double& distal = q[static_cast<Eigen::Index>(j)];
    double& middle = q[joint.coupled_to];
    if (distal >= 0.0 && distal <= middle) continue;
    const double both = middle + distal;
    distal = std::clamp(distal, 0.0, std::max(0.0, 0.5 * both));
    middle = both - distal;
  }
}

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

VectorXd CalcByTable(const Hand& hand, const VectorXd& shares, VectorXd command) {
  for (Eigen::Index j = 0; j < shares.size(); ++j) {
    const HandJoint& joint = hand.joints[static_cast<size_t>(j)];
    if (shares[j] == 0.0) continue;
    command[j] = std::abs(shares[j]) * (shares[j] > 0.0 ? joint.upper : joint.lower);
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

std::shared_ptr<const Hand> MakeProfiledHand(const Hand& hand, const FreeSpaceProfile& profile,
                                             const std::vector<bool>& is_asked) {
  auto profiled = std::make_shared<Hand>(hand);
  const bool is_given =
      RowFromName(kOwnOrGiven, profile.drives.law, "drive law").value == OwnOrGiven::kGiven;
  for (size_t j = 0; j < hand.joints.size(); ++j) {
    HandJoint& joint = profiled->joints[j];
    const bool follows = joint.coupled_to >= 0;
    if (follows && (joint.is_mimic || !profile.drives.free_distal)) continue;
    if (follows) {
      joint.drive = hand.joints[static_cast<size_t>(joint.coupled_to)].drive;
      joint.coupled_to = -1;
      joint.coupling_compliance = 0.0;
    }
    if (!is_asked[j]) {
      joint.drive = MakeHoldingDrive(joint, profile.sim);
    } else if (is_given && !joint.is_prismatic) {
      joint.drive = MakeGivenDrive(profile.drives, joint.drive);
    }
  }
  if (RowFromName(kOwnOrGiven, profile.surfaces.pads, "kind of pads").value == OwnOrGiven::kGiven) {
    for (HandLink& link : profiled->links) {
      link.surface = SurfaceMaterial();
      link.surface.torsion_radius = profile.surfaces.torsion_radius;
      link.surface.relaxation_time = profile.surfaces.relaxation_time;
    }
  }
  for (HandLink& link : profiled->links) {  // the object's and the session's hold
    link.surface.friction_static = link.surface.friction_dynamic = kUnset;
  }
  return profiled;
}

std::shared_ptr<const GraspObject> MakeProfiledObject(const GraspObject& object,
                                                      const FreeSpaceProfile& profile) {
  auto profiled = std::make_shared<GraspObject>(object);
  MassProperties& mass = profiled->mass_properties;
  const double wanted =
      profile.mass > 0.0 ? profile.mass : profile.density * CalcVolume(object.mesh);
  mass.I_OOcm *= wanted / mass.mass;
  mass.mass = wanted;
  profiled->surface.friction_static = profile.surfaces.friction;
  profiled->surface.friction_dynamic = profile.surfaces.friction;
  return profiled;
}

ProfiledScene MakeProfiledScene(std::shared_ptr<const Hand> hand,
                                std::shared_ptr<const GraspObject> object, const Pose& X_WO,
                                std::vector<ScriptedStage> stages,
                                const FreeSpaceProfile& profile) {
  ProfiledScene scene{std::move(hand),
                      std::move(object),
                      X_WO,
                      ChooseStages(std::move(stages), profile.closing.stages),
                      std::nullopt,
                      0,
                      ""};
  const BeyondLimits beyond =
      RowFromName(kBeyondLimits, profile.drives.beyond_limits, "rule for limits").value;
  std::vector<bool> is_joint_beyond(scene.hand->joints.size(), false);
  for (ScriptedStage& stage : scene.stages) {
    for (size_t j = 0; j < scene.hand->joints.size(); ++j) {
      const HandJoint& joint = scene.hand->joints[j];
      double& q = stage.q[static_cast<Eigen::Index>(j)];
      const bool is_beyond = q < joint.lower - kLimitTolerance || q > joint.upper + kLimitTolerance;
      if (is_beyond) is_joint_beyond[j] = true;
      if (is_beyond && beyond == BeyondLimits::kRefuse && scene.refusal.empty()) {
        scene.refusal = DescribeViolation(joint, stage.name, q);
      }
      if (beyond == BeyondLimits::kClip) q = std::clamp(q, joint.lower, joint.upper);
    }
    ApplyMiddleFirst(*scene.hand, stage.q);
  }
  scene.num_beyond_limits =
      static_cast<int>(std::count(is_joint_beyond.begin(), is_joint_beyond.end(), true));
  return scene;
}

VectorXd CalcClosingCommand(const ProfiledScene& scene, const FreeSpaceProfile& profile) {
  const ScriptedStage& last = scene.stages.back();
  switch (RowFromName(kClosingRules, profile.closing.to, "rule for closing").value) {
    case ClosingRule::kStated:
      return last.q;
    case ClosingRule::kPress:
      return CalcPressed(scene, last, profile.closing);
    case ClosingRule::kLimits:
      if (scene.table) return CalcByTable(*scene.hand, scene.table->shares, last.q);
      return CalcAtLimits(*scene.hand, last.q);
  }
  return last.q;
}

}  // namespace graspbench
