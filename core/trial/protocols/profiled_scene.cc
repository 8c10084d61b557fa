#include "core/trial/protocols/profiled_scene.h"

#include <fmt/core.h>

#include <algorithm>

#include "core/base/units.h"

namespace graspbench {
namespace {

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
  ProfiledScene scene{std::move(hand), std::move(object), X_WO,
                      ChooseStages(std::move(stages), profile.closing.stages), ""};
  const BeyondLimits beyond =
      RowFromName(kBeyondLimits, profile.drives.beyond_limits, "rule for limits").value;
  for (ScriptedStage& stage : scene.stages) {
    for (size_t j = 0; j < scene.hand->joints.size(); ++j) {
      const HandJoint& joint = scene.hand->joints[j];
      double& q = stage.q[static_cast<Eigen::Index>(j)];
      const bool is_beyond = q < joint.lower - kLimitTolerance || q > joint.upper + kLimitTolerance;
      if (is_beyond && beyond == BeyondLimits::kRefuse && scene.refusal.empty()) {
        scene.refusal = DescribeViolation(joint, stage.name, q);
      }
      if (beyond == BeyondLimits::kClip) q = std::clamp(q, joint.lower, joint.upper);
    }
    ApplyMiddleFirst(*scene.hand, stage.q);
  }
  return scene;
}

}  // namespace graspbench
