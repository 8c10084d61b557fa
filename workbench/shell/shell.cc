#include "workbench/shell/shell.h"

#include <signal.h>
#include <unistd.h>

#include <atomic>

#include "core/base/error.h"
#include "workbench/shell/shell_commands.h"
#include "workbench/shell/shell_words.h"
#include "workbench/terminal.h"

namespace graspbench {
namespace {

std::atomic<bool> is_interrupted{false}, is_ending{false};

extern "C" void HandleShellInterrupt(int) {
  if (is_interrupted.exchange(true)) ::_exit(kExitInterrupted);
}

extern "C" void HandleShellEnd(int) {
  is_ending = true;
  is_interrupted = true;
}

void Catch(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;  // without SA_RESTART: reading a line ends, too
  ::sigaction(signal, &action, nullptr);
}

}  // namespace

void CatchShellSignals() {
  Catch(SIGINT, &HandleShellInterrupt);
  Catch(SIGTERM, &HandleShellEnd);
  Catch(SIGHUP, &HandleShellEnd);
}

bool MustShellEnd() { return is_ending; }

bool TakeShellInterrupt() { return is_interrupted.exchange(false); }

Shell::Shell() { scene_.Choose(SceneChoice::MakeDefault()); }

bool Shell::IsStopped() const {
  was_stopped_ = was_stopped_ || is_interrupted.load();
  return was_stopped_;
}

void Shell::Change(const SceneChoice& choice) {
  const SceneChoice former = scene_.choice();
  scene_.Choose(choice);
  former_.push_back(former);
}

void Shell::Undo() {
  if (former_.empty()) throw Error(ErrorKind::kUsage, "nothing was changed that could be undone");
  const double time = scene_.time();
  scene_.Choose(former_.back());
  former_.pop_back();
  scene_.GoTo(time, [this] { return IsStopped(); });
}

Shell::Reply Shell::Execute(const std::string& line) {
  TakeShellInterrupt();
  was_stopped_ = false;
  try {
    const std::vector<std::string> words = SplitWords(line);
    if (words.empty()) return Reply::kDone;
    RunShellCommand(*this, words);
    if (was_stopped_) PrintMessage("stopped by Ctrl-C");
    return is_ended_ ? Reply::kQuit : Reply::kDone;
  } catch (const std::exception& fault) {
    PrintMessage(fault.what());
    return Reply::kRefused;
  }
}

}  // namespace graspbench
