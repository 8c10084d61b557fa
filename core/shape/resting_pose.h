#pragma once
/** @file
Resting pose of an object that is placed on the table in the orientation of its mesh. It rolls over
its outermost vertices, from edge to edge, until its centre of mass is above its support polygon.

Let p_i be the vertices, z up, and c the centre of mass. S is the convex hull, seen from above, of
those p_i that touch the table. The object rests if c is above S. Otherwise it pivots about the edge
(or corner) of S nearest to c, by the smallest angle at which another vertex reaches the table. Each
pivot lowers c, so no position recurs. The model has no sliding and no momentum: an object that
falls fast may come to rest elsewhere. A surface that the simulation treats as round
(core/physics/table_support.h) is the polyhedron of its mesh here. */

#include <Eigen/Core>

#include "core/shape/grasp_object.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Returns R_RO, the rotation of the mesh from its own orientation, z up, to its resting
orientation. It is exactly the identity if the angle is below 0.01 mrad.
@param p_OOcm  centre of mass, inside the convex hull of the mesh [m].  @pre finite vertices. */
Eigen::Matrix3d FindRestingRotation(const TriMesh& mesh, const Eigen::Vector3d& p_OOcm);

/** Rotates an object to its resting pose: mesh, bounding box, size and mass properties. `field`
must not exist yet. An object that already rests is unchanged, bit for bit. */
void LayDown(GraspObject& object);

}  // namespace graspbench
