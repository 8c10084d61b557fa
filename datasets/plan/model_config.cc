#include "datasets/plan/model_config.h"

namespace graspbench {
namespace {

/** Coefficients that are left out stay so. */
void Scale(const ModelConfig& model, SurfaceMaterial& surface) {
  surface.friction_static *= model.friction_scale;
  surface.friction_dynamic *= model.friction_scale;
  surface.torsion_radius *= model.pad_torsion_scale;
  surface.pad.torsion_scale *= model.pad_torsion_scale;
  surface.pad.youngs_modulus *= model.pad_stiffness_scale;
}

}  // namespace

std::vector<std::string> ListModelCouplings() {
  std::vector<std::string> names = {ModelConfig::kOwnRule};
  for (const CouplingRule rule : ListCouplingRules()) names.push_back(NameOf(rule));
  return names;
}

void ApplyModel(const ModelConfig& model, Hand& hand) {
  for (HandLink& link : hand.links) Scale(model, link.surface);
  for (HandJoint& joint : hand.joints) joint.drive.torque_limit *= model.drive_torque_scale;
  hand.joint_accuracy *= model.joint_error_scale;
  hand.slide_accuracy *= model.joint_error_scale;
  for (const CouplingRule rule : ListCouplingRules()) {
    if (NameOf(rule) == model.coupling_rule) hand.coupling = rule;
  }
}

void ApplyModel(const ModelConfig& model, GraspObject& object) {
  Scale(model, object.surface);
  object.mass_properties.mass *= model.mass_scale;
  object.mass_properties.I_OOcm *= model.mass_scale;
}

}  // namespace graspbench
