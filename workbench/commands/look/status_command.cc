#include <filesystem>
#include <memory>
#include <string>

#include "core/base/error.h"
#include "workbench/commands/command.h"
#include "workbench/folder_status.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {
namespace {

struct StatusOptions {
  std::filesystem::path folder;
  double stale_after = 600.0;  // [s]; the longest trials of a benchmark take a second
  bool quick = false;
  bool json = false;
};

ExitCode ShowStatus(const StatusOptions& options) {
  const FolderStatus status =
      ReadFolderStatus(options.folder, options.stale_after,
                       options.quick ? StatusLook::kCounted : StatusLook::kChecked);
  if (options.json) {
    PrintJson(status.json);
  } else {
    PrintResult(status.text);
    if (!status.notes.empty()) PrintMessage(status.notes);
  }
  if (!status.damage.empty()) throw Error(ErrorKind::kFormat, status.damage);
  if (!status.is_checked) PrintMessage(DescribeUncheckedStatus(options.folder));
  return status.is_checked || options.quick ? kExitOk : kExitFailed;
}

}  // namespace

void AddStatusCommand(Command& program, ExitCode& exit_code) {
  Command& command = AddSubcommand(
      program, "status", "Show how far the shards of a session or campaign are, by its journals.",
      "  graspbench status results/pilot            every line is checked; damaged: exit code 3\n"
      "  graspbench status results/large --quick    above 1 GB, where checking takes minutes\n"
      "  graspbench status results/pilot --stale-after 3600 --json");
  const auto options = std::make_shared<StatusOptions>();
  AddStoreFolder(command, options->folder,
                 "folder of a session, campaign, optimisation or development");
  AddSecondsOption(command, "--stale-after", options->stale_after,
                   "seconds without a new line after which an unfinished shard is stale");
  command.AddFlag("--quick", options->quick, "count, do not check; else 1 GB and more end with 1");
  command.AddFlag("--json", options->json, "print one JSON object");
  command.SetAction([options, &exit_code] { exit_code = ShowStatus(*options); });
}

}  // namespace graspbench
