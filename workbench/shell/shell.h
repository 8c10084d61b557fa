#pragma once
/** @file
The interactive shell without its terminal: it executes lines and prints results to stdout and
messages to stderr, like the rest of the program. */

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "core/trial/trial_result.h"
#include "workbench/shell/shell_picture.h"
#include "workbench/shell/shell_scene.h"
#include "workbench/terminal/status_region.h"

namespace graspbench {

/** Results of a choice's first draws, with which those of the next choice are compared. */
struct DrawnTrials {
  SceneChoice choice;
  std::string grasp;                 ///< id of the grasp
  std::vector<TrialResult> results;  ///< indexed by draw
};

class Shell {
 public:
  enum class Reply { kDone, kRefused, kQuit };

  /** Executes one line. On failure it prints a message and leaves the state unchanged.
  @param where  prefix of the message: "line 3: ". */
  Reply Execute(const std::string& line, const std::string& where = "");

  /** The scene, loaded on first use. @throws Error when it cannot be loaded. */
  ShellScene& scene();
  bool is_loaded() const { return scene_.is_loaded(); }
  /** The choice that the scene has or will have; loads nothing. */
  const SceneChoice& choice() const { return scene_.choice(); }
  /** Makes another choice, which `Undo` can revert; the trial restarts. */
  void Change(const SceneChoice& choice);
  /** As Change, but the trial is advanced to its present time. */
  void ChangeNow(const SceneChoice& choice);
  /** Reverts the last change and advances the trial to its present time. @throws Error(kUsage) when
  there was no change. */
  void Undo();
  /** Restores the choice that the last `Undo` reverted. @throws Error(kUsage) when there is
  none. */
  void Redo();
  int num_changes() const { return static_cast<int>(former_.size()); }
  void Quit() { is_ended_ = true; }
  /** Whether the shell ends at the first refused line, as in a script but not interactively. */
  bool stops_at_errors() const { return stops_at_errors_; }
  void StopAtErrors(bool stops) { stops_at_errors_ = stops; }

  /** Whether the user pressed Ctrl-C; checked after every step. */
  bool IsStopped() const;
  /** Whether IsStopped was true during the current line; then "stopped by Ctrl-C" is shown. */
  bool was_stopped() const { return was_stopped_; }

  /** The first choice with the same hand, object and grasp, before later changes; unset: no
  changes. */
  std::optional<SceneChoice> FindUnchanged() const;

  /** The executed lines, as a script. */
  const std::vector<std::string>& script() const { return script_; }

  std::optional<DrawnTrials> trials;  ///< of the last `trials`
  std::string comparison;   ///< the text of the last `trials`; empty: none for this choice
  std::string explanation;  ///< the text of the last `why`; empty: none for this trial
  ScenePainter painter;
  StatusRegion region{stdout};  ///< progress while a command runs
  std::string live_card;        ///< card shown while a trial runs; empty: none

 private:
  Reply Carry(const std::string& line, const std::string& where);
  /** Switches to `choice` at the present trial time and discards results of the former choice. */
  void TakeInstead(const SceneChoice& choice);

  ShellScene scene_;
  std::vector<SceneChoice> former_, undone_;
  std::vector<std::string> script_;
  bool is_ended_ = false, stops_at_errors_ = true;
  mutable bool was_stopped_ = false;
};

/** "tum golf_ball g3, closure 0.840 s, 2 changes> "; loads nothing. */
std::string FormatPrompt(Shell& shell);

/** Installs the shell's signal handlers. Ctrl-C stops the running command; a second one before it
has stopped ends the program. SIGTERM and SIGHUP also stop the command, then end the program in
order. A signal that was ignored stays ignored. After a crash, the terminal settings are
restored. */
void CatchShellSignals();
bool MustShellEnd();
/** Clears a pending Ctrl-C; true when there was one. */
bool TakeShellInterrupt();
/** Set by Ctrl-C until it is cleared. */
const std::atomic<bool>& GetShellInterrupt();

}  // namespace graspbench
