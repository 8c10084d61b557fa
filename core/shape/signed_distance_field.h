#pragma once
/** @file
Signed distance to a closed mesh, sampled on a grid: the contact solver asks it hundreds of times a
step, so a query costs one trilinear interpolation.

    phi(p) = +- min over the surface of |p - s|,  positive outside

Nodes within `kExactBand` of the surface are exact (nearest triangle by a bounding-volume tree, sign
by angle-weighted normals, Baerentzen and Aanaes 2005); farther nodes carry the nearest sign and a
lower bound. Between nodes the error is that of trilinear interpolation, O(cell^2 * curvature); next
to a sharp edge it is up to about half a cell, so query a few millimetres away from the surface
(sphere centres), where the field is smooth. */

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

class SignedDistanceField {
 public:
  static constexpr double kExactBand = 0.015;  ///< [m] nodes nearer than this are exact
  static constexpr int kMaxCells = 96;         ///< along the longest side

  /** @pre the mesh is closed (core/shape/mesh_check.h). The grid covers the bounding box plus
  kExactBand; cells are cubes. Costs about a second for 20,000 triangles. */
  static SignedDistanceField Build(const TriMesh& mesh);

  /** Build, or read what an earlier call stored under the mesh's hash in `cache_folder`. A damaged
  or foreign cache file is rebuilt. The result is the same bits either way. */
  static std::shared_ptr<const SignedDistanceField> LoadOrBuild(
      const TriMesh& mesh, const std::filesystem::path& cache_folder);

  struct Sample {
    double distance = 0.0;                                ///< [m]
    Eigen::Vector3d gradient = Eigen::Vector3d::UnitZ();  ///< unit, points away from the object
  };
  /** Outside the grid: a lower bound of the distance, gradient from the nearest grid point. */
  Sample Query(const Eigen::Vector3d& p_O) const;

  const Eigen::Vector3d& lower() const { return lower_; }  ///< corner of node (0,0,0), in O [m]
  double cell() const { return cell_; }                    ///< [m]
  const Eigen::Vector3i& num_nodes() const { return num_nodes_; }

 private:
  Eigen::Vector3d lower_ = Eigen::Vector3d::Zero();
  double cell_ = 0.0;
  Eigen::Vector3i num_nodes_ = Eigen::Vector3i::Zero();
  std::vector<float> values_;  ///< (nx * ny * nz), x fastest [m]
};

}  // namespace graspbench
