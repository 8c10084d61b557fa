#pragma once
/** @file
What the shell shows of a scene, as text: one card each. */

#include <string>
#include <vector>

#include "workbench/shell/shell_scene.h"

namespace graspbench {

/** "1.234 s  hold  grip 3.2 N  3 contacts"; with the outcome and its sentence once it is over. */
std::string FormatStatus(ShellScene& scene);
/** What is chosen, and where object and joints really are. */
std::string FormatScene(ShellScene& scene);
/** Angles within their limits as bars, and what the drives are asked for. */
std::string FormatJoints(ShellScene& scene);
/** Forces now, with the share of the friction cone that each contact uses. */
std::string FormatContacts(ShellScene& scene);
/** First touches; GCT, GFT, GOT as far as they are known. */
std::string FormatTiming(ShellScene& scene);
/** Sigma, epsilon and the pull that the contacts would stand along the palm's six half axes, now. */
std::string FormatStability(ShellScene& scene);

std::vector<std::string> ListSettingKeys(const SessionConfig& config);
/** "sim.step_s 0.002" of all settings whose names hold `part`. */
std::string FormatSettings(const SessionConfig& config, const std::string& part);
/** What differs from the grasp and from the session's defaults; empty: nothing. */
std::string FormatChanges(const ShellScene& scene);

/** The wrench space of the contacts at this instant, in the object's frame about its centre of mass
(core/quality/grasp_quality.h). */
std::string FormatWrenchSpace(ShellScene& scene);

/** Where the pads of all digits are in a posture, where they face, and how far they are from the
opposing digit's: the opening. All in the hand's frame H.
@param posture  "now", "pre" or "target", of the grasp. */
std::string FormatPads(ShellScene& scene, const std::string& posture);

}  // namespace graspbench
