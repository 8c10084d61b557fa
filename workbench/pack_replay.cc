#include "workbench/pack_replay.h"

#include "workbench/experiments/interrupt.h"
#include "workbench/experiments/pipelines/replay_pack.h"
#include "workbench/stage_commands.h"
#include "workbench/terminal/terminal.h"
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

}  // namespace graspbench
