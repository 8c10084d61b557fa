#pragma once
/** @file
The constants of a contact from the surfaces of its two sides: one rule for every pair.

    given on no side      stiffness, dissipation: those of the session; no friction, no torsion
    given on one side     its value
    given on both sides   as springs in series, k = kA kB / (kA + kB)
                          d = (kB dA + kA dB) / (kA + kB), weighted by how much a side gives way
                          mu = 2 muA muB / (muA + muB)
                          r = the smaller: the smaller patch of contact

This is Simbody's rule for compliant contact (CompliantContactSubsystem, Sherman 2011), with what
was left out read as "the other side decides"; a stiffness that was left out counts as the session's
in the weights of d. The tangential stiffness keeps the session's ratio to the normal one.

Friction is measured between two things. object.yaml gives it against a hand, so towards the table
an object's own is left out and sim.table_friction_* hold. */

#include "core/physics/contact.h"
#include "core/physics/sim_config.h"
#include "core/shape/surface_material.h"

namespace graspbench {

ContactMaterial CombineSurfaces(const SurfaceMaterial& a, const SurfaceMaterial& b,
                                const SimConfig& config);

/** The table: sim.table_friction_*, no torsion, else as the session has it. */
SurfaceMaterial MakeTableSurface(const SimConfig& config);

}  // namespace graspbench
