#pragma once
/** @file
Shows an experiment on the terminal: a line before each stage, then its progress. */

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "workbench/terminal/progress.h"

namespace graspbench {

/** "3 scenes to optimise". */
std::string DescribeTasks(const Stage& stage);

class TerminalObserver : public Observer {
 public:
  /** @param describe  the line before a stage; without it none is printed.
  @param stop  when it is set, the user is told once that the current trials are finished first. */
  TerminalObserver(std::function<std::string(const Stage&)> describe, const std::atomic<bool>& stop)
      : describe_(std::move(describe)), stop_(stop) {}

  void BeginStage(const Stage& stage) override;
  void ShowStatus(const BatchStatus& status, int num_trials) override;
  void EndStage() override;

 private:
  std::function<std::string(const Stage&)> describe_;
  const std::atomic<bool>& stop_;
  std::chrono::steady_clock::time_point start_;
  std::optional<Progress> progress_;  // of the current stage
  bool has_told_ = false;
};

}  // namespace graspbench
