#pragma once
/** @file
What a session's real hands do beside following their commands, as named options
(core/physics/imperfect_drive.h). The thesis names all four and gives no size; none is the default,
and the same for every hand of the session. Joints that slide have no hysteresis, stick-slip or
yielding coupling. */

#include "core/hand/hand.h"

namespace graspbench {

struct ImperfectionConfig {
  double hysteresis = 0.0;           ///< width of the loop between command and joint [rad]
  double stick_slip = 0.0;           ///< breakaway friction over the drive's torque limit
  double stiffness_scale = 1.0;      ///< factor on the drives' stiffness; damping stays
  double coupling_compliance = 0.0;  ///< of coupled joints [rad/(N m)]

  template <class V>
  void Visit(V&& v) {
    v("hysteresis_rad", hysteresis,
      {"width of the loop between a drive's command and its joint; 0: none", 0, 0.3});
    v("stick_slip", stick_slip,
      {"friction at which a resting joint breaks loose, share of its drive's torque limit; 0: none",
       0, 0.9});
    v("stiffness_scale", stiffness_scale, {"factor on the drives' stiffness", 0.05, 10});
    v("coupling_compliance_rad_per_nm", coupling_compliance,
      {"how far coupled joints yield from where their coupling has them; 0: rigid", 0, 10});
  }
};

/** Sliding friction over breakaway friction under stick_slip. Proposed. */
inline constexpr double kSlidingFrictionShare = 0.6;

bool operator==(const ImperfectionConfig& a, const ImperfectionConfig& b);

/** @throws Error(kUsage) where an option concerns no joint of the hand. */
void ApplyImperfections(const ImperfectionConfig& config, Hand& hand);

}  // namespace graspbench
