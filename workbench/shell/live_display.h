#pragma once
/** @file
What a person sees at a terminal while a trial goes on: a line, or the card that `live` chose, in
real time and five times a second. Elsewhere nothing, and nothing waits. */

#include <chrono>
#include <string>
#include <vector>

#include "workbench/shell/shell.h"

namespace graspbench {

/** "off", "contacts", "joints", "timing", "stability", "view". */
std::vector<std::string> ListLiveCards();

class LiveDisplay {
 public:
  explicit LiveDisplay(Shell& shell);
  /** What `live` chose stays as it was in the end. */
  ~LiveDisplay();
  LiveDisplay(const LiveDisplay&) = delete;
  LiveDisplay& operator=(const LiveDisplay&) = delete;

  /** To be called after every step. */
  void Tick();
  /** A line above it, of something that has happened. */
  void Say(const std::string& line);

 private:
  using Clock = std::chrono::steady_clock;
  std::vector<std::string> DrawCard();
  void Show();
  void WaitForTheClock();

  Shell& shell_;
  const double start_time_;  // of the trial [s]
  const Clock::time_point start_;
  Clock::time_point next_;
};

}  // namespace graspbench
