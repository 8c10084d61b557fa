#include "workbench/stage_commands.h"

#include <algorithm>
#include <utility>

#include "workbench/experiments/pipelines/replay_pack.h"
#include "workbench/terminal/command_line.h"
#include "workbench/terminal/terminal.h"
#include "workbench/terminal/terminal_observer.h"
#include "workbench/text/pipeline_text.h"

namespace graspbench {

ExitCode ReplayPackFile(const Command& program, const PackReplayOptions& options) {
  PackReplayRequest request;
  request.pack = options.pack;
  request.folder = options.folder;
  request.commands = ListStageCommands(program);
  request.num_workers = options.num_workers;
  request.tell = [](const std::string& line) { PrintMessage(line); };
  const PackReplay replay = ReplayPack(request, CatchInterrupts());
  if (options.json) {
    PrintJson(MakePackReplayJson(replay));
  } else {
    PrintResult(FormatPackReplay(replay));
  }
  return replay.num_different > 0 ? kExitBadInput : kExitOk;
}

namespace {

/** One row a command; all that make results from files and end by themselves. */
constexpr std::pair<const char*, StagePlace> kStageCommands[] = {
    {"run", StagePlace::kOwn},
    {"sweep", StagePlace::kOwn},
    {"optimise", StagePlace::kOwn},
    {"campaign", StagePlace::kOwn},
    {"basin", StagePlace::kOwn},
    {"map simultaneity", StagePlace::kOwn},
    {"argument", StagePlace::kOwn},
    {"entry", StagePlace::kOwn},
    {"board", StagePlace::kOwn},
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
constexpr const char* kOwnOptions[] = {"out",    "paper",         "mjcf",      "urdf",
                                       "jobs",   "resume",        "plan-only", "help",
                                       "replay", "accept-damage", "replace",   "trial-timeout"};

StageOption MakeStageOption(const Option& option, StagePlace place) {
  StageOption made;
  made.is_argument = option.is_argument();
  made.name = option.long_names().empty() ? option.name() : option.long_names().front();
  made.takes_value = option.takes_value();
  made.is_needed = option.is_required();
  made.is_own = std::find(std::begin(kOwnOptions), std::end(kOwnOptions), made.name) !=
                    std::end(kOwnOptions) ||
                (made.name == "json" && place != StagePlace::kText);
  return made;
}

}  // namespace

std::vector<StageCommand> ListStageCommands(const Command& program) {
  std::vector<StageCommand> commands;
  for (const auto& [name, place] : kStageCommands) {
    const std::string words = name;
    const size_t blank = words.find(' ');
    const Command* command = &program.Subcommand(words.substr(0, blank));
    if (blank != words.npos) command = &command->Subcommand(words.substr(blank + 1));
    StageCommand made = {words, place, {}};
    for (const auto& option : command->options()) {
      made.options.push_back(MakeStageOption(*option, place));
    }
    commands.push_back(std::move(made));
  }
  return commands;
}

}  // namespace graspbench
