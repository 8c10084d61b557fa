#pragma once
/** @file
Version of the program and of its sources. */

namespace graspbench {

/** Returns the version of this program, for example "0.1.0", as set in the root CMakeLists.txt. */
const char* program_version();

/** Returns the commit of the source that the program was built from: 40 hexadecimal digits.
Uncommitted changes are not included. "unknown" when the source was not a clone. */
const char* program_commit();

/** Returns the hash of the compiler and of all sources that determine fitted grasps and mesh checks
(core/base, core/shape, core/hand, core/grasp, objects). Cached results are keyed by it, so that a
changed rule never uses an old result. */
const char* program_sources();

}  // namespace graspbench
