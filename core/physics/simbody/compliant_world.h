#pragma once
/** @file
A second world that shares nothing with the first one's contact and integration: Simbody's
compliant contact, integrated by CPodes (variable order and step, implicit, error control).

    hand      the same spheres, on Simbody's own multibody model
    object    a ball; Hertz contact of spheres
    friction  Stribeck law with a transition speed of 0.1 mm/s: a loaded contact creeps
    coupling  distal joints are tied, or locked, by stiff springs
    drives    follow at once: without the hysteresis, friction and yielding of imperfect_drive.h

Other objects would need elastic foundations on fine meshes, which take minutes a trial. Pads have
their modulus but no depth and no torsion radius, so sigma is lower; a smooth ball rolls off more
easily than its mesh; links do not touch each other. Gravity cannot be turned and no load be put on
the object: both throw Error(kUnsupported). Some seconds a trial: there to be compared with.

A clone carries over time, positions, speeds, commands, locked joints and the contacts last found,
not the integrator's history: it starts with a small step of low order, so it goes on within the
integrator's accuracy, not to the same bytes. */

#include <memory>

#include "core/physics/world.h"

namespace graspbench {

/** Whether the object is a rigid ball; seams and dimples do not count. */
bool CanMoveCompliantly(const GraspObject& object);
/** Whether the hand has no imperfect drive or coupling. */
bool CanMoveCompliantly(const Hand& hand);

/** Its energy residual stays unset; it throws what Simbody throws.
@pre CanMoveCompliantly of both. */
std::unique_ptr<World> MakeCompliantWorld(const Hand& hand, const GraspObject& object,
                                          const SimConfig& config);

}  // namespace graspbench
