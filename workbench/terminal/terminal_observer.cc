#include "workbench/terminal/terminal_observer.h"

#include "core/base/text/text.h"
#include "workbench/terminal/terminal.h"

namespace graspbench {

std::string DescribeTasks(const Stage& stage) {
  const StageRow& row = RowOf(kStages, stage.kind);
  return FormatCount(stage.num_left, row.task, row.tasks) + " to " + row.verb;
}

void TerminalObserver::BeginStage(const Stage& stage) {
  if (describe_) PrintMessage(describe_(stage));
  if (stage.num_left == 0) return;
  start_ = std::chrono::steady_clock::now();
  progress_.emplace(stderr, stage);
}

void TerminalObserver::ShowStatus(const BatchStatus& status, int num_trials) {
  if (stop_ && !has_told_) {
    progress_->Say("stopping after the current trials; press again to abort");
    has_told_ = true;
  }
  progress_->SetPlanned(num_trials);
  progress_->Show(status,
                  std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count());
}

void TerminalObserver::EndStage() { progress_->Finish(); }

}  // namespace graspbench
