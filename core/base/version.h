#pragma once
/** @file
What program this is. */

namespace graspbench {

/** Version of this program, "0.1.0"; it stands in the root CMakeLists. */
const char* program_version();

/** Commit of the source it was built from, 40 hexadecimal digits, changes beside it not included;
"unknown" when the source was no clone. */
const char* program_commit();

}  // namespace graspbench
