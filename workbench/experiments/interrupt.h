#pragma once
/** @file
Stopping on request: SIGINT (Ctrl-C), SIGTERM and SIGHUP. */

#include <atomic>

struct sigaction;

namespace graspbench {

/** Installs the action, unless the signal is ignored: `nohup` and shells without job control start
programs with signals that must not end them. */
void CatchUnlessIgnored(int signal, const struct sigaction& action);

/** From now on the first such signal sets the flag; a second one ends the program at once with the
exit code of an interrupted run, and so do eight seconds: a trial that does not end cannot hold the
program up. What was kept before is safe either way. A signal that was ignored stays ignored. */
const std::atomic<bool>& CatchInterrupts();

}  // namespace graspbench
