#pragma once
/** @file
Stopping on request: SIGINT (Ctrl-C), SIGTERM and SIGHUP. */

#include <atomic>

namespace graspbench {

/** From now on the first such signal sets the flag; a second one ends the program at once with the
exit code of an interrupted run, and so do eight seconds: a trial that does not end cannot hold the
program up. What was kept before is safe either way. */
const std::atomic<bool>& CatchInterrupts();

}  // namespace graspbench
