#include "workbench/stage_commands.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

namespace graspbench {
namespace {

/** One row a command; all that make results from files and end by themselves. */
constexpr std::pair<const char*, StagePlace> kStageCommands[] = {
    {"run", StagePlace::kOwn},
    {"sweep", StagePlace::kOwn},
    {"optimise", StagePlace::kOwn},
    {"campaign", StagePlace::kOwn},
    {"basin", StagePlace::kOwn},
    {"study run", StagePlace::kOwn},
    {"study demo", StagePlace::kOwn},
    {"judge", StagePlace::kCopy},
    {"sensitivity", StagePlace::kCopy},
    {"simultaneity", StagePlace::kCopy},
    {"check-numerics", StagePlace::kCopy},
    {"export", StagePlace::kCopy},
    {"report", StagePlace::kCopy},
    {"best", StagePlace::kText},
    {"compare", StagePlace::kText},
    {"quality", StagePlace::kText}};

/** Where results go, how many processors work and whether to go on is the pipeline's; what a clock
decides is nobody's, because it would differ elsewhere. */
constexpr const char* kOwnOptions[] = {"out",           "paper",     "mjcf",         "jobs",
                                       "resume",        "plan-only", "help",         "replay",
                                       "accept-damage", "replace",   "trial-timeout"};

StageOption MakeStageOption(const CLI::Option& option, StagePlace place) {
  StageOption made;
  made.is_argument = option.get_positional();
  made.name = option.get_lnames().empty() ? option.get_name() : option.get_lnames().front();
  made.takes_value = option.get_expected_max() > 0;
  made.is_needed = option.get_required();
  made.is_own = std::find(std::begin(kOwnOptions), std::end(kOwnOptions), made.name) !=
                    std::end(kOwnOptions) ||
                (made.name == "json" && place != StagePlace::kText);
  return made;
}

}  // namespace

std::vector<StageCommand> ListStageCommands(const CLI::App& program) {
  std::vector<StageCommand> commands;
  for (const auto& [name, place] : kStageCommands) {
    const std::string words = name;
    const size_t blank = words.find(' ');
    const CLI::App* command = program.get_subcommand(words.substr(0, blank));
    if (blank != words.npos) command = command->get_subcommand(words.substr(blank + 1));
    StageCommand made = {words, place, {}};
    for (const CLI::Option* option : command->get_options()) {
      made.options.push_back(MakeStageOption(*option, place));
    }
    commands.push_back(std::move(made));
  }
  return commands;
}

}  // namespace graspbench
