#pragma once
/** @file
Collision shapes as solids: distance, and the mass of their union. A cylinder counts as the capsule
that contact takes it for (core/hand/contact_shape.h), unless it is a disc. */

#include <Eigen/Geometry>
#include <vector>

#include "core/hand/contact_shape.h"
#include "core/hand/import/foreign_hand.h"
#include "core/shape/mass_properties.h"

namespace graspbench {

/** Signed distance of a point of the link from the shape's surface, negative inside [m]. */
double CalcDistance(const CollisionShape& shape, const Eigen::Vector3d& p_L);

/** The nearest of the shapes of one link; 1 m without any. */
double CalcLinkDistance(const std::vector<CollisionShape>& shapes, int link,
                        const Eigen::Vector3d& p_L);

std::vector<CollisionShape> ListShapesOf(const std::vector<CollisionShape>& shapes, int link);

/** Where a ray from a point of the link leaves its shapes for good. */
Eigen::Vector3d FindSurface(const std::vector<CollisionShape>& shapes, int link,
                            const Eigen::Vector3d& from, const Eigen::Vector3d& direction);

/** Bounds of the shapes in the link's frame. */
Eigen::AlignedBox3d CalcBounds(const std::vector<CollisionShape>& shapes);

/** Of the union of the shapes of one link, homogeneous, on a grid of about 40 cells along the
longest side: volume within some per cent. @pre at least one shape. */
MassProperties CalcUnionMass(const std::vector<CollisionShape>& shapes, double density);

/** Mass of a homogeneous solid, as MuJoCo gives it to the geoms of a body without `<inertial>`.
Closed forms; a capsule has round ends. In the link's frame. @param mesh  in the link's frame, of a
mesh only: the volume that it encloses. @returns no mass where there is no volume. @pre the shape's
extent is positive, `weight` is given. */
MassProperties CalcGeomMass(const ForeignShape& shape, const TriMesh& mesh);

/** Two solids in the same frame as one. */
MassProperties AddMass(const MassProperties& a, const MassProperties& b);

}  // namespace graspbench
