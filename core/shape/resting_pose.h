#pragma once
/** @file
How an object rests on the table when it is set down as its mesh lies: it rolls over its outermost
vertices, from edge to edge, until its centre of mass stands over the polygon on which it stands.

With p_i the vertices at rest, z up, c the centre of mass and S the convex hull of those p_i that
touch the table, seen from above, it rests when c lies over S. Else it pivots about the edge (or
corner) of S that is nearest to c, by the smallest angle at which another vertex meets the table;
each pivot lowers c, so that no position comes twice. Nothing slides, nothing swings on
beyond a stable position: a fast fall may end elsewhere. A surface that the simulation takes for
round (core/physics/table_support.h) is the polyhedron of its mesh here. */

#include <Eigen/Core>

#include "core/shape/grasp_object.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

/** R_RO: turns the mesh from how it lies, z up, to how it rests; the identity, to the bit, when it
turns by less than 0.01 mrad.
@param p_OOcm  centre of mass, inside the convex hull of the mesh [m].  @pre finite vertices. */
Eigen::Matrix3d FindRestingRotation(const TriMesh& mesh, const Eigen::Vector3d& p_OOcm);

/** Turns an object to how it rests: its mesh, box, sizes and mass properties; `field` must not be
made yet. An object that rests as it lies stays as it is, to the bit. */
void LayDown(GraspObject& object);

}  // namespace graspbench
