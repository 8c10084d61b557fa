#pragma once
/** @file
`export --mjcf` and `export --urdf`: models for other simulators and viewers. The paths written are
printed. */

#include <string>
#include <vector>

#include "datasets/session/session_store.h"

namespace graspbench {

struct RobotExport {
  std::string folder;  ///< of the session
  std::string out;     ///< empty: below the session's export/, which is rewritten
  bool replace = false, json = false;
};

/** Writes one folder per trial, named by its id. @param names  of trials, or only "all".
@throws Error(kNotFound, kUsage, kIo). */
void ExportMjcf(const RobotExport& options, const std::vector<std::string>& names,
                const Session& session);

/** Writes one folder per hand: hand.urdf, its meshes, and robot.urdf with the hand on the session's
robot arm.
@throws Error(kUsage) for a session without an arm; Error(kUnsupported, kIo). */
void ExportUrdf(const RobotExport& options, const Session& session);

}  // namespace graspbench
