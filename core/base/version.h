#pragma once
/** @file The version of the program. */

namespace graspbench {

/** Version of this program, "0.1.0"; it stands in the root CMakeLists. */
const char* program_version();

}  // namespace graspbench
