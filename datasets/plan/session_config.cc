#include "datasets/plan/session_config.h"

#include <algorithm>

#include "core/arm/mounted_arm.h"
#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/text/text.h"
#include "core/shape/grasp_object.h"
#include "core/trial/trial_setup.h"
#include "datasets/plan/grasp_choice.h"
#include "datasets/plan/grip_check.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

std::string FindFirstComment(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.rfind("# ", 0) == 0 ? line.substr(2) : "";
}

/** Coefficients that are left out stay so. */
void Scale(const ModelConfig& model, SurfaceMaterial& surface) {
  surface.friction_static *= model.friction_scale;
  surface.friction_dynamic *= model.friction_scale;
  surface.torsion_radius *= model.pad_torsion_scale;
  surface.pad.torsion_scale *= model.pad_torsion_scale;
  surface.pad.youngs_modulus *= model.pad_stiffness_scale;
}

bool Turns(const HandJoint& joint) { return !joint.is_prismatic; }
bool TurnsByDrive(const HandJoint& joint) { return Turns(joint) && joint.coupled_to < 0; }
bool TurnsByCoupling(const HandJoint& joint) { return Turns(joint) && joint.coupled_to >= 0; }

void CheckConcerned(const Hand& hand, const char* key, bool (*is_concerned)(const HandJoint&),
                    const char* expected) {
  if (std::any_of(hand.joints.begin(), hand.joints.end(), is_concerned)) return;
  throw Error(ErrorKind::kUsage,
              std::string("imperfections.") + key + " has no effect on the hand \"" + hand.id +
                  "\": it has no joint that " + expected + "; leave out the setting or the hand");
}

/** Over the noise: none of the 300,000 samples of a trial of the Shadow Hand is above by chance. */
constexpr double kLeastThreshold = 5.0;

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

/** Of a group that the session does not use each key that has another value than by default: whoever
wrote it expects something of it. */
template <class Group>
void CheckUnused(const std::string& name, const Group& group, const std::string& meanwhile,
                 std::vector<ConfigProblem>& problems) {
  const Json values = ConfigToJson(group), defaults = ConfigToJson(Group());
  for (const auto& [key, value] : values.items()) {
    if (value == defaults.at(key)) continue;
    problems.push_back({name + "." + key, "changes nothing while " + meanwhile});
  }
}

void CheckSensors(const SessionConfig& config, std::vector<ConfigProblem>& problems) {
  if (FindRow(kPositionings, config.positioning) && !NeedsCamera(config) &&
      !ShowsCamera(config.policy)) {
    CheckUnused(
        "camera", config.camera,
        "positioning is " + config.positioning + "; set positioning: camera or leave it out",
        problems);
  }
  if (config.touch == SessionConfig().touch) {
    CheckUnused("sensors", config.sensors,
                "touch is " + config.touch + "; set touch: sensed or leave it out", problems);
  } else if (config.touch == RowOf(kTouchSenses, TouchSense::kSensed).name &&
             config.sensors.threshold < kLeastThreshold * config.sensors.noise) {
    problems.push_back({"sensors.threshold",
                        "the elements would respond to their own noise; expected at least five "
                        "times sensors.noise"});
  }
}

void CheckArm(const ArmConfig& arm, std::vector<ConfigProblem>& problems) {
  if (!HasArm(arm)) {
    CheckUnused("arm", arm, "arm.model is none; set arm.model or leave it out", problems);
    return;
  }
  if (arm.z < 0.0) {
    problems.push_back({"arm.base_z_m", FormatJson(arm.z) +
                                            ": the base would be inside the table, whose top is at "
                                            "0; expected 0 or more"});
  }
  const std::vector<std::string> mounts = ListMounts();
  if (std::find(mounts.begin(), mounts.end(), arm.mount) == mounts.end()) {
    problems.push_back(
        {"arm.mount", "no mount \"" + arm.mount + "\"" + SuggestNames(arm.mount, mounts)});
  }
}

/** @param what  the name is of: "approach". @returns whether it is one of the table. */
template <class Row, size_t N>
bool CheckRow(const Row (&table)[N], const std::string& key, const std::string& what,
              const std::string& name, std::vector<ConfigProblem>& problems) {
  if (FindRow(table, name)) return true;
  problems.push_back(
      {key, "no " + what + " \"" + name + "\"" + SuggestNames(name, ListNames(table))});
  return false;
}

