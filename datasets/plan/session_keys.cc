#include "datasets/plan/session_keys.h"

#include "core/base/config.h"
#include "datasets/plan/session_config.h"

namespace graspbench {

const FileKeys& ListSessionKeys() {
  static const FileKeys rows = {
      {"preset", "", "named settings in the place of the defaults; graspbench help lists them"},
      {"hands", "", "hands by id, name or folder, or all"},
      {"objects", "", "objects by id, name or folder, or all"},
      {"grasps", "", "standard grasps by id or name, grasp files (.yaml), best, by-sight, or all"},
      {"approach", "",
       "from where hands come: above, side, or automatic (as objects and grasps say)"},
      {"positioning", "",
       "what the hand knows of the object's place: nominal (nothing), true (all), or camera (what "
       "the camera of its hand.yaml finds)"},
      {"camera.look_height_m", "", "of the camera above the table while it looks", 0.25, 2},
      {"camera.noise_grey_levels", "", "standard deviation, each channel", 0, 100},
      {"camera.blur_px", "", "standard deviation", 0, 20},
      {"camera.exposure", "", "factor on the light", 0.01, 100},
      {"camera.shadows", "", "pictures in full quality, which take six times as long"},
      {"camera.table_colour", "", "of the table's cloth in these pictures, as #rrggbb"},
      {"touch", "",
       "by what closure and stabilisation end: exact (the contacts) or sensed (what the elements "
       "of "
       "the hand's tactile.yaml feel)"},
      {"sensors.patch_radius_m", "", "of the disc on which a contact of 5 N presses", 0.0001, 0.05},
      {"sensors.force_scale_n", "", "of an exponential response", 0.01, 1000},
      {"sensors.saturation_n", "", "force of an element above which nothing changes", 0.01, 1000},
      {"sensors.hysteresis", "", "share by which a falling force is remembered", 0, 0.9},
      {"sensors.noise", "", "standard deviation, share of the full reading", 0, 1},
      {"sensors.threshold", "", "detection threshold, share of the full reading", 0, 1},
      {"sensors.rate_hz", "", "samples of every element", 1, 10000},
      {"imperfections.hysteresis_rad", "",
       "width of the loop between a drive's command and its joint; 0: none", 0, 0.3},
      {"imperfections.stick_slip", "",
       "friction at which a resting joint breaks loose, share of its drive's torque limit; 0: none",
       0, 0.9},
      {"imperfections.stiffness_scale", "", "factor on the drives' stiffness", 0.05, 10},
      {"imperfections.coupling_compliance_rad_per_nm", "",
       "how far coupled joints yield from where their coupling has them; 0: rigid", 0, 10},
      {"trials", "", "trials of each hand, object and grasp", 1, 100000},
      {"seed", "", "another seed gives other draws", 0, 2147483647},
      {"variation.offset_m", "",
       "half-width of the object's place in x and y, drawn for each trial", 0, 0.1},
      {"variation.yaw_rad", "", "half-width of its turn about the vertical, drawn likewise", 0,
       3.1416},
      {"strategy.placing_time_s", "", "the open hand's way to the object", 0.05, 60},
      {"strategy.closure_time_s", "", "from pre-grasp to target posture with nothing between", 0.05,
       60},
      {"strategy.closure_patience_s", "",
       "at the target posture: how long missing digits are waited "
       "for",
       0, 60},
      {"strategy.stabilisation_min_time_s", "", "at least this long before the lift", 0, 60},
      {"strategy.stabilisation_max_time_s", "",
       "at most this long before the lift; of a regulated grip after its digits have closed", 0,
       60},
      {"strategy.lift_time_s", "", "duration of the lift", 0.05, 60},
      {"strategy.hold_time_s", "", "the object must be held so long after the lift", 0, 60},
      {"strategy.closure_lead_s", "", "closure begins so long before the hand has arrived", 0, 60},
      {"strategy.grip", "",
       "what ends the closing of a digit: posture (its target), force (grip_force_n) or margin "
       "(grip_margin)"},
      {"strategy.grip_force_n", "",
       "asked of each digit that does not oppose the others; with margin at least this; 0: no "
       "least",
       0, 1000},
      {"strategy.grip_margin", "",
       "times the smallest force with which the contacts bear the weight, which the hand is told "
       "with the friction",
       1, 100},
      {"strategy.touch_speed", "", "of a digit's closing after its first touch, share of its speed",
       0.01, 1},
      {"strategy.drive_law", "",
       "how drives hold a regulated force: hold (a position, with their stiffness) or saturating "
       "(a limit of their torque, without)"},
      {"sim.step_s", "", "of the physics", 1e-4, 1e-2},
      {"sim.steady_step_factor", "",
       "so many steps, of 10 ms together at most, are one while what hangs in the hand keeps its "
       "contacts; 1: none are",
       1, 100},
      {"sim.gravity_m_per_s2", "", "downwards", 0, 100},
      {"sim.contact_stiffness_n_per_m", "", "normal, of one contact point", 100, 1e7},
      {"sim.tangential_stiffness_n_per_m", "", "of one contact point before it slips", 100, 1e7},
      {"sim.table_friction_static", "", "of object and fingers on the table", 0, 2},
      {"sim.table_friction_dynamic", "", "likewise, sliding; at most the static one", 0, 2},
      {"sim.table_rolling_resistance_m", "",
       "a round part of an object that rolls on the table under the force N is braked by the "
       "moment "
       "of this times N; 0: it rolls for ever",
       0, 0.1},
      {"sim.hand_friction_static", "", "of the hand against itself, where its links say nothing", 0,
       2},
      {"sim.hand_friction_dynamic", "", "likewise, sliding; at most the static one", 0, 2},
      {"sim.arm_stiffness_n_per_m", "", "of the arm at the hand's base", 100, 1e7},
      {"sim.arm_angular_stiffness_nm_per_rad", "", "of the arm about the hand's base", 10, 1e6},
      {"sim.arm_damping_time_s", "", "the arm's damping over its stiffness", 0, 1},
      {"sim.arm_force_limit_n", "", "along each axis; a trial that reaches it ends", 1, 1e6},
      {"sim.arm_moment_limit_nm", "", "about the hand's base, likewise", 0.1, 1e6},
      {"sim.multibody", "",
       "arrays: the program's own mass matrix and bias, compared with Simbody's at the end of "
       "every "
       "trial; simbody: Simbody's in every step, slower, for checking"},
      {"model.mass_scale", "", "factor on every object's mass and inertia", 0.01, 100},
      {"model.friction_scale", "", "factor on the friction of objects and links", 0, 10},
      {"model.pad_torsion_scale", "", "factor on every torsion radius", 0, 10},
      {"model.pad_stiffness_scale", "", "factor on the modulus of soft pads", 0.01, 1e4},
      {"model.drive_torque_scale", "", "factor on the drives' torque limits", 0.01, 100},
      {"model.joint_error_scale", "", "factor on the drives' error from trial to trial", 0, 10},
      {"model.coupling_rule", "",
       "of coupled joints: own (as hand.yaml says), middle-first, even or "
       "fixed"},
  };
  static const FileKeys keys = DescribeConfig(SessionFile(), rows);
  return keys;
}

}  // namespace graspbench
