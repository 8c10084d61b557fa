#pragma once
/** @file
Mass of a homogeneous solid, as MuJoCo gives it to the geoms of a body without `<inertial>`. */

#include "core/hand/import/foreign_hand.h"
#include "core/shape/mass_properties.h"

namespace graspbench {

/** Closed forms; a capsule has round ends. In the link's frame.
@param mesh  in the link's frame, of a mesh only: the volume that it encloses.
@returns no mass where there is no volume. @pre the shape's extent is positive, `weight` is given. */
MassProperties CalcGeomMass(const ForeignShape& shape, const TriMesh& mesh);

/** Two solids in the same frame as one. */
MassProperties AddMass(const MassProperties& a, const MassProperties& b);

}  // namespace graspbench
