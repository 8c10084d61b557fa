#pragma once
/** @file
Rest pose of an object on the simulated table, from which a trial can start without transients.

A scan is rough: placed as its mesh lies, it rocks, and it sinks as its contact springs are loaded.
It is released alone and stopped every 0.1 s until it moves by less than 1 um and 0.01 mrad in that
time; after ten seconds its pose is taken as it is. Horizontal motion and rotation about the
vertical are discarded, so that the sampled pose of a trial is the pose that is grasped. An object
that ends within 0.025 mm and 0.5 mrad of its initial pose is placed there. */

#include <optional>

#include "core/base/pose.h"
#include "core/physics/sim_config.h"
#include "core/shape/grasp_object.h"

namespace graspbench {

/** Returns X_WO at rest, its origin above that of W and its x axis in the plane y = 0; nullopt for
an object that rests in its initial pose. The result is cached by distance field, mass and settings.
Safe to call from several threads. */
std::optional<Pose> FindRestPose(const GraspObject& object, const SimConfig& sim);

}  // namespace graspbench
