#pragma once
/** @file
The command line program: finds and runs the command, and turns every failure into one message on
stderr and an exit code of core/base/error.h. */

#include "core/base/error.h"

namespace graspbench {

class Command;

/** Sets up an empty parser as that of graspbench: name, help and every command. */
void AddCommands(Command& program);

int RunProgram(int argc, const char* const* argv);

}  // namespace graspbench
