#include "workbench/session_options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>

#include "datasets/session/scene_names.h"
#include "workbench/commands/command.h"

namespace graspbench {

void SessionOptions::AddTo(CLI::App& command) {
  command
      .add_option("session", session_file_,
                  "session file: YAML, or session.json of a session; absent: the benchmark")
      ->option_text("SESSION");
  AddSceneOptions(command, given_);
  AddListOption(command, "--grasp", given_.grasps, "best, all, ids or grasp files: g1,my.yaml",
                "G,..");
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
  const auto options = {"session", "--hand", "--object", "--grasp", "--trials", "--seed", "--set"};
  return std::any_of(options.begin(), options.end(),
                     [this](const char* option) { return IsGiven(option); });
}

SessionConfig SessionOptions::MakeConfig() const {
  SessionConfig config;
  if (!session_file_.empty()) config = LoadSessionConfig(session_file_);
  for (const std::string& setting : settings_) ApplySetting(setting, config);
  ReplaceNames(config);  // those of options are ids already
  if (IsGiven("--hand")) config.hands = given_.hands;
  if (IsGiven("--object")) config.objects = given_.objects;
  if (IsGiven("--grasp")) config.grasps = given_.grasps;
  if (IsGiven("--trials")) config.trials = given_.trials;
  if (IsGiven("--seed")) config.seed = given_.seed;
  return config;
}

std::string SessionOptions::name() const {
  return session_file_.empty() ? "benchmark" : std::filesystem::path(session_file_).stem().string();
}

}  // namespace graspbench
