#pragma once
/** @file
Settings of the physics, and the number that tells its versions apart. */

namespace graspbench {

/** Counts changes of the physics that change results. Part of every trial id, so that records of
different physics never meet under one id. */
inline constexpr int kPhysicsVersion = 5;

/** Settings of the physics; part of the frozen session configuration. */
struct SimConfig {
  double step = 0.002;             ///< [s]
  double contact_stiffness = 1e5;  ///< normal, per contact point [N/m]
  /** Hunt-Crossley d in f = k x (1 + d xdot) [s/m]. Proposed: what meets at 0.05 m/s parts with 0.6
  of that, as soft fingertips and things on a table do; metal balls have 0.1 to 0.5. */
  double contact_dissipation = 20.0;
  double tangential_stiffness = 1e5;   ///< bristle, per contact point [N/m]
  double table_friction_static = 0.4;  ///< object and fingers on the table
  double table_friction_dynamic = 0.35;

  template <class V>
  void Visit(V&& v) {
    v("step_s", step);
    v("contact_stiffness_n_per_m", contact_stiffness);
    v("contact_dissipation_s_per_m", contact_dissipation);
    v("tangential_stiffness_n_per_m", tangential_stiffness);
    v("table_friction_static", table_friction_static);
    v("table_friction_dynamic", table_friction_dynamic);
  }
};

}  // namespace graspbench
