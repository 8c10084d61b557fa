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
      {"camera.look_height_m", "",
       "height of the camera above the table while it takes its picture", 0.25, 2},
      {"camera.noise_grey_levels", "", "standard deviation of the noise of each colour channel", 0,
       100},
      {"camera.blur_px", "", "standard deviation of the blur", 0, 20},
      {"camera.exposure", "", "factor on the light of the camera's picture", 0.01, 100},
      {"camera.shadows", "",
       "whether the camera's pictures show shadows; such pictures take six times as long"},
      {"camera.table_colour", "", "colour of the table in the camera's pictures, as #rrggbb"},
      {"touch", "",
       "by what closure and stabilisation end: exact (the contacts) or sensed (what the elements "
       "of "
       "the hand's tactile.yaml feel)"},
      {"sensors.patch_radius_m", "",
       "radius of the disc on which a contact of 5 N presses a tactile element", 0.0001, 0.05},
      {"sensors.force_scale_n", "", "force scale of a tactile element's exponential response", 0.01,
       1000},
      {"sensors.saturation_n", "",
       "force above which the reading of a tactile element stays constant", 0.01, 1000},
      {"sensors.hysteresis", "",
       "hysteresis of a tactile element: a falling force f reads as at most f / (1 - hysteresis)",
       0, 0.9},
      {"sensors.noise", "",
       "standard deviation of a tactile element's noise, share of the full reading", 0, 1},
      {"sensors.threshold", "",
       "detection threshold of a tactile element, share of the full reading", 0, 1},
      {"sensors.rate_hz", "", "sampling rate of every tactile element", 1, 10000},
      {"imperfections.hysteresis_rad", "",
       "width of the loop between a drive's command and its joint; 0: none", 0, 0.3},
      {"imperfections.stick_slip", "",
       "friction at which a resting joint breaks loose, share of its drive's torque limit; 0: none",
       0, 0.9},
      {"imperfections.stiffness_scale", "", "factor on the drives' stiffness", 0.05, 10},
      {"imperfections.coupling_compliance_rad_per_nm", "",
       "how far coupled joints yield from where their coupling has them; 0: rigid", 0, 10},
      {"trials", "", "trials of each hand, object and grasp", 1, 100000},
      {"seed", "", "random seed; another seed gives other sampled poses", 0, 2147483647},
      {"variation.offset_m", "",
       "half-width of the object's place in x and y, drawn for each trial", 0, 0.1},
      {"variation.yaw_rad", "",
       "half-width of the object's rotation about the vertical, drawn for each trial", 0, 3.1416},
      {"strategy.placing_time_s", "", "time in which the open hand moves to the object", 0.05, 60},
      {"strategy.closure_time_s", "",
       "time of closing from pre-grasp to target posture without contact", 0.05, 60},
      {"strategy.closure_patience_s", "",
       "time at the target posture during which digits without contact are awaited", 0, 60},
      {"strategy.stabilisation_min_time_s", "", "minimum time of stabilisation before the lift", 0,
       60},
      {"strategy.stabilisation_max_time_s", "",
       "maximum time of stabilisation before the lift; with a regulated grip, after its digits "
       "have "
       "closed",
       0, 60},
      {"strategy.lift_time_s", "", "duration of the lift", 0.05, 60},
      {"strategy.hold_time_s", "", "time for which the object must be held after the lift", 0, 60},
      {"strategy.closure_lead_s", "", "time by which closure begins before the hand arrives", 0,
       60},
      {"strategy.grip", "",
       "what ends the closing of a digit: posture (its target), force (grip_force_n) or margin "
       "(grip_margin)"},
      {"strategy.grip_force_n", "",
       "force setpoint of each digit that does not oppose the others; with strategy.grip=margin "
       "the "
       "minimum setpoint; 0: no minimum",
       0, 1000},
      {"strategy.grip_margin", "",
       "safety factor of the grip: multiple of the smallest forces with which the contacts bear "
       "the "
       "weight; object weight and friction are given to the controller",
       1, 100},
      {"strategy.touch_speed", "",
       "closing speed of a digit after its first contact, share of its speed before", 0.01, 1},
      {"strategy.drive_law", "",
       "how drives hold a regulated force: hold (a position, with their stiffness) or saturating "
       "(a limit of their torque, without)"},
      {"sim.step_s", "", "time step of the physics", 1e-4, 1e-2},
      {"sim.steady_step_factor", "",
       "number of steps that are taken as one, 10 ms at most, while the contacts of the held "
       "object "
       "stay the same; 1: none",
       1, 100},
      {"sim.gravity_m_per_s2", "", "gravitational acceleration, downwards", 0, 100},
      {"sim.contact_stiffness_n_per_m", "", "normal stiffness of one contact point", 100, 1e7},
      {"sim.tangential_stiffness_n_per_m", "",
       "tangential stiffness of one contact point before it slips", 100, 1e7},
      {"sim.table_friction_static", "", "static friction of object and fingers on the table", 0, 2},
      {"sim.table_friction_dynamic", "",
       "dynamic friction of object and fingers on the table; at most the static one", 0, 2},
      {"sim.table_rolling_resistance_m", "",
       "rolling resistance of an object on the table: braking moment over normal force; 0: none", 0,
       0.1},
      {"sim.hand_friction_static", "",
       "static friction between links of the hand that state no friction", 0, 2},
      {"sim.hand_friction_dynamic", "",
       "dynamic friction between links of the hand that state no friction; at most the static one",
       0, 2},
      {"sim.arm_stiffness_n_per_m", "", "translational stiffness of the arm at the hand's base",
       100, 1e7},
      {"sim.arm_angular_stiffness_nm_per_rad", "",
       "rotational stiffness of the arm about the hand's base", 10, 1e6},
      {"sim.arm_damping_time_s", "", "damping of the arm over its stiffness", 0, 1},
      {"sim.arm_force_limit_n", "",
       "limit of the arm's force along each axis; a trial that reaches it ends", 1, 1e6},
      {"sim.arm_moment_limit_nm", "",
       "limit of the arm's moment about the hand's base; a trial that reaches it ends", 0.1, 1e6},
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
       "rule of coupled joints: own (as hand.yaml says), middle-first, even or "
       "fixed"},
  };
  static const FileKeys keys = DescribeConfig(SessionFile(), rows);
  return keys;
}

}  // namespace graspbench
