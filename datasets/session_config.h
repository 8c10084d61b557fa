#pragma once
/** @file
What a benchmark session runs: read from YAML, completed with defaults, overridden by `--set a.b=v`,
frozen in full into the session's folder. */

#include <string>
#include <vector>

#include "core/base/json.h"
#include "core/sim/trial.h"

namespace graspbench {

/** Half-widths of the uniform variation between trials. Proposed by graspbench, not by the thesis.
 */
struct VariationConfig {
  double offset = 0.005;             ///< object in x and y [m]
  double yaw = 0.08726646259971647;  ///< object about the vertical [rad]

  template <class V>
  void Visit(V&& v) {
    v("offset_m", offset);
    v("yaw_rad", yaw);
  }
};

struct SessionConfig {
  std::vector<std::string> hands = {"tum", "shadow"};
  std::vector<std::string> objects = {"all"};
  std::vector<std::string> grasps = {"best"};  ///< "best", "all" or ids
  int trials = 10;                             ///< per hand, object and grasp
  int seed = 1;
  VariationConfig variation;
  StrategyConfig strategy;
  SimConfig sim;

  template <class V>
  void Visit(V&& v) {
    v("hands", hands);
    v("objects", objects);
    v("grasps", grasps);
    v("trials", trials);
    v("seed", seed);
    v("variation", variation);
    v("strategy", strategy);
    v("sim", sim);
  }
};

/** @throws Error(kFormat, kRange) listing every problem with file and line; unknown keys are
 * errors. */
SessionConfig LoadSessionConfig(const std::string& path);

/** Applies "sim.step_s=0.001". @throws Error(kUsage) naming the known keys. */
void ApplySetting(const std::string& assignment, SessionConfig& config);

/** The complete configuration, every default written out. */
Json ToJson(const SessionConfig& config);
SessionConfig SessionConfigFromJson(const Json& json);

}  // namespace graspbench
