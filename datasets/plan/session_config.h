#pragma once
/** @file
What a benchmark session runs: read from YAML, completed with defaults, overridden by `--set a.b=v`,
frozen in full into the session's folder. */

#include <string>
#include <vector>

#include "core/base/file_keys.h"
#include "core/base/text/json.h"
#include "core/grasp/strategy.h"
#include "core/physics/sim_config.h"
#include "core/trial/touch_sensors.h"
#include "core/vision/camera_config.h"
#include "datasets/plan/imperfection_config.h"
#include "datasets/plan/model_config.h"

namespace graspbench {

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
  std::vector<std::string> grasps = {"best"};  ///< "all", or "best", "by-sight", ids, files
  std::string approach = "automatic";          ///< core/shape/approach.h
  std::string positioning = "nominal";         ///< core/trial/positioning.h
  CameraConfig camera;                         ///< for positioning, and grasps, by camera
  std::string touch = "exact";                 ///< core/trial/touch_sensors.h
  SensorConfig sensors;                        ///< for touch: sensed
  ImperfectionConfig imperfections;            ///< of the hands; none by default
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
    v("camera", camera);
    v("touch", touch,
      "by what closure and stabilisation end: exact (the contacts) or sensed (what the elements of "
      "the hand's tactile.yaml feel)");
    v("sensors", sensors);
    v("imperfections", imperfections);
  }
  /** Without what a campaign does not choose. */
  template <class V>
  void VisitOwn(V&& v) {
    v("hands", hands, "hands by id, name or folder, or all");
    v("objects", objects, "objects by id, name or folder, or all");
    v("grasps", grasps,
      "standard grasps by id or name, grasp files (.yaml), best, by-sight, or all");
    v("trials", trials, {"trials of each hand, object and grasp", 1, 100000});
    v("seed", seed, {"random seed; another seed gives other sampled poses", 0, 2147483647});
    TrialConditions::Visit(v);
  }
};

/** A session file: what is left out is that of a preset, or the default. */
struct SessionFile : SessionConfig {
  std::string preset;  ///< datasets/plan/presets.h; empty: none

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
positioning, exact touch, a grip by posture with its keys, no imperfections, random draws,
no conditions, and for camera and sensors
of a session without them: sessions without a choice are what they were before there was one. */
Json ToJson(const SessionConfig& config);
/** @param file  name of the file in messages.
@throws Error(kFormat) listing every missing, unknown or wrong key or value. */
SessionConfig SessionConfigFromJson(const Json& json, const std::string& file = "session.json");

}  // namespace graspbench
