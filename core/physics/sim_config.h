#pragma once
/** @file
Settings of the physics, and the number that tells its versions apart. */

namespace graspbench {

/** Counts changes of the physics that change results. Part of every trial id, so that records of
different physics never meet under one id. */
inline constexpr int kPhysicsVersion = 6;

/** Settings of the physics; part of the frozen session configuration. */
struct SimConfig {
  double step = 0.002;                 ///< [s]
  double contact_stiffness = 1e5;      ///< normal, per contact point [N/m]
  double tangential_stiffness = 1e5;   ///< bristle, per contact point [N/m]
  double table_friction_static = 0.4;  ///< object and fingers on the table
  double table_friction_dynamic = 0.35;
  double hand_friction_static = 0.5;  ///< of the hand against itself, where its links say nothing
  double hand_friction_dynamic = 0.4;

  /** The arm stands still under any load up to these, beside the weight of the hand itself; beyond,
  the trial ends. Proposed: the payload of the larger of the thesis' two arms, 10 kg (Mitsubishi
  PA-10), and its weight at 0.2 m from the wrist. */
  double arm_force_limit = 98.0;   ///< [N]
  double arm_moment_limit = 20.0;  ///< about H's origin [N m]

  template <class V>
  void Visit(V&& v) {
    v("step_s", step);
    v("contact_stiffness_n_per_m", contact_stiffness);
    v("tangential_stiffness_n_per_m", tangential_stiffness);
    v("table_friction_static", table_friction_static);
    v("table_friction_dynamic", table_friction_dynamic);
    v("hand_friction_static", hand_friction_static);
    v("hand_friction_dynamic", hand_friction_dynamic);
    v("arm_force_limit_n", arm_force_limit);
    v("arm_moment_limit_nm", arm_moment_limit);
  }
};

}  // namespace graspbench
