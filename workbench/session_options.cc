#include "workbench/session_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "datasets/plan/scene_names.h"
#include "workbench/commands/command.h"

namespace graspbench {

void SessionOptions::AddTo(CLI::App& command, const std::string& file_text) {
  command.add_option("session", session_file_, file_text)->option_text("SESSION");
  AddSceneOptions(command, given_);
  AddListOption(command, "--grasp", given_.grasps, "best, all, ids or grasp files: g1,my.yaml",
                "G,..");
  command
      .add_option("--approach", given_.approach, "above or side, whatever objects and grasps say")
      ->option_text("FROM")
      ->capture_default_str();
  command.add_option("--trials", given_.trials, "trials of each hand, object, grasp")
      ->option_text("N")
      ->capture_default_str();
  command.add_option("--seed", given_.seed, "another seed gives other variations")
      ->option_text("N")
      ->capture_default_str();
  AddSettingsOption(command, settings_, "sim.step_s=0.001");
  command_ = &command;
}

bool SessionOptions::IsGiven(const char* option) const { return command_->count(option) > 0; }

bool SessionOptions::HasAny() const {
  const auto options = {"session",    "--hand",   "--object", "--grasp",
                        "--approach", "--trials", "--seed",   "--set"};
  return std::any_of(options.begin(), options.end(),
                     [this](const char* option) { return IsGiven(option); });
}

/** What an option and --set both say would silently be that of the option. */
void SessionOptions::RefuseTwice(const std::string& setting) const {
  const std::string key = setting.substr(0, setting.find('='));
  for (const auto& [of_setting, option] : {std::pair{"hands", "--hand"},
                                           {"objects", "--object"},
                                           {"grasps", "--grasp"},
                                           {"approach", "--approach"},
                                           {"trials", "--trials"},
                                           {"seed", "--seed"}}) {
    if (key != of_setting || !IsGiven(option)) continue;
    throw Error(ErrorKind::kUsage,
                "--set " + setting + " and " + option + " say the same setting; give one of them");
  }
}

SessionConfig SessionOptions::MakeConfig() const {
  SessionConfig config;
  if (!session_file_.empty()) config = LoadSessionConfig(session_file_);
  ApplyTo(config);
  return config;
}

void SessionOptions::ApplyTo(SessionConfig& config) const {
  for (const std::string& setting : settings_) {
    RefuseTwice(setting);
    ApplySetting(setting, config);
  }
  ReplaceNames(config);  // those of options are ids already
  if (IsGiven("--hand")) config.hands = given_.hands;
  if (IsGiven("--object")) config.objects = given_.objects;
  if (IsGiven("--grasp")) config.grasps = given_.grasps;
  if (IsGiven("--approach")) config.approach = given_.approach;
  if (IsGiven("--trials")) config.trials = given_.trials;
  if (IsGiven("--seed")) config.seed = given_.seed;
}

std::string SessionOptions::name() const {
  return session_file_.empty() ? "benchmark" : std::filesystem::path(session_file_).stem().string();
}

}  // namespace graspbench
