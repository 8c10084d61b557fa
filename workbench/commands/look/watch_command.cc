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
  bool quick = false;
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

/** Looks that check everything and take no more than a tenth of the time, and others between. What
is finished was checked. */
class Looks {
 public:
  using Clock = std::chrono::steady_clock;
  explicit Looks(const WatchOptions& options) : options_(options) {}

  FolderStatus Look() {
    if (!options_.quick && Clock::now() >= next_check_) return Check();
    FolderStatus status =
        ReadFolderStatus(options_.folder, options_.stale_after, StatusLook::kCounted);
    return status.is_finished && !options_.quick ? Check() : status;
  }

 private:
  FolderStatus Check() {
    const auto start = Clock::now();
    FolderStatus status = ReadFolderStatus(options_.folder, options_.stale_after);
    next_check_ = Clock::now() + 10 * (Clock::now() - start);
    return status;
  }

  const WatchOptions& options_;
  Clock::time_point next_check_ = Clock::time_point::min();
};

void PrintChanges(const std::vector<std::string>& steps, std::vector<std::string>& shown) {
  shown.resize(steps.size());
  for (size_t i = 0; i < steps.size(); ++i) {
    if (steps[i] != shown[i]) PrintResult(EscapeForTerminal(steps[i]) + "\n");
    shown[i] = steps[i];
  }
}

/** On a terminal all lines, redrawn in place; elsewhere each step that has changed. */
ExitCode Watch(const WatchOptions& options) {
  using Clock = Looks::Clock;
  const std::atomic<bool>& stop = CatchInterrupts();
  StatusRegion region(stdout);
  Looks looks(options);
  Pace pace;
  std::vector<std::string> shown;
  for (const auto start = Clock::now();;) {
    const FolderStatus status = looks.Look();
    const std::chrono::duration<double> time = Clock::now() - start;
    pace.Add(time.count(), status.num_done);
    region.Show(ListLines(status, pace));
    if (!region.can_redraw()) PrintChanges(status.steps, shown);
    if (!status.damage.empty()) throw Error(ErrorKind::kFormat, status.damage);
    if (status.is_finished) {
      if (!status.is_checked) PrintMessage(DescribeUncheckedStatus(options.folder));
      return status.is_checked || options.quick ? kExitOk : kExitFailed;
    }
    const auto next = Clock::now() + std::chrono::duration<double>(options.interval);
    while (Clock::now() < next) {
      if (stop) return kExitOk;  // the run itself goes on
      std::this_thread::sleep_for(kSignalInterval);
    }
  }
}

}  // namespace

void AddWatchCommand(Command& program, ExitCode& exit_code) {
  Command& command = AddSubcommand(
      program, "watch", "Follow a running session or campaign by its journals, until its end.",
      "  graspbench watch results/pilot\n"
      "  graspbench watch results/pilot --interval 10 | tee progress.txt");
  const auto options = std::make_shared<WatchOptions>();
  AddStoreFolder(command, options->folder,
                 "folder of a session, campaign, optimisation or development");
  AddSecondsOption(command, "--interval", options->interval, "seconds between two looks");
  AddSecondsOption(command, "--stale-after", options->stale_after,
                   "seconds without a new line after which an unfinished shard is stale");
  command.AddFlag("--quick", options->quick, "count, do not check; else 1 GB and more end with 1");
  command.SetAction([options, &exit_code] { exit_code = Watch(*options); });
}

}  // namespace graspbench
