#include "datasets/plan/imperfection_config.h"

#include <algorithm>

#include "core/base/config.h"
#include "core/base/error.h"

namespace graspbench {
namespace {

bool Turns(const HandJoint& joint) { return !joint.is_prismatic; }
bool TurnsByDrive(const HandJoint& joint) { return Turns(joint) && joint.coupled_to < 0; }
bool TurnsByCoupling(const HandJoint& joint) { return Turns(joint) && joint.coupled_to >= 0; }

void CheckConcerned(const Hand& hand, const char* key, bool (*is_concerned)(const HandJoint&),
                    const char* expected) {
  if (std::any_of(hand.joints.begin(), hand.joints.end(), is_concerned)) return;
  throw Error(ErrorKind::kUsage, std::string("imperfections.") + key +
                                     " concerns nothing of the "
                                     "hand \"" +
                                     hand.id + "\": it has no joint that " + expected +
                                     "; leave the setting or the hand out");
}

}  // namespace

bool operator==(const ImperfectionConfig& a, const ImperfectionConfig& b) {
  return HaveEqualValues(a, b);
}

void ApplyImperfections(const ImperfectionConfig& config, Hand& hand) {
  const char* const turns = "turns by a drive of its own";
  if (config.hysteresis > 0.0) CheckConcerned(hand, "hysteresis_rad", TurnsByDrive, turns);
  if (config.stick_slip > 0.0) CheckConcerned(hand, "stick_slip", TurnsByDrive, turns);
  if (config.coupling_compliance > 0.0) {
    CheckConcerned(hand, "coupling_compliance_rad_per_nm", TurnsByCoupling,
                   "turns with another (coupling in hand.yaml)");
  }
  for (HandJoint& joint : hand.joints) {
    joint.drive.stiffness *= config.stiffness_scale;
    if (TurnsByDrive(joint)) {
      joint.drive.hysteresis_width = config.hysteresis;
      joint.drive.friction_static = config.stick_slip * joint.drive.torque_limit;
      joint.drive.friction_dynamic = kSlidingFrictionShare * joint.drive.friction_static;
    } else if (TurnsByCoupling(joint)) {
      joint.coupling_compliance = config.coupling_compliance;
    }
  }
}

}  // namespace graspbench
