#pragma once
/** @file
How far a session's hands and objects differ from their files: factors on what no data sheet gives
or nobody has measured. The defaults change nothing. */

#include <string>
#include <vector>

#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

struct ModelConfig {
  static constexpr const char* kOwnRule = "own";

  double mass_scale = 1.0;               ///< of the object's mass and inertia
  double friction_scale = 1.0;           ///< of the coefficients of objects and links
  double pad_torsion_scale = 1.0;        ///< of every torsion radius
  double pad_stiffness_scale = 1.0;      ///< of the modulus of every soft pad
  double drive_torque_scale = 1.0;       ///< of the drives' torque limits
  double joint_error_scale = 1.0;        ///< of the drives' error from trial to trial
  std::string coupling_rule = kOwnRule;  ///< of coupled joints (core/hand/coupling.h)

  template <class V>
  void Visit(V&& v) {
    v("mass_scale", mass_scale, {"factor on every object's mass and inertia", 0.01, 100});
    v("friction_scale", friction_scale, {"factor on the friction of objects and links", 0, 10});
    v("pad_torsion_scale", pad_torsion_scale, {"factor on every torsion radius", 0, 10});
    v("pad_stiffness_scale", pad_stiffness_scale,
      {"factor on the modulus of soft pads", 0.01, 1e4});
    v("drive_torque_scale", drive_torque_scale, {"factor on the drives' torque limits", 0.01, 100});
    v("joint_error_scale", joint_error_scale,
      {"factor on the drives' error from trial to trial", 0, 10});
    v("coupling_rule", coupling_rule,
      "rule of coupled joints: own (as hand.yaml says), middle-first, even or fixed");
  }
};

/** "own" (what hand.yaml says) and the rules. */
std::vector<std::string> ListModelCouplings();

/** @pre model.coupling_rule is one of ListModelCouplings(). */
void ApplyModel(const ModelConfig& model, Hand& hand);
void ApplyModel(const ModelConfig& model, GraspObject& object);

}  // namespace graspbench
