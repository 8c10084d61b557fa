#pragma once
/** @file
The hand's equations of motion as our recursions have them, against Simbody's at the same state:
every trial asks once, so that a wrong inertia never yields a result. */

#include "core/physics/simbody/simbody_model.h"
#include "core/physics/world.h"

namespace graspbench {

/** A larger difference means that one of both is wrong; rounding alone makes about 1e-11. */
inline constexpr double kSimbodyTolerance = 1e-9;

/** Largest difference of the world's mass matrix and bias from Simbody's at the world's state, each
relative to its largest entry; the degrees of freedom also apart from the base, which is so much
heavier that both have a scale of their own.
@param simbody  of the same hand and object, all joints free; its state is overwritten. */
double CompareWithSimbody(World& world, SimbodyModel& simbody);

}  // namespace graspbench
