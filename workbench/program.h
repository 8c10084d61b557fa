#pragma once
/** @file
The command line program: finds the command, runs it, turns every fault into one message on stderr
and an exit code of core/base/error.h. */

#include "core/base/error.h"

namespace graspbench {

class Command;

/** Makes an empty parser that of graspbench: its name, help and every command. */
void AddCommands(Command& program);

int RunProgram(int argc, const char* const* argv);

}  // namespace graspbench
