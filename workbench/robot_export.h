#pragma once
/** @file
`export --mjcf` and `export --urdf`: what other programs simulate and show. The paths are printed. */

#include <string>
#include <vector>

#include "datasets/session/session_store.h"

namespace graspbench {

struct RobotExport {
  std::string folder;  ///< of the session
  std::string out;     ///< empty: below the session's export/, which is written again
  bool replace = false, json = false;
};

/** A folder a trial, named by its id. @param names  of trials, or only "all".
@throws Error(kNotFound, kUsage, kIo). */
void ExportMjcf(const RobotExport& options, const std::vector<std::string>& names,
                const Session& session);

/** A folder a hand: hand.urdf, its meshes, and robot.urdf, the hand on the session's robot arm.
@throws Error(kUsage) for a session without an arm; Error(kUnsupported, kIo). */
void ExportUrdf(const RobotExport& options, const Session& session);

}  // namespace graspbench