void CheckGrip(const StrategyConfig& strategy, std::vector<ConfigProblem>& problems) {
  const bool is_known = CheckRow(kGripModes, "strategy.grip", "grip", strategy.grip, problems);
  if (is_known && strategy.grip == RowOf(kGripModes, GripMode::kForce).name &&
      strategy.grip_force <= 0.0) {
    problems.push_back({"strategy.grip_force_n", "must be above 0 where strategy.grip is force"});
  }
  if (CheckRow(kDriveLaws, "strategy.drive_law", "drive law", strategy.drive_law, problems) &&
      strategy.drive_law != StrategyConfig().drive_law &&
      strategy.grip == RowOf(kGripModes, GripMode::kPosture).name) {
    problems.push_back({"strategy.drive_law",
                        "drives are limited to a regulated force, and strategy.grip is posture; "
                        "set it to force or margin"});
  }
  if (strategy.closure_lead > strategy.placing_time) {
    problems.push_back(
        {"strategy.closure_lead_s", "must not be longer than strategy.placing_time_s"});
  }
}

void CheckPolicy(const SessionConfig& config, std::vector<ConfigProblem>& problems) {
  const PolicyConfig& policy = config.policy;
  if (policy.command.empty()) {
    CheckUnused("policy", policy, "policy.command is empty; set it or leave the key out", problems);
  } else if (!IsUtf8(policy.command)) {
    problems.push_back({"policy.command", "is not UTF-8"});
  }
  CheckRow(kPolicyMoves, "policy.moves", "moves", policy.moves, problems);
  CheckRow(kPolicyObjectPoses, "policy.object_pose", "object pose", policy.object_pose, problems);
  for (const auto& [key, value, usual] :
       {std::tuple("policy.hand_speed_m_per_s", policy.hand_speed, PolicyConfig().hand_speed),
        std::tuple("policy.hand_turn_rate_rad_per_s", policy.hand_turn_rate,
                   PolicyConfig().hand_turn_rate)}) {
    if (value == usual || policy.moves == RowOf(kPolicyMoves, PolicyMoves::kHandAndDigits).name) {
      continue;
    }
    problems.push_back({key, "has no effect while policy.moves is " + policy.moves +
                                 "; set hand-and-digits or leave the key out"});
  }
}

/** What a session has written: a complete configuration, alone or in its session.json. */
SessionConfig ParseFrozenConfig(const std::string& text, const std::string& file) {
  const Json json = Json::try_parse(text);
  if (json.is_discarded()) {
    throw Error(ErrorKind::kFormat, file + ": not valid JSON; it may be cut off");
  }
  const bool is_session = json.is_object() && json.contains("config");
  SessionConfig config = SessionConfigFromJson(is_session ? json.at("config") : json, file);
  CheckSessionConfig(config);
  return config;
}

/** @throws Error(kFormat) listing `problems` and those of the values, at their lines. */
void CheckRead(const YAML::Node& root, const std::string& file, const SessionConfig& config,
               Diagnostics& problems) {
  for (const ConfigProblem& problem : Validate(config)) {
    problems.Fail(file, FindConfigLine(root, problem.key), problem.key + ": " + problem.text);
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the session cannot be run");
}

/** The defaults of a session file: those of the preset that it names. What else `preset` may hold is
a fault that reading finds. */
SessionConfig FindDefaults(const YAML::Node& root, const std::string& file, Diagnostics& problems) {
  if (!root.IsMap() || !root["preset"] || !root["preset"].IsScalar()) return {};
  try {
    return LoadPreset(root["preset"].Scalar());
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kNotFound) throw;
    problems.Fail(file, FindConfigLine(root, "preset"), std::string("preset: ") + error.what());
    return {};
  }
}

/** The command line refuses such a setting, too; a file may repeat the default, as presets do. */
void CheckGripUsed(const YAML::Node& root, const std::string& file, const SessionConfig& config,
                   const StrategyConfig& defaults, Diagnostics& problems) {
  if (!FindRow(kGripModes, config.strategy.grip)) return;
  const Json values = ConfigToJson(config.strategy), usual = ConfigToJson(defaults);
  for (const auto& [name, value] : values.items()) {
    const std::string key = "strategy." + name;
    if (value == usual.at(name) || CanMatter(key, config.strategy)) continue;
    problems.Fail(file, FindConfigLine(root, key),
                  key + ": " + DescribeUnusedGrip(config.strategy));
  }
}

