#pragma once
/** @file
Mass, centre of mass and inertia of a homogeneous closed mesh by the divergence theorem (Mirtich
1996; signed tetrahedra with the origin as apex). */

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** Correction for space that signed tetrahedra count wrongly. The surface winds twice around space
where parts of a mesh overlap or a sheet folds over, and less than once around a pocket that is
turned inside out. With the winding number w, the correction is the integral of (w - [w >= 1]) over
all space. Subtracted from the sums over the tetrahedra, it leaves those of the solid.

The integrals are about R, the first corner of the mesh's first triangle. */
struct Overlap {
  double volume = 0.0;                              ///< [m^3], signed
  double absolute_volume = 0.0;                     ///< [m^3], without cancellation of signs
  double inverted_volume = 0.0;                     ///< [m^3], where the winding number is negative
  Eigen::Vector3d first = Eigen::Vector3d::Zero();  ///< of p_RP [m^4]
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< of p_RP p_RP^T [m^5]
};

/** Integrates the overlap along 317,811 lines parallel to z, exactly along each line. Across the
lines it uses the Fibonacci lattice rule, which spreads them most evenly and along no edge of a box
(Niederreiter 1992, ch. 5). The error is some 1e-5 of the bounding box's area times the height of
the overlap, and zero without overlap. Takes about half a second.
@pre every edge has as many triangles in either direction. */
Overlap CalcOverlap(const TriMesh& mesh);

struct MassProperties {
  double mass = 0.0;                                 ///< [kg]
  Eigen::Vector3d p_OOcm = Eigen::Vector3d::Zero();  ///< centre of mass [m]
  Eigen::Matrix3d I_OOcm = Eigen::Matrix3d::Zero();  ///< about Ocm, axes of O [kg m^2]
};

/** Returns the area of one triangle [m^2]. */
double CalcArea(const TriMesh& mesh, const Eigen::Vector3i& triangle);

/** Returns the signed volume [m^3]; negative if the mesh is inside out. */
double CalcVolume(const TriMesh& mesh);

/** Computes the mass properties of the homogeneous solid with this mass.
@param overlap  of the mesh (CalcOverlap) if its parts overlap; this space is counted once.
@pre closed, positive volume. */
MassProperties CalcSolidMassProperties(const TriMesh& mesh, double mass,
                                       const Overlap& overlap = {});

}  // namespace graspbench
