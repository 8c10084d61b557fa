#pragma once
/** @file
The keys of a session file: what each is, and what its numbers may be. */

#include "core/base/file_keys.h"

namespace graspbench {

/** In the order of SessionFile, with its defaults. The ranges keep the simulation stable and
short; they are wider than anything sensible. */
const FileKeys& ListSessionKeys();

}  // namespace graspbench
