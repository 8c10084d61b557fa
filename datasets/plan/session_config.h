#pragma once
/** @file
The configuration of a benchmark session: read from YAML, completed with defaults, overridden by
`--set a.b=v` and frozen in full in the session's folder. */

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/arm/arm_config.h"
#include "core/base/file_keys.h"
#include "core/base/text/json.h"
#include "core/grasp/strategy.h"
#include "core/hand/hand.h"
#include "core/physics/sim_config.h"
#include "core/shape/grasp_object.h"
#include "core/trial/policy/policy_config.h"
#include "core/trial/touch_sensors.h"
#include "core/vision/camera_config.h"

namespace graspbench {

/** How far a session's hands and objects differ from their files: factors on parameters that are
unmeasured or in no data sheet. The defaults change nothing. */
struct ModelConfig {
  static constexpr const char* kOwnRule = "own";

  double mass_scale = 1.0;               ///< of the object's mass and inertia
  double friction_scale = 1.0;           ///< of the coefficients of objects and links
  double pad_torsion_scale = 1.0;        ///< of every torsion radius
  double pad_stiffness_scale = 1.0;      ///< of the modulus of every soft pad
  double drive_torque_scale = 1.0;       ///< of the drives' torque limits
  double joint_error_scale = 1.0;        ///< of the drives' error from trial to trial
  std::string coupling_rule = kOwnRule;  ///< of coupled joints (core/hand/hand.h)

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

/** Lists the values of coupling_rule: "own" (the rule in hand.yaml) and the named rules. */
std::vector<std::string> ListModelCouplings();

/** Applies the factors to a hand or an object.
@pre model.coupling_rule is one of ListModelCouplings(). */
void ApplyModel(const ModelConfig& model, Hand& hand);
void ApplyModel(const ModelConfig& model, GraspObject& object);

/** How the joints of real hands deviate from their commands, as named options
(core/physics/imperfect_drive.h). The thesis names all four but quantifies none. By default there
are none; they are the same for every hand of the session. Prismatic joints have no hysteresis,
stick-slip or compliant coupling. */
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

/** @throws Error(kUsage) where an option applies to no joint of the hand. */
void ApplyImperfections(const ImperfectionConfig& config, Hand& hand);

/** Half-widths of the uniform variation between trials. Proposed by graspbench, not the thesis. */
struct VariationConfig {
  double offset = 0.005;             ///< object in x and y [m]
  double yaw = 0.08726646259971647;  ///< object about the vertical [rad]

  template <class V>
  void Visit(V&& v) {
    v("offset_m", offset,
      {"half-width of the object's place in x and y, drawn for each trial", 0, 0.1});
    v("yaw_rad", yaw,
      {"half-width of the object's rotation about the vertical, drawn for each trial", 0, 3.1416});
  }
};

/** The human-like grip that sessions use by default (datasets/presets/people.yaml): twice the
smallest force that bears the weight, at least grip_force, with slow closure after contact. */
inline StrategyConfig MakePeopleGrip() {
  StrategyConfig strategy;
  strategy.grip = "margin";
  strategy.touch_speed = 0.25;
  return strategy;
}

/** Conditions common to all trials of a session, or of a scene's optimisation. */
struct TrialConditions {
  VariationConfig variation;
  StrategyConfig strategy = MakePeopleGrip();
  SimConfig sim;
  ModelConfig model;

  template <class V>
  void Visit(V&& v) {
    v("variation", variation);
    v("strategy", strategy);
    v("sim", sim);
    v("model", model);
  }
};

/** A named change of the session's configuration (conditions.h). */
struct Condition {
  std::string name;                   ///< unique in its session
  std::vector<std::string> settings;  ///< "model.mass_scale=0.5", as NormaliseSetting writes them
};

struct SessionConfig : TrialConditions {
  std::vector<std::string> hands = {"tum", "shadow"};
  std::vector<std::string> objects = {"all"};
  std::vector<std::string> grasps = {"best"};  ///< names, ids or files, or "all"
  std::string approach = "automatic";          ///< core/shape/grasp_object.h
  std::string positioning = "nominal";         ///< core/trial/trial_setup.h
  ArmConfig arm;                               ///< carries the hands; none by default
  CameraConfig camera;                         ///< for positioning or grasps by camera
  std::string touch = "exact";                 ///< core/trial/touch_sensors.h
  SensorConfig sensors;                        ///< if touch is sensed
  ImperfectionConfig imperfections;            ///< of the hands; none by default
  PolicyConfig policy;                         ///< a controller instead of the strategy
  int trials = 10;                             ///< per hand, object and grasp
  int seed = 1;
  /** Source of the draws: "random", or "halton" for a basin; not a key of session files. */
  std::string draws = "random";
  /** Conditions under which every draw is repeated, in addition to the base. */
  std::vector<Condition> conditions;

