#include "workbench/commands/options/session_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "datasets/benchmark/benchmark_file.h"
#include "datasets/plan/grip_check.h"
#include "datasets/plan/rehearsed_grasps.h"
#include "datasets/plan/scene_names.h"
#include "datasets/plan/session_config.h"
#include "workbench/command.h"

namespace graspbench {
namespace {

/** An option for one setting. */
struct SettingOption {
  const char* option;
  const char* setting;
  void (*copy)(const SessionConfig& given, SessionConfig& config);
};
constexpr SettingOption kOptions[] = {
    {"--hand", "hands",
     [](const SessionConfig& given, SessionConfig& c) { c.hands = given.hands; }},
    {"--object", "objects",
     [](const SessionConfig& given, SessionConfig& c) {
       c.objects = ExpandObjects(given.objects);
     }},
    {"--grasp", "grasps",
     [](const SessionConfig& given, SessionConfig& c) { c.grasps = JoinRehearsed(given.grasps); }},
    {"--approach", "approach",
     [](const SessionConfig& given, SessionConfig& c) { c.approach = given.approach; }},
    {"--arm", "arm.model",
     [](const SessionConfig& given, SessionConfig& c) { c.arm.model = given.arm.model; }},
    {"--policy", "policy.command",
     [](const SessionConfig& given, SessionConfig& c) { c.policy.command = given.policy.command; }},
    {"--trials", "trials",
     [](const SessionConfig& given, SessionConfig& c) { c.trials = given.trials; }},
    {"--seed", "seed", [](const SessionConfig& given, SessionConfig& c) { c.seed = given.seed; }}};

}  // namespace

void SessionOptions::AddTo(Command& command, const std::string& file_text) {
  command.AddOption("session", session_file_, file_text, "SESSION");
  std::vector<std::string> presets;
  for (const Preset& preset : ListPresets()) presets.push_back(preset.name);
  const std::string names = fmt::format("{}", fmt::join(presets, ","));
  command
      .AddOption("--preset", preset_, "named settings instead of a session file: " + names, "NAME")
      ->Suggest(presets);
  AddSceneOptions(command, given_);
  AddListOption(
      command, "--grasp", given_.grasps,
      "best, predicted, by-sight, rehearsed, all, ids or grasp files (g1,my.yaml); best: type by "
      "rehearsal of the standard grasps; predicted: type by geometry alone; by-sight: type by the "
      "outline in the hand's camera, right for 38 of 51 unseen objects; rehearsed:N,k: the first "
      "of at most N candidates that holds in k imagined trials (default 40,4)",
      "G,..");
  command
      .AddOption("--approach", given_.approach,
                 "approach direction above or side; overrides objects and grasps", "FROM")
      ->ShowDefault();
  AddArmOptions(command, given_.arm, arm_base_);
  command.AddOption("--policy", given_.policy.command,
                    "controller that closes the digits: a shell command ('python3 my.py'), the "
                    "address of a policy server (ws://127.0.0.1:8000) or a policy.yaml",
                    "POLICY");
  command.AddOption("--trials", given_.trials, "trials per hand, object and grasp", "N")
      ->ShowDefault();
  AddSeedOption(command, given_.seed, "other variations");
  AddSettingsOption(command, settings_, "sim.step_s=0.001");
  command_ = &command;
}

void SessionOptions::AddBenchmarkTo(Command& command) {
  command
      .AddOption("--benchmark", benchmark_,
                 "named benchmark or its file; settings that it fixes are refused", "NAME|FILE")
      ->Suggest(ListBenchmarks());
}

SessionConfig SessionOptions::FindBase() const {
  if (benchmark_.empty()) return {};
  const Benchmark benchmark = LoadBenchmark(benchmark_);
  LoadPinned(benchmark);
  return benchmark.session;
}

bool SessionOptions::IsGiven(const char* option) const { return command_->IsGiven(option); }

bool SessionOptions::HasAny() const {
  return !benchmark_.empty() || IsGiven("session") || IsGiven("--preset") || IsGiven("--set") ||
         IsGiven("--arm-base") ||
         std::any_of(std::begin(kOptions), std::end(kOptions),
                     [this](const SettingOption& row) { return IsGiven(row.option); });
}

/** What an option and --set both say would silently be that of the option. */
void SessionOptions::RefuseTwice(const std::string& setting) const {
  const std::string key = setting.substr(0, setting.find('='));
  std::string option = key.rfind("arm.base_", 0) == 0 ? "--arm-base" : "";
  for (const SettingOption& row : kOptions) {
    if (key == row.setting) option = row.option;
  }
  if (option.empty() || !IsGiven(option.c_str())) return;
  throw Error(ErrorKind::kUsage,
              "--set " + setting + " and " + option + " set the same value; give one of them");
}

SessionConfig SessionOptions::MakeConfig(SessionConfig config) const {
  if (!session_file_.empty()) config = LoadSessionConfig(session_file_);
  ApplyTo(config);
  if (IsGiven("--arm-base") && !HasArm(config.arm)) {
    throw Error(ErrorKind::kUsage, "--arm-base: the session has no arm; add --arm ARM");
  }
  return config;
}

void SessionOptions::ApplyTo(SessionConfig& config) const {
  if (!session_file_.empty() && !preset_.empty()) {
    throw Error(ErrorKind::kUsage,
                "a session file and --preset are both given; leave out --preset and write into " +
                    session_file_ + ": preset: " + preset_);
  }
  if (!preset_.empty()) config = LoadPreset(preset_);
  for (const std::string& setting : settings_) {
    RefuseTwice(setting);
    ApplySetting(setting, config);
  }
  for (const std::string& setting : settings_) RefuseUnusedGrip(setting, config.strategy);
  ReplaceNames(config);  // those of options are ids already
  for (const SettingOption& row : kOptions) {
    if (IsGiven(row.option)) row.copy(given_, config);
  }
  if (IsGiven("--arm-base")) ReadArmBase(arm_base_, config.arm);
  if (!benchmark_.empty()) CheckSettings(LoadBenchmark(benchmark_), config);
}

std::string SessionOptions::name() const {
  if (!preset_.empty()) return preset_;
  if (!benchmark_.empty()) return NameBenchmarkFile(LoadBenchmark(benchmark_).name);
  return session_file_.empty() ? "benchmark" : std::filesystem::path(session_file_).stem().string();
}

}  // namespace graspbench
