#include "workbench/experiments/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include "core/base/error.h"

namespace graspbench {
namespace {

std::atomic<bool> is_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // so a signal handler may set it

/** Less than the ten seconds after which service managers kill. [s] */
constexpr unsigned kPatience = 8;
constexpr char kGivenUp[] =
    "graspbench: stopped without waiting longer for what was running. The same command continues "
    "a session, an optimisation or a campaign, and begins anything else again\n";

extern "C" void OnInterrupt(int) {
  if (is_interrupted.exchange(true)) ::_exit(kExitInterrupted);
  ::alarm(kPatience);
}

extern "C" void OnPatienceOver(int) {
  // Nothing else may be done in a signal handler; every finished trial is on the disk already.
  const ssize_t written = ::write(STDERR_FILENO, kGivenUp, sizeof kGivenUp - 1);
  static_cast<void>(written);
  ::_exit(kExitInterrupted);
}

}  // namespace

void CatchUnlessIgnored(int signal, const struct sigaction& action) {
  struct sigaction former {};
  ::sigaction(signal, nullptr, &former);
  if (former.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
}

const std::atomic<bool>& CatchInterrupts() {
  struct sigaction action {};
  action.sa_handler = OnInterrupt;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) CatchUnlessIgnored(signal, action);
  action.sa_handler = OnPatienceOver;
  ::sigaction(SIGALRM, &action, nullptr);
  return is_interrupted;
}

}  // namespace graspbench
