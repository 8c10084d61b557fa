#pragma once
/** @file
What program this is. */

namespace graspbench {

/** Version of this program, "0.1.0"; it stands in the root CMakeLists. */
const char* program_version();

/** Commit of the source it was built from, 40 hexadecimal digits, changes beside it not included;
"unknown" when the source was no clone. */
const char* program_commit();

/** Hash of the sources from which fitted grasps and mesh checks follow (core/base, core/shape,
core/hand, core/grasp, objects), and of the compiler: a result that is kept between runs is keyed by
it, so that no change of a rule meets an old one. */
const char* program_sources();

}  // namespace graspbench
