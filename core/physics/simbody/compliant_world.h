#pragma once
/** @file
A second backend, for comparison, that shares neither the contact model nor the integrator of the
first: Simbody's compliant contact, integrated by CPodes (variable order and step, implicit, error
control).

    hand      the same spheres, on Simbody's own multibody model
    object    a ball; Hertz contact of spheres
    friction  Stribeck law with a transition speed of 0.1 mm/s: a loaded contact creeps
    coupling  distal joints are tied, or locked, by stiff springs
    drives    follow instantly: no hysteresis, friction or compliance of imperfect_drive.h

Other objects would need elastic foundations on fine meshes, which take minutes per trial. Pads have
their modulus but no depth and no torsion radius, so sigma is lower. A smooth ball rolls off more
easily than its mesh. Links do not touch each other. Turning gravity and loading the object throw
Error(kUnsupported). A trial takes some seconds.

A clone takes over time, positions, speeds, commands, locked joints and the last contacts, but not
the integrator's history. It starts with a small step of low order, so it continues within the
integrator's accuracy, not bit for bit. */

#include <memory>

#include "core/physics/world.h"

namespace graspbench {

/** Returns whether the object is a rigid ball; seams and dimples do not count. */
bool CanMoveCompliantly(const GraspObject& object);
/** Returns whether all drives and couplings of the hand are ideal. */
bool CanMoveCompliantly(const Hand& hand);

/** Makes a compliant world. Its energy residual is unset. Its methods throw Simbody's exceptions.
@pre CanMoveCompliantly of both. */
std::unique_ptr<World> MakeCompliantWorld(const Hand& hand, const GraspObject& object,
                                          const SimConfig& config);

}  // namespace graspbench
