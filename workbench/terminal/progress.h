#pragma once
/** @file
How far a batch is: on a terminal one block of lines redrawn in place, at most ten times a second;
elsewhere (pipe, file, TERM=dumb) a plain line from time to time, without any escape byte.

The rate is that of the last half minute, so that it follows what the machine does now. Where trials
cost differently, the time that is left follows from the work of the whole run. */

#include <cstdio>
#include <deque>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/trial/outcome.h"
#include "workbench/experiments/observer.h"
#include "workbench/terminal/status_region.h"

namespace graspbench {

/** Trials per second over a moving window. */
class Pace {
 public:
  /** @param time  since the start, not falling [s]. */
  void Add(double time, int num_done);
  double rate() const;  ///< [1/s]; NaN before anything is done
 private:
  std::deque<std::pair<double, int>> points_;
};

/** The session as a whole: what earlier runs finished counts as done. */
struct ProgressState {
  std::string counted = "trials";
  bool tells_success = true;  ///< else outcomes are left out
  int num_planned = 0;
  int num_done = 0;
  std::map<Outcome, int> outcomes;
  std::vector<std::string> workers;  ///< what each is doing; empty: idle
  std::set<std::string> preparing;   ///< objects whose mesh workers make ready for contacts
  double rate = 0.0;                 ///< [1/s]; NaN: not known yet
  /** Of the whole; NaN: as the rate says [s]. */
  double remaining = std::numeric_limits<double>::quiet_NaN();
};

/** Lines of the block, none longer than `width` characters. */
std::vector<std::string> FormatBlock(const ProgressState& state, int width);

/** The same in one line: "132 of 420 trials, ...". */
std::string FormatLine(const ProgressState& state);

/** "1 min 25 s", "2 h 5 min", "3 s". */
std::string FormatDuration(double duration);

class Progress {
 public:
  Progress(std::FILE* stream, const Stage& stage);

  /** There turned out to be more or fewer trials. */
  void SetPlanned(int num_planned) { stage_.num_trials = num_planned; }
  /** Shows the status when it is time to. @param time  since the start [s]. */
  void Show(const BatchStatus& status, double time);
  /** Shows the last status once more and leaves the cursor below it. */
  void Finish();
  /** Prints a message above the block. */
  void Say(const std::string& message);

 private:
  ProgressState MakeState() const;
  void Draw();

  std::FILE* stream_;
  StatusRegion region_;
  Stage stage_;
  BatchStatus status_;
  Pace pace_;
  double last_shown_;
  double time_ = 0.0;  ///< of status_, since the start [s]
};

}  // namespace graspbench
