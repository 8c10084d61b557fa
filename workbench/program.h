#pragma once
/** @file
The command line program: finds the command, runs it, turns every fault into one message on stderr
and an exit code of core/base/error.h. */

namespace graspbench {

int RunProgram(int argc, const char* const* argv);

}  // namespace graspbench
