#pragma once
/** @file
Collision shapes as solids: distance, and mass of their union. A cylinder is treated as the capsule
that is used for contact (core/hand/contact_shape.h), unless it is a disc. */

#include <Eigen/Geometry>
#include <vector>

#include "core/hand/contact_shape.h"
#include "core/hand/import/foreign_hand.h"
#include "core/shape/mass_properties.h"

namespace graspbench {

/** Signed distance of a point of the link from the shape's surface; negative inside [m]. */
double CalcDistance(const CollisionShape& shape, const Eigen::Vector3d& p_L);

/** Signed distance from the nearest shape of one link; 1 m if it has none. */
double CalcLinkDistance(const std::vector<CollisionShape>& shapes, int link,
                        const Eigen::Vector3d& p_L);

std::vector<CollisionShape> ListShapesOf(const std::vector<CollisionShape>& shapes, int link);

/** Point where a ray from a point of the link finally leaves its shapes. */
Eigen::Vector3d FindSurface(const std::vector<CollisionShape>& shapes, int link,
                            const Eigen::Vector3d& from, const Eigen::Vector3d& direction);

/** Bounds of the shapes in the link's frame. */
Eigen::AlignedBox3d CalcBounds(const std::vector<CollisionShape>& shapes);

/** Mass properties of the homogeneous union of the shapes of one link, on a grid of about 40 cells
along the longest side; its volume is accurate to some per cent. @pre at least one shape. */
MassProperties CalcUnionMass(const std::vector<CollisionShape>& shapes, double density);

/** Mass properties of a homogeneous solid, as MuJoCo computes them for the geoms of a body without
`<inertial>`, in closed form and in the link's frame; a capsule has round ends. @param mesh  for a
mesh only: the enclosing surface, in the link's frame. @returns no mass if there is no volume.
@pre the shape's extent is positive, and `weight` is set. */
MassProperties CalcGeomMass(const ForeignShape& shape, const TriMesh& mesh);

/** Combines two solids in the same frame. */
MassProperties AddMass(const MassProperties& a, const MassProperties& b);

}  // namespace graspbench