  template <class V>
  void Visit(V&& v) {
    VisitOwn(v);
    v("approach", approach,
      "from where hands come: above, side, or automatic (as objects and grasps say)");
    v("positioning", positioning,
      "what the hand knows of the object's place: nominal (nothing), true (all), or camera (what "
      "the camera of its hand.yaml finds)");
    v("arm", arm);
    v("camera", camera);
    v("touch", touch,
      "by what closure and stabilisation end: exact (the contacts) or sensed (what the elements of "
      "the hand's tactile.yaml feel)");
    v("sensors", sensors);
    v("imperfections", imperfections);
    v("policy", policy);
  }
  /** Only the keys that a campaign also sets. */
  template <class V>
  void VisitOwn(V&& v) {
    v("hands", hands, "hands by id, name or folder, or all");
    v("objects", objects, "objects by id, name or folder, or all");
    v("grasps", grasps,
      "standard grasps by id or name, grasp files (.yaml), best, predicted, by-sight, rehearsed, "
      "rehearsed:N,k, or all");
    v("trials", trials, {"trials of each hand, object and grasp", 1, 100000});
    v("seed", seed, {"random seed; another seed gives other sampled poses", 0, 2147483647});
    TrialConditions::Visit(v);
  }
};

/** A session file. A key that is left out has the value of the preset, or else its default. */
struct SessionFile : SessionConfig {
  std::string preset;  ///< name in datasets/presets; empty: none

  template <class V>
  void Visit(V&& v) {
    v("preset", preset, "named settings in the place of the defaults; graspbench help lists them");
    SessionConfig::Visit(v);
  }
};

/** The keys of a session file. Their ranges keep the simulation stable and short, and are wider
than any sensible value. */
const FileKeys& ListSessionKeys();

/** A value that a session must not have. */
struct ConfigProblem {
  std::string key;   ///< full name: "sim.step_s"
  std::string text;  ///< the value found and what was expected
};

/** Finds contradictory values of the simulation, in a session or a profile: pairs of key
("sim.table_friction_dynamic") and problem. Ranges are checked where the keys are listed. */
std::vector<std::pair<std::string, std::string>> FindSimProblems(const SimConfig& sim);

/** Lists all problems of the values: ranges, and empty or repeated names. Whether the named hands,
objects and grasps exist is checked when they are loaded (session_inputs.h). */
[[nodiscard]] std::vector<ConfigProblem> Validate(const SessionConfig& config);
/** @throws Error(kRange) listing all problems. */
void CheckSessionConfig(const SessionConfig& config);

/** Reads a session file; unknown keys are errors.
@throws Error(kNotFound, kIo) when the file cannot be read; Error(kFormat) listing every problem
with file and line. */
SessionConfig LoadSessionConfig(const std::string& path);
/** As LoadSessionConfig(), for text in memory; `file` is its name in messages. */
SessionConfig ParseSessionConfig(const std::string& text, const std::string& file);
/** Returns the contents of a preset. @throws as FindPreset; Error(kFormat) as LoadSessionConfig. */
[[nodiscard]] SessionConfig LoadPreset(const std::string& name);

/** Applies an assignment such as "sim.step_s=0.001". CheckSessionConfig checks its range.
@throws Error(kUsage) naming the known keys or the expected type. */
void ApplySetting(const std::string& assignment, SessionConfig& config);

/** Writes the complete configuration, with every default written out. Left out are only: an
automatic approach, nominal positioning, no arm, exact touch, a grip by posture with its keys, no
imperfections, no controller, random draws, no conditions, and camera or sensors that the session
does not use. So older sessions without these keys keep their meaning. */
Json ToJson(const SessionConfig& config);
/** Reads what ToJson() writes. @param file  name of the file in messages.
@throws Error(kFormat) listing every missing or unknown key and every wrong value. */
SessionConfig SessionConfigFromJson(const Json& json, const std::string& file = "session.json");

/** A named set of session settings, in the file `<name>.yaml` of datasets/presets. A preset is a
session file that replaces the defaults. A session freezes the contents of its preset, so a later
change of the preset does not affect it. */
struct Preset {
  std::string name;
  std::filesystem::path file;
  std::string about;  ///< the first line of the file, a comment
};

/** Lists the presets by name. @throws Error(kIo) when a file of the folder cannot be read. */
[[nodiscard]] std::vector<Preset> ListPresets();

/** Finds a preset by name. @throws Error(kNotFound) with suggestions; as ListPresets. */
[[nodiscard]] Preset FindPreset(const std::string& name);

}  // namespace graspbench
