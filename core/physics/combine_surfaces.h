#pragma once
/** @file
The constants of a contact from the surfaces of its two sides: one rule for every pair.

    given on no side      stiffness: that of the session; no friction, no torsion
    given on one side     its value
    given on both sides   as springs in series, k = kA kB / (kA + kB)
                          mu = 2 muA muB / (muA + muB)
                          r = the smaller: the smaller patch of contact
                          tau = the longer one; given on no side kContactRelaxationTime

A soft pad stands in series with that spring, and its patch gives the torsion radius, if a side says
one at most that (pad_contact.h).

This is Simbody's rule for compliant contact (CompliantContactSubsystem, Sherman 2011), with what
was left out read as "the other side decides". The tangential stiffness keeps the session's ratio to
the normal one.

Friction is measured between two things. object.yaml gives it against a hand, so towards the table
an object's own is left out and sim.table_friction_* hold. */

#include "core/physics/contact.h"
#include "core/physics/sim_config.h"
#include "core/shape/surface_material.h"

namespace graspbench {

ContactMaterial CombineSurfaces(const SurfaceMaterial& a, const SurfaceMaterial& b,
                                const SimConfig& config);

/** A link towards another one: sim.hand_friction_* where it says nothing of its own, and no
torsion, which is that of pads on a smooth object. */
SurfaceMaterial MakeSelfSurface(const SurfaceMaterial& link, const SimConfig& config);

/** The table: sim.table_friction_*, no torsion, else as the session has it. */
SurfaceMaterial MakeTableSurface(const SimConfig& config);

}  // namespace graspbench
