#pragma once
/** @file
The keys of grasps: in hand.yaml, and in files of their own. */

#include "core/base/file_keys.h"

namespace graspbench {

/** What each of `grasps` in hand.yaml may have: "grasps.ID.digits". */
const FileKeys& ListHandGraspKeys();

/** The keys of a grasp file (grasp_file.h). */
const FileKeys& ListGraspFileKeys();

}  // namespace graspbench
