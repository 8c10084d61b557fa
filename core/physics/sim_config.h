#pragma once
/** @file
Settings of the physics, and the version number of the physics. */

#include <Eigen/Core>

#include "core/base/units.h"

namespace graspbench {

/** Counts changes of the physics, or of a record's measures, that change results. It is part of
every trial id, so that records of different physics never share an id. */
inline constexpr int kPhysicsVersion = 14;

/** Settings of the physics; part of the stored session configuration. */
struct SimConfig {
  double step = 0.002;  ///< [s]
  /** Number of steps taken as one while contacts are steady (contact_events.h); 1: never. */
  int steady_step_factor = 5;
  double gravity = kStandardGravity;   ///< downwards [m/s^2]
  double contact_stiffness = 1e5;      ///< normal, per contact point [N/m]
  double tangential_stiffness = 1e5;   ///< of the bristle, per contact point [N/m]
  double table_friction_static = 0.4;  ///< of object and fingers on the table
  double table_friction_dynamic = 0.35;
  /** Rolling resistance c: a round part that rolls on the table under the normal force N is braked
  by the moment c N. c is some 0.1 to 1 mm for wood, leather and plastics, and hundredths of a
  millimetre for hard metal. The proposed value is the low end of the former. */
  double table_rolling_resistance = 1e-4;  ///< [m]
  double hand_friction_static = 0.5;       ///< between links of the hand that specify no friction
  double hand_friction_dynamic = 0.4;

  /** The arm is a spring-damper between the hand's base and its commanded pose; it carries the hand
  itself without deflection. The thesis names the arms (PUMA; Mitsubishi PA-10) but not their
  stiffness, so all five values are proposed:
  - stiffness: 1 mm at 20 N;
  - angular stiffness: 1 mm at a distance of 0.3 m under the same force;
  - damping: nearly critical with a hand of 1 to 4 kg;
  - limits: the weight of the PA-10's payload of 10 kg, and that weight 0.2 m from the wrist. */
  double arm_stiffness = 2e4;          ///< [N/m]
  double arm_angular_stiffness = 2e3;  ///< about H's origin [N m/rad]
  double arm_damping_time = 0.02;      ///< damping divided by stiffness [s]
  double arm_force_limit = 98.0;       ///< along each axis of W; reaching it ends the trial [N]
  double arm_moment_limit = 20.0;      ///< about H's origin; reaching it ends the trial [N m]

  template <class V>
  void Visit(V&& v) {
    v("step_s", step, {"time step of the physics", 1e-4, 1e-2});
    v("steady_step_factor", steady_step_factor,
      {"number of steps that are taken as one, 10 ms at most, while the contacts of the held "
       "object stay the same; 1: none",
       1, 100});
    v("gravity_m_per_s2", gravity, {"gravitational acceleration, downwards", 0, 100});
    v("contact_stiffness_n_per_m", contact_stiffness,
      {"normal stiffness of one contact point", 100, 1e7});
    v("tangential_stiffness_n_per_m", tangential_stiffness,
      {"tangential stiffness of one contact point before it slips", 100, 1e7});
    v("table_friction_static", table_friction_static,
      {"static friction of object and fingers on the table", 0, 2});
    v("table_friction_dynamic", table_friction_dynamic,
      {"dynamic friction of object and fingers on the table; at most the static one", 0, 2});
    v("table_rolling_resistance_m", table_rolling_resistance,
      {"rolling resistance of an object on the table: braking moment over normal force; 0: none", 0,
       0.1});
    v("hand_friction_static", hand_friction_static,
      {"static friction between links of the hand that state no friction", 0, 2});
    v("hand_friction_dynamic", hand_friction_dynamic,
      {"dynamic friction between links of the hand that state no friction; at most the static one",
       0, 2});
    v("arm_stiffness_n_per_m", arm_stiffness,
      {"translational stiffness of the arm at the hand's base", 100, 1e7});
    v("arm_angular_stiffness_nm_per_rad", arm_angular_stiffness,
      {"rotational stiffness of the arm about the hand's base", 10, 1e6});
    v("arm_damping_time_s", arm_damping_time, {"damping of the arm over its stiffness", 0, 1});
    v("arm_force_limit_n", arm_force_limit,
      {"limit of the arm's force along each axis; a trial that reaches it ends", 1, 1e6});
    v("arm_moment_limit_nm", arm_moment_limit,
      {"limit of the arm's moment about the hand's base; a trial that reaches it ends", 0.1, 1e6});
  }
};

/** Returns the gravitational acceleration in W [m/s^2]. */
inline Eigen::Vector3d MakeGravity(const SimConfig& config) { return {0.0, 0.0, -config.gravity}; }

/** Whether the scene has a table: the plane z = 0. */
enum class TablePresence { kPresent, kNone };

}  // namespace graspbench
