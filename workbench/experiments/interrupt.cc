#include "workbench/experiments/interrupt.h"

#include <signal.h>
#include <unistd.h>

#include "core/base/error.h"

namespace graspbench {
namespace {

std::atomic<bool> is_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // so a signal handler may set it

extern "C" void OnInterrupt(int) {
  if (is_interrupted.exchange(true)) ::_exit(kExitInterrupted);
}

}  // namespace

const std::atomic<bool>& CatchInterrupts() {
  struct sigaction action {};
  action.sa_handler = OnInterrupt;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::sigaction(signal, &action, nullptr);
  return is_interrupted;
}

}  // namespace graspbench
