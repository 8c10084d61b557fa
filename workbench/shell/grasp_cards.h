#pragma once
/** @file
The grasp of a shell's scene as text: what its contacts can do, how its pads stand. */

#include <string>

#include "workbench/shell/shell_scene.h"

namespace graspbench {

/** The wrench space of the contacts at this instant, in the object's frame about its centre of mass
(core/quality/grasp_quality.h). */
std::string FormatWrenchSpace(ShellScene& scene);

/** Where the pads of all digits are in a posture, where they face, and how far they are from the
opposing digit's: the opening. All in the hand's frame H.
@param posture  "now", "pre" or "target", of the grasp. */
std::string FormatPads(ShellScene& scene, const std::string& posture);

}  // namespace graspbench
