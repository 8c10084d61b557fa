#pragma once
/** @file
The shell's text cards, each showing one aspect of a scene. */

#include <string>
#include <vector>

#include "workbench/shell/shell_scene.h"

namespace graspbench {

/** "1.234 s hold grip 3.2 N 3 contacts"; with the outcome and its reason once the trial is over. */
std::string FormatStatus(ShellScene& scene);
/** The choice, and the actual object pose and joint positions. */
std::string FormatScene(ShellScene& scene);
/** Joint angles within their limits as bars, and the setpoints of the drives. */
std::string FormatJoints(ShellScene& scene);
/** Current contact forces, with the share of the friction cone that each contact uses. */
std::string FormatContacts(ShellScene& scene);
/** First contacts; GCT, GFT and GOT as far as they are known. */
std::string FormatTiming(ShellScene& scene);
/** Current sigma, epsilon, and the load that the contacts resist along the six half axes of the
palm frame. */
std::string FormatStability(ShellScene& scene);

std::vector<std::string> ListSettingKeys(const SessionConfig& config);
/** Lists all settings whose names contain `part`: "sim.step_s 0.002". */
std::string FormatSettings(const SessionConfig& config, const std::string& part);
/** Differences from the grasp and from the session's defaults; empty: none. */
std::string FormatChanges(const ShellScene& scene);

/** The current grasp wrench space of the contacts, in the object's frame about its centre of mass
(core/quality/grasp_quality.h). */
std::string FormatWrenchSpace(ShellScene& scene);

/** Positions and normals of all digits' pads in a posture, and their distances from the opposing
digit's pad (the opening), in the hand's frame H. @param posture  "now", or the grasp's "pre" or
"target". */
std::string FormatPads(ShellScene& scene, const std::string& posture);

}  // namespace graspbench
