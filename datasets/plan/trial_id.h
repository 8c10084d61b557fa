#pragma once
/** @file
The id of a trial: a hash of everything that affects its result, and of nothing else. The trial's
random stream derives from it. */

#include <string>

#include "core/base/text/json.h"
#include "core/hand/hand.h"
#include "core/shape/grasp_object.h"
#include "datasets/plan/session_config.h"

namespace graspbench {

struct MountedArm;

/** @param grasp  one, or the list of those from which the camera chooses.
@param arm  null: none.
@pre the hand has a camera if the session needs one, and a skin if touch is sensed. */
std::string CalcTrialId(const SessionConfig& config, const Hand& hand, const GraspObject& object,
                        const Json& grasp, int trial, const MountedArm* arm = nullptr);

}  // namespace graspbench
