#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "core/base/text/escape.h"
#include "core/base/text/text.h"
#include "workbench/commands/command.h"
#include "workbench/experiments/interrupt.h"
#include "workbench/folder_status.h"
#include "workbench/terminal/progress.h"
#include "workbench/terminal/status_region.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {
namespace {

struct WatchOptions {
  std::filesystem::path folder;
  double stale_after = 600.0;  // [s]
  double interval = 1.0;       // [s]
};

constexpr std::chrono::milliseconds kSignalInterval(50);  // Ctrl-C is heard between two

std::vector<std::string> ListLines(const FolderStatus& status, const Pace& pace) {
  std::vector<std::string> lines;
  std::istringstream text(EscapeForTerminal(status.text));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  if (pace.rate() > 0.0 && !status.is_finished) {
    lines.push_back("pace  " + FormatFixed(pace.rate(), 1) + " per second, " +
                    FormatDuration((status.num_all - status.num_done) / pace.rate()) + " left");
  }
  return lines;
}

/** On a terminal all lines, redrawn in place; elsewhere the first one whenever it has changed. */
ExitCode Watch(const WatchOptions& options) {
  using Clock = std::chrono::steady_clock;
  const std::atomic<bool>& stop = CatchInterrupts();
  StatusRegion region(stdout);
  Pace pace;
  std::string shown;
  for (const auto start = Clock::now();;) {
    const FolderStatus status = ReadFolderStatus(options.folder, options.stale_after);
    const std::chrono::duration<double> time = Clock::now() - start;
    pace.Add(time.count(), status.num_done);
    const std::vector<std::string> lines = ListLines(status, pace);
    region.Show(lines);
    if (!region.can_redraw() && lines.front() != shown) PrintResult(lines.front() + "\n");
    shown = lines.front();
    if (!status.damage.empty()) throw Error(ErrorKind::kFormat, status.damage);
    if (status.is_finished) return kExitOk;
    const auto next = Clock::now() + std::chrono::duration<double>(options.interval);
    while (Clock::now() < next) {
      if (stop) return kExitOk;  // the run itself goes on
      std::this_thread::sleep_for(kSignalInterval);
    }
  }
}

}  // namespace

void AddWatchCommand(CLI::App& program, ExitCode& exit_code) {
  CLI::App& command = AddSubcommand(
      program, "watch", "Follow a running session or campaign by its journals, until its end.",
      "  graspbench watch results/pilot\n"
      "  graspbench watch results/pilot --interval 10 | tee progress.txt");
  const auto options = std::make_shared<WatchOptions>();
  AddStoreFolder(command, options->folder, "folder of a session, campaign or optimisation");
  AddSecondsOption(command, "--interval", options->interval, "seconds between two looks");
  AddSecondsOption(command, "--stale-after", options->stale_after,
                   "seconds without a new line after which an unfinished shard is stale");
  command.callback([options, &exit_code] { exit_code = Watch(*options); });
}

}  // namespace graspbench
