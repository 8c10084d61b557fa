#pragma once
/** @file
The interactive shell without its terminal: a line goes in, results and messages come out on stdout
and stderr as everywhere in the program. */

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "core/trial/trial_result.h"
#include "workbench/shell/shell_picture.h"
#include "workbench/shell/shell_scene.h"
#include "workbench/terminal/status_region.h"

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

  /** Carries out one line; what is wrong with it is said, and nothing has changed then.
  @param where  stands before the message: "line 3: ". */
  Reply Execute(const std::string& line, const std::string& where = "");

  /** The first one is loaded when somebody asks for it. @throws Error when that cannot be. */
  ShellScene& scene();
  bool is_loaded() const { return scene_.is_loaded(); }
  /** What the scene is or will be made of; loads nothing. */
  const SceneChoice& choice() const { return scene_.choice(); }
  /** Takes another choice, which `Undo` takes back; the trial starts again. */
  void Change(const SceneChoice& choice);
  /** The same, and the trial stands at the time at which it stood. */
  void ChangeNow(const SceneChoice& choice);
  /** The choice before the last change, at the time at which the trial stood now.
  @throws Error(kUsage) when there was none. */
  void Undo();
  /** The choice that the last `Undo` took back. @throws Error(kUsage) when there is none. */
  void Redo();
  int num_changes() const { return static_cast<int>(former_.size()); }
  void Quit() { is_ended_ = true; }
  /** Whether a script ends at its first line that is refused; a person goes on. */
  bool stops_at_errors() const { return stops_at_errors_; }
  void StopAtErrors(bool stops) { stops_at_errors_ = stops; }

  /** A person asked to stop what runs; asked after every step. */
  bool IsStopped() const;
  /** To be shown with "stopped by Ctrl-C" where work was cut short. */
  bool was_stopped() const { return was_stopped_; }

  /** The first choice of the same hand, object and grasp, before what was changed since; unset:
  nothing was. */
  std::optional<SceneChoice> FindUnchanged() const;

  /** What was carried out, as a script. */
  const std::vector<std::string>& script() const { return script_; }

  std::optional<DrawnTrials> trials;  ///< of the last `trials`
  std::string comparison;             ///< the text of the last `trials`; empty: none of this choice
  std::string explanation;            ///< the text of the last `why`; empty: none of this trial
  ScenePainter painter;
  StatusRegion region{stdout};  ///< what is shown while something runs
  std::string live_card;        ///< shown while a trial goes on; empty: none

 private:
  Reply Carry(const std::string& line, const std::string& where);
  /** Stands where the trial stood, and forgets what was said of another choice. */
  void TakeInstead(const SceneChoice& choice);

  ShellScene scene_;
  std::vector<SceneChoice> former_, undone_;
  std::vector<std::string> script_;
  bool is_ended_ = false, stops_at_errors_ = true;
  mutable bool was_stopped_ = false;
};

/** "tum golf_ball g3, closure 0.840 s, 2 changes> "; loads nothing. */
std::string FormatPrompt(Shell& shell);

/** From now on Ctrl-C stops the work of a shell; a second one before it has stopped ends the
program. SIGTERM and SIGHUP stop it too and let the program end in order. A signal that was
ignored stays ignored. A crash gives the terminal its settings back. */
void CatchShellSignals();
bool MustShellEnd();
/** Forgets a Ctrl-C; true when there was one. */
bool TakeShellInterrupt();
/** Set by a Ctrl-C until it is forgotten. */
const std::atomic<bool>& GetShellInterrupt();

}  // namespace graspbench
