#include <chrono>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "core/base/error.h"
#include "core/base/text/text.h"
#include "workbench/command.h"
#include "workbench/folder_status.h"
#include "workbench/terminal/status_region.h"
#include "workbench/terminal/terminal.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

struct StatusOptions {
  std::filesystem::path folder;
  double stale_after = 600.0;  // [s]; the longest trials of a benchmark take a second
  double interval = 1.0;       // [s], of a watch
  bool verify = false;
  bool json = false;

  StatusLook look() const { return verify ? StatusLook::kVerified : StatusLook::kQuick; }
};

ExitCode EndOf(const FolderStatus& status, const StatusOptions& options) {
  if (!status.is_checked) PrintMessage(DescribeUncheckedStatus(options.folder));
  return kExitOk;
}

ExitCode ShowStatus(const StatusOptions& options) {
  const FolderStatus status = ReadFolderStatus(options.folder, options.stale_after, options.look());
  if (options.json) {
    PrintJson(status.json);
  } else {
    PrintResult(status.text);
    if (!status.notes.empty()) PrintMessage(status.notes);
  }
  if (!status.damage.empty()) throw Error(ErrorKind::kFormat, status.damage);
  return EndOf(status, options);
}

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
  explicit Looks(const StatusOptions& options) : options_(options) {}

  FolderStatus Look() {
    if (Clock::now() >= next_check_) return Check();
    FolderStatus status =
        ReadFolderStatus(options_.folder, options_.stale_after, StatusLook::kCounted);
    return status.is_finished ? Check() : status;
  }

 private:
  FolderStatus Check() {
    const auto start = Clock::now();
    FolderStatus status = ReadFolderStatus(options_.folder, options_.stale_after, options_.look());
    next_check_ = Clock::now() + 10 * (Clock::now() - start);
    return status;
  }

  const StatusOptions& options_;
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
ExitCode Watch(const StatusOptions& options) {
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
    if (status.is_finished) return EndOf(status, options);
    const auto next = Clock::now() + std::chrono::duration<double>(options.interval);
    while (Clock::now() < next) {
      if (stop) return kExitOk;  // the run itself goes on
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }
}

/** Of `status`, and of `watch`, which looks again. */
void AddLookOptions(Command& command, StatusOptions& options, bool is_watch) {
  AddStoreFolder(command, options.folder,
                 "folder of a session, campaign, optimisation or development");
  if (is_watch) {
    AddSecondsOption(command, "--interval", options.interval, "seconds between updates");
  }
  AddSecondsOption(command, "--stale-after", options.stale_after,
                   "seconds without a new result after which an unfinished shard counts as stale");
  command.AddFlag("--verify", options.verify,
                  "check every byte even above 30 MB, where lines are otherwise only counted");
}

}  // namespace

void AddStatusCommand(Command& program) {
  const auto options = std::make_shared<StatusOptions>();
  Command& status = AddSubcommand(
      program, "status", "Show the progress of a session or campaign.",
      "  graspbench status results/pilot             up to 30 MB checked; damaged: exit code 3\n"
      "  graspbench status results/large --verify    all of it checked, however large\n"
      "  graspbench status results/pilot --stale-after 3600 --json");
  AddLookOptions(status, *options, false);
  AddJsonOption(status, options->json);
  status.SetAction([options] { return ShowStatus(*options); });

  Command& watch =
      AddSubcommand(program, "watch", "Follow the progress of a session or campaign until its end.",
                    "  graspbench watch results/pilot\n"
                    "  graspbench watch results/pilot --interval 10 | tee progress.txt");
  AddLookOptions(watch, *options, true);
  watch.SetAction([options] { return Watch(*options); });
}

}  // namespace graspbench
