#pragma once
/** @file
Mass, centre of mass and inertia of a homogeneous closed mesh by the divergence theorem
(Mirtich 1996; signed tetrahedra against the origin). */

#include "core/shape/repair/overlap.h"
#include "core/shape/tri_mesh.h"

namespace graspbench {

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
