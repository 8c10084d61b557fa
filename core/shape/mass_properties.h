#pragma once
/** @file
Mass, centre of mass and inertia of a homogeneous closed mesh by the divergence theorem
(Mirtich 1996; signed tetrahedra against the origin). */

#include "core/shape/tri_mesh.h"

namespace graspbench {

/** What signed tetrahedra count wrongly: space that a surface winds around twice, where parts of a
mesh overlap or a sheet folds over, or less than once, in a pocket turned inside out. With w the
winding number, the integral of (w - [w >= 1]) over all space; subtracted from the tetrahedra's sums
it leaves those of the solid.

Integrals over the wrongly counted space, about the first corner R of the mesh's first triangle. */
struct Overlap {
  double volume = 0.0;                               ///< [m^3], signed
  double absolute_volume = 0.0;                      ///< [m^3], where signs do not cancel
  double inverted_volume = 0.0;                      ///< [m^3], where the surface winds backwards
  Eigen::Vector3d first = Eigen::Vector3d::Zero();   ///< of p_RP [m^4]
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();  ///< of p_RP p_RP^T [m^5]
};

/** By 317,811 lines along z: exact along each, across them the rule of Fibonacci's lattice, which
spreads them most evenly and along no edge of a box (Niederreiter 1992, ch. 5). Off by some 1e-5 of
the bounding box's area times the height of the overlap; none without overlap. About half a second.
@pre every edge has as many triangles in either direction. */
Overlap CalcOverlap(const TriMesh& mesh);

struct MassProperties {
  double mass = 0.0;                                 ///< [kg]
  Eigen::Vector3d p_OOcm = Eigen::Vector3d::Zero();  ///< centre of mass, in O [m]
  Eigen::Matrix3d I_OOcm = Eigen::Matrix3d::Zero();  ///< about Ocm, axes of O [kg m^2]
};

/** Of one triangle [m^2]. */
double CalcArea(const TriMesh& mesh, const Eigen::Vector3i& triangle);

/** Signed volume [m^3]; negative when the mesh is inside out. */
double CalcVolume(const TriMesh& mesh);

/** The inertia is that of the homogeneous solid of this mass.
@param overlap  of the mesh (CalcOverlap), where its parts overlap: counted once.
@pre closed, positive volume. */
MassProperties CalcSolidMassProperties(const TriMesh& mesh, double mass,
                                       const Overlap& overlap = {});

}  // namespace graspbench
