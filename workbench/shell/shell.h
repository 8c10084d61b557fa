#pragma once
/** @file
The interactive shell without its terminal: a line goes in, results and messages come out on stdout
and stderr as everywhere in the program. */

#include <optional>
#include <string>
#include <vector>

#include "core/trial/trial_result.h"
#include "workbench/shell/shell_picture.h"
#include "workbench/shell/shell_scene.h"

namespace graspbench {

/** The first draws of a choice, for the next one to be compared with. */
struct DrawnTrials {
  SceneChoice choice;
  std::string grasp;                 ///< id
  std::vector<TrialResult> results;  ///< by number of the draw
};

class Shell {
 public:
  enum class Reply { kDone, kRefused, kQuit };

  /** @throws Error when the first scene cannot be loaded. */
  Shell();

  /** Carries out one line; what is wrong with it is said, and nothing has changed then. */
  Reply Execute(const std::string& line);

  ShellScene& scene() { return scene_; }
  /** Takes another choice, which `Undo` takes back; the trial starts anew. */
  void Change(const SceneChoice& choice);
  /** The choice before the last change, at the time at which the trial stood now.
  @throws Error(kUsage) when there was none. */
  void Undo();
  int num_changes() const { return static_cast<int>(former_.size()); }
  void Quit() { is_ended_ = true; }

  /** A person asked to stop what runs; asked after every step. */
  bool IsStopped() const;
  /** To be shown with "stopped by Ctrl-C" where work was cut short. */
  bool was_stopped() const { return was_stopped_; }

  std::optional<DrawnTrials> trials;  ///< of the last `trials`
  ScenePainter painter;

 private:
  ShellScene scene_;
  std::vector<SceneChoice> former_;
  bool is_ended_ = false;
  mutable bool was_stopped_ = false;
};

/** From now on Ctrl-C stops the work of a shell; a second one before it has stopped ends the
program. SIGTERM and SIGHUP stop it too and let the program end in order, the terminal restored. */
void CatchShellSignals();
bool MustShellEnd();
/** Forgets a Ctrl-C; true when there was one. */
bool TakeShellInterrupt();

}  // namespace graspbench
