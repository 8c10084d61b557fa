#include "workbench/shell/shell.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <iterator>

#include "core/base/config.h"
#include "core/base/error.h"
#include "core/base/text/text.h"
#include "workbench/shell/line_editor.h"
#include "workbench/shell/shell_commands.h"
#include "workbench/terminal/command_line.h"
#include "workbench/terminal/terminal.h"
#include "workbench/terminal/terminal_observer.h"

namespace graspbench {
namespace {

std::atomic<bool> is_interrupted{false}, is_ending{false};

extern "C" void HandleShellInterrupt(int) {
  if (!is_interrupted.exchange(true)) return;
  RestoreTerminal();
  ::_exit(kExitInterrupted);
}

extern "C" void HandleShellEnd(int) {
  is_ending = true;
  is_interrupted = true;
}

constexpr int kCrashes[] = {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL};
struct sigaction former_actions[std::size(kCrashes)];

/** The terminal as it was, and then whatever a crash does. */
extern "C" void HandleCrash(int signal) {
  RestoreTerminal();
  for (size_t i = 0; i < std::size(kCrashes); ++i) {
    if (kCrashes[i] == signal) ::sigaction(signal, &former_actions[i], nullptr);
  }
  ::raise(signal);
}

void Catch(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;  // without SA_RESTART: reading a line ends, too
  CatchUnlessIgnored(signal, action);
}

size_t CountEdits(const SceneChoice& choice) {
  return choice.joints.size() + choice.closing.size() + choice.drives.size() +
         (choice.hand_place ? 1 : 0) + (choice.learned ? 1 : 0);
}

void CatchCrashes() {
  static char stack[1 << 14];  // a crash may be the end of the other
  stack_t alternative = {};
  alternative.ss_sp = stack;
  alternative.ss_size = sizeof stack;
  ::sigaltstack(&alternative, nullptr);
  struct sigaction action {};
  action.sa_handler = &HandleCrash;
  action.sa_flags = SA_ONSTACK;
  for (size_t i = 0; i < std::size(kCrashes); ++i) {
    ::sigaction(kCrashes[i], &action, &former_actions[i]);
  }
}

}  // namespace

void CatchShellSignals() {
  Catch(SIGINT, &HandleShellInterrupt);
  Catch(SIGTERM, &HandleShellEnd);
  Catch(SIGHUP, &HandleShellEnd);
  CatchCrashes();
}

bool MustShellEnd() { return is_ending; }

const std::atomic<bool>& GetShellInterrupt() { return is_interrupted; }

bool TakeShellInterrupt() { return is_interrupted.exchange(false); }

ShellScene& Shell::scene() {
  if (!scene_.is_loaded()) scene_.Choose(scene_.choice());
  return scene_;
}

bool Shell::IsStopped() const {
  was_stopped_ = was_stopped_ || is_interrupted.load();
  return was_stopped_;
}

void Shell::Change(const SceneChoice& choice) {
  const SceneChoice former = scene_.choice();
  scene_.Choose(choice);
  former_.push_back(former);
  undone_.clear();
  explanation.clear();
  comparison.clear();
}

void Shell::ChangeNow(const SceneChoice& choice) {
  const double time = scene().time();
  Change(choice);
  scene_.GoTo(time, [this] { return IsStopped(); });
}

void Shell::Undo() {
  if (former_.empty()) throw Error(ErrorKind::kUsage, "there is no change to undo");
  const SceneChoice now = choice();
  TakeInstead(former_.back());
  former_.pop_back();
  undone_.push_back(now);
}

void Shell::Redo() {
  if (undone_.empty()) throw Error(ErrorKind::kUsage, "there is no undone change to restore");
  const SceneChoice now = choice();
  TakeInstead(undone_.back());
  undone_.pop_back();
  former_.push_back(now);
}

void Shell::TakeInstead(const SceneChoice& choice) {
  const double time = scene().time();
  scene_.Choose(choice);
  explanation.clear();
  comparison.clear();
  scene_.GoTo(time, [this] { return IsStopped(); });
}

std::optional<SceneChoice> Shell::FindUnchanged() const {
  const SessionConfig& now = choice().config;
  std::optional<SceneChoice> first;
  for (auto former = former_.rbegin(); former != former_.rend(); ++former) {
    const SessionConfig& config = former->config;
    if (config.hands != now.hands || config.objects != now.objects || config.grasps != now.grasps ||
        former->folder != choice().folder) {
      break;
    }
    first = *former;
  }
  const bool is_same = first && CountEdits(*first) == CountEdits(choice()) &&
                       ConfigToJson(first->config) == ConfigToJson(now);
  return is_same ? std::nullopt : first;
}

std::string FormatPrompt(Shell& shell) {
  const SessionConfig& config = shell.choice().config;
  if (!shell.is_loaded()) {
    return config.hands.front() + " " + config.objects.front() + " " + config.grasps.front() + "> ";
  }
  ShellScene& scene = shell.scene();
  const TrialSetup& setup = scene.setup();
  std::string text = setup.hand->id + " " + setup.object->id + " " + setup.grasp.id + ", " +
                     (scene.is_over() ? "ended" : NameOf(scene.notes().phase)) + " " +
                     FormatFixed(scene.time(), 3) + " s";
  if (shell.num_changes() > 0) text += ", " + FormatCount(shell.num_changes(), "change");
  return text + "> ";
}

Shell::Reply Shell::Execute(const std::string& line, const std::string& where) {
  TakeShellInterrupt();
  was_stopped_ = false;
  const Reply reply = Carry(line, where);
  TakeShellInterrupt();  // at the prompt the next one is a first one
  return reply;
}

Shell::Reply Shell::Carry(const std::string& line, const std::string& where) {
  try {
    const std::vector<std::string> words = SplitWords(line);
    if (words.empty()) return Reply::kDone;
    RunShellCommand(*this, words);
    script_.push_back(line);
    if (was_stopped_) PrintMessage("stopped by Ctrl-C");
    return is_ended_ ? Reply::kQuit : Reply::kDone;
  } catch (const std::exception& fault) {
    region.Clear();
    PrintMessage(where + fault.what());
    return Reply::kRefused;
  }
}

}  // namespace graspbench