/** Null: it is not there. */
Json TakeKey(const char* key, Json& json) {
  if (!json.is_object() || !json.contains(key)) return Json();
  Json value = json.at(key);
  json.erase(key);
  return value;
}

}  // namespace

std::vector<Preset> ListPresets() {
  std::vector<Preset> presets;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(FindDataRoot() / "datasets" / "presets", none)) {
    const fs::path& file = entry.path();
    if (file.extension() != ".yaml") continue;
    presets.push_back({file.stem().string(), file, FindFirstComment(ReadFile(file))});
  }
  std::sort(presets.begin(), presets.end(),
            [](const Preset& a, const Preset& b) { return a.name < b.name; });
  return presets;
}

Preset FindPreset(const std::string& name) {
  std::vector<std::string> names;
  for (const Preset& preset : ListPresets()) {
    if (preset.name == name) return preset;
    names.push_back(preset.name);
  }
  throw Error(ErrorKind::kNotFound, "no preset \"" + name + "\"" + SuggestNames(name, names));
}

std::vector<std::string> ListModelCouplings() {
  std::vector<std::string> names = {ModelConfig::kOwnRule};
  for (const CouplingRule rule : ListCouplingRules()) names.push_back(NameOf(rule));
  return names;
}

void ApplyModel(const ModelConfig& model, Hand& hand) {
  for (HandLink& link : hand.links) Scale(model, link.surface);
  for (HandJoint& joint : hand.joints) joint.drive.torque_limit *= model.drive_torque_scale;
  hand.joint_accuracy *= model.joint_error_scale;
  hand.slide_accuracy *= model.joint_error_scale;
  for (const CouplingRule rule : ListCouplingRules()) {
    if (NameOf(rule) == model.coupling_rule) hand.coupling = rule;
  }
}

void ApplyModel(const ModelConfig& model, GraspObject& object) {
  Scale(model, object.surface);
  object.mass_properties.mass *= model.mass_scale;
  object.mass_properties.I_OOcm *= model.mass_scale;
}

bool operator==(const ImperfectionConfig& a, const ImperfectionConfig& b) {
  return HaveEqualValues(a, b);
}

void ApplyImperfections(const ImperfectionConfig& config, Hand& hand) {
  const char* const turns = "turns by a drive of its own";
  if (config.hysteresis > 0.0) CheckConcerned(hand, "hysteresis_rad", TurnsByDrive, turns);
  if (config.stick_slip > 0.0) CheckConcerned(hand, "stick_slip", TurnsByDrive, turns);
  if (config.coupling_compliance > 0.0) {
    CheckConcerned(hand, "coupling_compliance_rad_per_nm", TurnsByCoupling,
                   "turns with another (coupling in hand.yaml)");
  }
  for (HandJoint& joint : hand.joints) {
    joint.drive.stiffness *= config.stiffness_scale;
    if (TurnsByDrive(joint)) {
      joint.drive.hysteresis_width = config.hysteresis;
      joint.drive.friction_static = config.stick_slip * joint.drive.torque_limit;
      joint.drive.friction_dynamic = kSlidingFrictionShare * joint.drive.friction_static;
    } else if (TurnsByCoupling(joint)) {
      joint.coupling_compliance = config.coupling_compliance;
    }
  }
}

const FileKeys& ListSessionKeys() {
  static const FileKeys keys = DescribeConfig(SessionFile());
  return keys;
}

std::vector<std::pair<std::string, std::string>> FindSimProblems(const SimConfig& sim) {
  std::vector<std::pair<std::string, std::string>> problems;
  if (sim.table_friction_dynamic > sim.table_friction_static) {
    problems.emplace_back("sim.table_friction_dynamic",
                          "must not be higher than sim.table_friction_static");
  }
  if (sim.hand_friction_dynamic > sim.hand_friction_static) {
    problems.emplace_back("sim.hand_friction_dynamic",
                          "must not be higher than sim.hand_friction_static");
  }
  return problems;
}

