#pragma once
/** @file
How an object rests on the simulated table, so that a trial begins when it does.

A scan is rough: set down as its mesh lies it rocks, and its springs let it sink. It is let go
alone, stopped every tenth of a second, until it moves by less than 1 um and 0.01 mrad in such a
time; what still moves after ten seconds is taken as it is then. Where it went sideways or turned
about the vertical meanwhile does not count, so that the draw of a trial is the pose that is
grasped. An object that ends within 0.025 mm and 0.5 mrad of how it lies is set down as it lies. */

#include <optional>

#include "core/base/pose.h"
#include "core/physics/sim_config.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

/** X_WO at rest, its origin over that of W and its x axis in the plane y = 0; nothing of an object
that rests as it lies. Found once for an object's distance field and these settings; safe to call
from several threads. */
std::optional<Pose> FindRestPose(const GraspObject& object, const SimConfig& sim);

}  // namespace graspbench
