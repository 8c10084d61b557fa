#pragma once
/** @file
What a benchmark session runs: read from YAML, completed with defaults, overridden by `--set a.b=v`,
frozen in full into the session's folder. */

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

/** How far a session's hands and objects differ from their files: factors on what no data sheet
gives or nobody has measured. The defaults change nothing. */
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

/** "own" (what hand.yaml says) and the rules. */
std::vector<std::string> ListModelCouplings();

/** @pre model.coupling_rule is one of ListModelCouplings(). */
void ApplyModel(const ModelConfig& model, Hand& hand);
void ApplyModel(const ModelConfig& model, GraspObject& object);

/** What a session's real hands do beside following their commands, as named options
(core/physics/imperfect_drive.h). The thesis names all four and gives no size; none is the default,
and the same for every hand of the session. Joints that slide have no hysteresis, stick-slip or
yielding coupling. */
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

/** Half-widths of the uniform variation between trials. Proposed by graspbench, not by the thesis.
 */
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

/** How people grip, which is what sessions do by default (datasets/presets/people.yaml): twice the
smallest force that bears the weight, at least grip_force, closing gently after the touch. */
inline StrategyConfig MakePeopleGrip() {
  StrategyConfig strategy;
  strategy.grip = "margin";
  strategy.touch_speed = 0.25;
  return strategy;
}

/** What holds for every trial of a session, and of a scene's optimisation. */
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

/** What differs from the session as it is configured: conditions.h. */
struct Condition {
  std::string name;                   ///< unique in its session
  std::vector<std::string> settings;  ///< "model.mass_scale=0.5", as NormaliseSetting writes them
};

struct SessionConfig : TrialConditions {
  std::vector<std::string> hands = {"tum", "shadow"};
  std::vector<std::string> objects = {"all"};
  std::vector<std::string> grasps = {"best"};  ///< "all", or words, ids, files
  std::string approach = "automatic";          ///< core/shape/grasp_object.h
  std::string positioning = "nominal";         ///< core/trial/trial_setup.h
  ArmConfig arm;                               ///< that carries the hands; none by default
  CameraConfig camera;                         ///< for positioning, and grasps, by camera
  std::string touch = "exact";                 ///< core/trial/touch_sensors.h
  SensorConfig sensors;                        ///< for touch: sensed
  ImperfectionConfig imperfections;            ///< of the hands; none by default
  PolicyConfig policy;                         ///< a controller in the place of the strategy
  int trials = 10;                             ///< per hand, object and grasp
  int seed = 1;
  /** Where draws come from: "random", or "halton" (a basin's); no key of session files. */
  std::string draws = "random";
  /** Under which every draw is tried again, beside the base, which is the rest of this. */
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
  /** Without what a campaign does not choose. */
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

/** A session file: what is left out is that of a preset, or the default. */
struct SessionFile : SessionConfig {
  std::string preset;  ///< datasets/plan/session_config.h; empty: none

  template <class V>
  void Visit(V&& v) {
    v("preset", preset, "named settings in the place of the defaults; graspbench help lists them");
    SessionConfig::Visit(v);
  }
};

/** The keys of a session file. The ranges keep the simulation stable and short; they are wider than
anything sensible. */
const FileKeys& ListSessionKeys();

/** A value that a session must not have. */
struct ConfigProblem {
  std::string key;   ///< full name: "sim.step_s"
  std::string text;  ///< what it is and what was expected
};

/** Values of the simulation that contradict each other, in a session or a profile: keys
("sim.table_friction_dynamic") with what is wrong. Ranges are checked where the keys are listed. */
std::vector<std::pair<std::string, std::string>> FindSimProblems(const SimConfig& sim);

/** All problems of the values: ranges, empty or repeated names. Whether hands, objects and grasps
of these names exist is asked when they are loaded (session_inputs.h). */
[[nodiscard]] std::vector<ConfigProblem> Validate(const SessionConfig& config);
/** @throws Error(kRange) listing all problems. */
void CheckSessionConfig(const SessionConfig& config);

/** @throws Error(kNotFound, kIo) when the file cannot be read; Error(kFormat) listing every problem
with file and line; unknown keys are errors. */
SessionConfig LoadSessionConfig(const std::string& path);
/** The same for text in memory; `file` is its name in messages. */
SessionConfig ParseSessionConfig(const std::string& text, const std::string& file);
/** What a preset contains. @throws as FindPreset; Error(kFormat) as LoadSessionConfig. */
[[nodiscard]] SessionConfig LoadPreset(const std::string& name);

/** Applies "sim.step_s=0.001". The range is checked with the rest, by CheckSessionConfig.
@throws Error(kUsage) naming the known keys or the expected type. */
void ApplySetting(const std::string& assignment, SessionConfig& config);

/** The complete configuration, every default written out, but for an automatic approach, nominal
positioning, no arm, exact touch, a grip by posture with its keys, no imperfections, no controller,
random draws, no conditions, and for camera and sensors of a session without them: sessions without
a choice are what they were before there was one. */
Json ToJson(const SessionConfig& config);
/** @param file  name of the file in messages.
@throws Error(kFormat) listing every missing, unknown or wrong key or value. */
SessionConfig SessionConfigFromJson(const Json& json, const std::string& file = "session.json");

/** Named settings of sessions: the files of datasets/presets, `<name>.yaml` each. A preset is a
session file that stands in the place of the defaults; a session that begins with one freezes what
it contains, so a later change of the preset changes no session. */
struct Preset {
  std::string name;
  std::filesystem::path file;
  std::string about;  ///< its first line, which is a comment
};

/** Sorted by name. @throws Error(kIo) when a file of the folder cannot be read. */
[[nodiscard]] std::vector<Preset> ListPresets();

/** @throws Error(kNotFound) with suggestions; as ListPresets. */
[[nodiscard]] Preset FindPreset(const std::string& name);

}  // namespace graspbench
