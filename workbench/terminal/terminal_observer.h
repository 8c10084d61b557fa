#pragma once
/** @file
Shows the progress of an experiment: a line before each stage, then its progress. On a terminal this
is one block of lines, redrawn in place at most ten times a second. Elsewhere (pipe, file,
TERM=dumb) it is a plain line from time to time, without any escape byte. Also handles the signals
that stop an experiment.

The rate is averaged over the last 30 s, so that it follows the current load of the machine. Where
trials differ in cost, the remaining time is computed from the work of the whole run. */

#include <atomic>
#include <chrono>
#include <cstdio>
#include <deque>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/trial/outcome.h"
#include "workbench/experiments/observer.h"
#include "workbench/terminal/status_region.h"

struct sigaction;

namespace graspbench {

/** Trials per second over a moving window. */
class Pace {
 public:
  /** @param time  since the start, non-decreasing [s]. */
  void Add(double time, int num_done);
  double rate() const;  ///< [1/s]; NaN before anything is done
 private:
  std::deque<std::pair<double, int>> points_;
};

/** Progress of the whole session: trials of earlier runs count as done. */
struct ProgressState {
  std::string counted = "trials";
  bool tells_success = true;  ///< else outcomes are left out
  int num_planned = 0;
  int num_done = 0;
  std::map<Outcome, int> outcomes;
  std::vector<std::string> workers;  ///< current task of each; empty: idle
  std::set<std::string> preparing;   ///< objects whose meshes workers are preparing for contact
  double rate = 0.0;                 ///< [1/s]; NaN: not known yet
  /** Remaining time of the whole session [s]; NaN: computed from `rate`; infinite: unknown. */
  double remaining = std::numeric_limits<double>::quiet_NaN();
};

/** Lines of the block, none longer than `width` characters. */
std::vector<std::string> FormatBlock(const ProgressState& state, int width);

/** The progress in one line: "132 of 420 trials, ...". */
std::string FormatLine(const ProgressState& state);

/** "1 min 25 s", "2 h 5 min", "3 s". */
std::string FormatDuration(double duration);

/** Installs the action unless the signal is ignored: `nohup` and shells without job control start
programs with signals ignored that must not end them. */
void CatchUnlessIgnored(int signal, const struct sigaction& action);

/** Installs the signal handlers. The first SIGINT (Ctrl-C), SIGTERM or SIGHUP sets the flag. A
second one ends the program at once with the exit code of an interrupted run. So does a timeout of 8
s, so that an endless trial cannot block the program. Results kept before are safe either way. A
signal that was ignored stays ignored. */
const std::atomic<bool>& CatchInterrupts();

/** "3 scenes to optimise". */
std::string DescribeTasks(const Stage& stage);

/** On the first stop request, it says once that the current trials are finished first. */
class TerminalObserver : public Observer {
 public:
  /** Catches interrupts. @param describe  returns the line before a stage; null: no line. */
  explicit TerminalObserver(std::function<std::string(const Stage&)> describe = nullptr)
      : TerminalObserver(std::move(describe), CatchInterrupts(), stderr) {}
  TerminalObserver(std::function<std::string(const Stage&)> describe, const std::atomic<bool>& stop,
                   std::FILE* stream);

  void BeginStage(const Stage& stage) override;
  void ShowStatus(const BatchStatus& status, int num_trials) override;
  /** As ShowStatus, at a given time since the stage's start [s]. */
  void ShowAt(double time, const BatchStatus& status, int num_trials);
  /** Shows the last status once more and leaves the cursor below it. */
  void EndStage() override;

 private:
  ProgressState MakeState() const;
  void Draw();

  std::function<std::string(const Stage&)> describe_;
  std::FILE* stream_;
  StatusRegion region_;
  std::chrono::steady_clock::time_point start_;  // of the current stage, as all below
  Stage stage_;
  BatchStatus status_;
  Pace pace_;
  double last_shown_ = 0.0;
  double time_ = 0.0;  // of status_, since the start [s]
  bool has_told_ = false;
};

}  // namespace graspbench
