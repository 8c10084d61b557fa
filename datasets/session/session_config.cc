#include "datasets/session/session_config.h"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

#include "core/base/config.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/base/units.h"

namespace graspbench {
namespace {

/** Every number of a session and what it may be. The limits keep the simulation stable and short;
they are wider than anything sensible. */
struct Range {
  std::string_view key;
  double low;
  double high;
};
constexpr Range kRanges[] = {
    {"trials", 1, 100000},
    {"seed", 0, 2147483647},
    {"variation.offset_m", 0, 0.1},
    {"variation.yaw_rad", 0, kPi},
    {"strategy.placing_time_s", 0.05, 60},
    {"strategy.closure_time_s", 0.05, 60},
    {"strategy.closure_patience_s", 0, 60},
    {"strategy.stabilisation_min_time_s", 0, 60},
    {"strategy.stabilisation_max_time_s", 0, 60},
    {"strategy.lift_time_s", 0.05, 60},
    {"strategy.hold_time_s", 0, 60},
    {"sim.step_s", 1e-4, 1e-2},
    {"sim.contact_stiffness_n_per_m", 100, 1e7},
    {"sim.tangential_stiffness_n_per_m", 100, 1e7},
    {"sim.table_friction_static", 0, 2},
    {"sim.table_friction_dynamic", 0, 2},
    {"sim.hand_friction_static", 0, 2},
    {"sim.hand_friction_dynamic", 0, 2},
    {"sim.arm_stiffness_n_per_m", 100, 1e7},
    {"sim.arm_angular_stiffness_nm_per_rad", 10, 1e6},
    {"sim.arm_damping_time_s", 0, 1},
    {"sim.arm_force_limit_n", 1, 1e6},
    {"sim.arm_moment_limit_nm", 0.1, 1e6},
    {"model.mass_scale", 0.01, 100},
    {"model.friction_scale", 0, 10},
    {"model.pad_torsion_scale", 0, 10},
    {"model.drive_torque_scale", 0.01, 100},
    {"model.joint_error_scale", 0, 10},
};

Json FindValue(const Json& config, const std::string& full_key) {
  const size_t dot = full_key.find('.');
  if (dot == std::string::npos) return config.at(full_key);
  return FindValue(config.at(full_key.substr(0, dot)), full_key.substr(dot + 1));
}

void CheckNames(const std::string& key, const std::vector<std::string>& names,
                const std::vector<std::string>& words_for_many,
                std::vector<ConfigProblem>& problems) {
  if (names.empty()) {
    problems.push_back({key, "the list is empty; name at least one, or \"all\""});
  }
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (name->empty()) {
      problems.push_back({key, "a name is empty"});
    } else if (!IsUtf8(*name)) {
      problems.push_back({key, "\"" + *name + "\" is not UTF-8"});
    } else if (std::find(names.begin(), name, *name) != name) {
      problems.push_back({key, "\"" + *name + "\" is listed twice"});
    } else if (names.size() > 1 && std::find(words_for_many.begin(), words_for_many.end(), *name) !=
                                       words_for_many.end()) {
      problems.push_back({key, "\"" + *name + "\" must stand alone, without other names"});
    }
  }
}

}  // namespace

std::vector<ConfigProblem> Validate(const SessionConfig& config) {
  std::vector<ConfigProblem> problems;
  CheckNames("hands", config.hands, {"all"}, problems);
  CheckNames("objects", config.objects, {"all"}, problems);
  CheckNames("grasps", config.grasps, {"all"}, problems);
  const Json json = ToJson(config);
  for (const std::string& key : ListConfigKeys(config)) {
    const auto range = std::find_if(std::begin(kRanges), std::end(kRanges),
                                    [&](const Range& r) { return r.key == key; });
    if (range == std::end(kRanges)) continue;
    const double value = FindValue(json, key).get<double>();
    if (!(value >= range->low && value <= range->high)) {  // catches NaN too
      problems.push_back({key, fmt::format("{:.10g} is out of range; expected {:.10g} to {:.10g}",
                                           value, range->low, range->high)});
    }
  }
  if (config.strategy.stabilisation_min_time > config.strategy.stabilisation_max_time) {
    problems.push_back({"strategy.stabilisation_min_time_s",
                        "must not be longer than strategy.stabilisation_max_time_s"});
  }
  if (config.sim.table_friction_dynamic > config.sim.table_friction_static) {
    problems.push_back(
        {"sim.table_friction_dynamic", "must not be higher than sim.table_friction_static"});
  }
  if (config.sim.hand_friction_dynamic > config.sim.hand_friction_static) {
    problems.push_back(
        {"sim.hand_friction_dynamic", "must not be higher than sim.hand_friction_static"});
  }
  const std::vector<std::string> couplings = ListModelCouplings();
  const std::string& coupling = config.model.coupling_rule;
  if (std::find(couplings.begin(), couplings.end(), coupling) == couplings.end()) {
    problems.push_back({"model.coupling_rule",
                        "no rule \"" + coupling + "\"" + SuggestNames(coupling, couplings)});
  }
  return problems;
}

void CheckSessionConfig(const SessionConfig& config) {
  std::string text;
  for (const ConfigProblem& problem : Validate(config)) {
    text += "\n" + problem.key + ": " + problem.text;
  }
  if (!text.empty()) throw Error(ErrorKind::kRange, "the session cannot be run" + text);
}

SessionConfig LoadSessionConfig(const std::string& path) {
  return ParseSessionConfig(ReadFile(path), path);
}

SessionConfig ParseSessionConfig(const std::string& text, const std::string& file) {
  Diagnostics problems;
  SessionConfig config;
  const YAML::Node root = ParseYaml(text, file, problems);
  ReadConfig(root, file, "session", config, problems);
  for (const ConfigProblem& problem : Validate(config)) {
    problems.Fail(file, FindConfigLine(root, problem.key), problem.key + ": " + problem.text);
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the session cannot be run");
  return config;
}

void ApplySetting(const std::string& assignment, SessionConfig& config) {
  SetConfigValue(assignment, config);
}

Json ToJson(const SessionConfig& config) { return ConfigToJson(config); }

SessionConfig SessionConfigFromJson(const Json& json, const std::string& file) {
  Diagnostics problems;
  const auto config = ConfigFromJson<SessionConfig>(json, file, problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the frozen configuration cannot be read");
  return config;
}

}  // namespace graspbench
