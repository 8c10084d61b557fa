#pragma once
/** @file
Which arm carries the hands of a session, and where it stands. */

#include <string>

namespace graspbench {

/** World frame W: the table's top is z = 0, the object's nominal place is the origin. */
struct ArmConfig {
  static constexpr const char* kNone = "none";

  std::string model = kNone;  ///< id or folder (core/arm/load_arm.h)
  double x = -0.5;            ///< of the arm's base frame B in W [m]
  double y = 0.0;             ///< [m]
  double z = 0.0;             ///< [m], not below the table's top
  double yaw = 0.0;           ///< of B about the vertical [rad]
  std::string mount = "z";    ///< of ListMounts (core/arm/mounted_arm.h)

  template <class V>
  void Visit(V&& v) {
    v("model", model, "arm that carries the hand, by id or folder; none: no arm");
    v("base_x_m", x, {"x position of the arm's base; the object is at x = 0", -5, 5});
    v("base_y_m", y, {"y position of the arm's base; the object is at y = 0", -5, 5});
    v("base_z_m", z, {"height of the arm's base above the table", -5, 5});
    v("base_yaw_rad", yaw, {"rotation of the arm's base about the vertical", -6.2832, 6.2832});
    v("mount", mount, "axis of the hand's frame that lies along the flange's axis: x, -x, .. -z");
  }
};

inline bool HasArm(const ArmConfig& config) { return config.model != ArmConfig::kNone; }

}  // namespace graspbench