std::vector<ConfigProblem> Validate(const SessionConfig& config) {
  std::vector<ConfigProblem> problems;
  CheckNames("hands", config.hands, {"all"}, problems);
  CheckNames("objects", config.objects, {"all"}, problems);
  CheckNames("grasps", config.grasps, {"all"}, problems);
  for (const auto& [key, text] : FindOutOfRange(config, ListSessionKeys())) {
    problems.push_back({key, text});
  }
  if (config.strategy.stabilisation_min_time > config.strategy.stabilisation_max_time) {
    problems.push_back({"strategy.stabilisation_min_time_s",
                        "must not be longer than strategy.stabilisation_max_time_s"});
  }
  CheckGrip(config.strategy, problems);
  for (const auto& [key, text] : FindSimProblems(config.sim)) problems.push_back({key, text});
  CheckRow(kApproaches, "approach", "approach", config.approach, problems);
  CheckRow(kPositionings, "positioning", "positioning", config.positioning, problems);
  CheckRow(kTouchSenses, "touch", "touch", config.touch, problems);
  if (!ParseColour(config.camera.table_colour)) {
    problems.push_back({"camera.table_colour", "\"" + config.camera.table_colour +
                                                   "\" is no colour; expected one as \"#b4509b\""});
  }
  CheckSensors(config, problems);
  CheckArm(config.arm, problems);
  CheckPolicy(config, problems);
  if (config.draws != "random" && config.draws != "halton") {
    problems.push_back({"draws", "no draws \"" + config.draws + "\"; expected random or halton"});
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
  if (std::filesystem::path(file).extension() == ".json") return ParseFrozenConfig(text, file);
  Diagnostics problems;
  SessionFile session;
  const YAML::Node root = ParseYaml(text, file, problems);
  static_cast<SessionConfig&>(session) = FindDefaults(root, file, problems);
  const StrategyConfig defaults = session.strategy;
  ReadConfig(root, file, "session", session, problems);
  CheckGripUsed(root, file, session, defaults, problems);
  CheckRead(root, file, session, problems);
  return session;
}

SessionConfig LoadPreset(const std::string& name) {
  const std::string file = FindPreset(name).file.string();
  Diagnostics problems;
  SessionConfig config;  // a preset does not name another
  const YAML::Node root = ParseYaml(ReadFile(file), file, problems);
  ReadConfig(root, file, "preset", config, problems);
  CheckRead(root, file, config, problems);
  return config;
}

void ApplySetting(const std::string& assignment, SessionConfig& config) {
  SetConfigValue(assignment, config);
}

Json ToJson(const SessionConfig& config) {
  Json json = ConfigToJson(config);
  const SessionConfig defaults;
  json["strategy"] = StrategyToJson(config.strategy);
  if (config.approach == defaults.approach) json.erase("approach");
  if (!NeedsCamera(config) && !ShowsCamera(config.policy)) json.erase("camera");
  if (config.positioning == defaults.positioning) json.erase("positioning");
  if (!HasArm(config.arm)) json.erase("arm");
  if (config.touch == defaults.touch) {
    json.erase("touch");
    json.erase("sensors");
  }
  if (config.imperfections == defaults.imperfections) json.erase("imperfections");
  if (config.policy.command.empty()) json.erase("policy");
  if (config.draws != defaults.draws) json["draws"] = config.draws;
  for (const Condition& condition : config.conditions) {
    json["conditions"].push_back({{"name", condition.name}, {"settings", condition.settings}});
  }
  return json;
}

SessionConfig SessionConfigFromJson(const Json& json, const std::string& file) {
  Diagnostics problems;
  Json complete = json;
  const Json defaults = ConfigToJson(SessionConfig());
  for (const char* key : {"approach", "positioning", "arm", "camera", "touch", "sensors",
                          "imperfections", "policy"}) {
    if (json.is_object() && !json.contains(key)) complete[key] = defaults.at(key);
  }
  AddFirmGrip(complete);
  const Json draws = TakeKey("draws", complete), conditions = TakeKey("conditions", complete);
  auto config = ConfigFromJson<SessionConfig>(complete, file, problems);
  try {
    if (!draws.is_null()) config.draws = draws.get<std::string>();
    for (const Json& condition : conditions) {
      config.conditions.push_back({condition.at("name").get<std::string>(),
                                   condition.at("settings").get<std::vector<std::string>>()});
    }
  } catch (const Json::exception& e) {
    problems.Fail(file, 0, std::string("draws, conditions: ") + e.what());
  }
  problems.ThrowIfErrors(ErrorKind::kFormat, "the frozen configuration cannot be read");
  return config;
}

}  // namespace graspbench
