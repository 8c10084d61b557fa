#pragma once
/** @file
Signed distance to a closed mesh, sampled on a grid: the contact solver asks it hundreds of times a
step, so a query costs one trilinear interpolation.

    phi(p) = +- min over the surface of |p - s|,  positive outside

Every node is exact: nearest triangle by a tree of boxes, sign by the winding number
(line_crossings.h), so parts that overlap or touch are one body; inside such a body the surfaces
that lie in it do not count, to within a cell where they come out of it. Between nodes the error is
that of trilinear interpolation, O(cell^2 * curvature); next to a sharp edge it is up to about half
a cell, so query a few millimetres away from the surface (sphere centres), where the field is
smooth. */

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

class SignedDistanceField {
 public:
  static constexpr double kMargin = 0.015;    ///< [m] the grid reaches this far beyond the mesh
  static constexpr double kMinCell = 0.0005;  ///< [m]
  static constexpr int kMaxNodes = 500000;    ///< sets the cell of all but the smallest objects

  /** @pre every edge has as many triangles in either direction (core/shape/repair/mesh_check.h).
  Cells are cubes. Costs about half a second for 5,000 triangles. */
  static SignedDistanceField Build(const TriMesh& mesh);

  /** Build, or read what an earlier call kept (core/base/files/kept.h) under the mesh's hash in
  `cache_folder`. The result is the same bits either way. */
  static std::shared_ptr<const SignedDistanceField> LoadOrBuild(
      const TriMesh& mesh, const std::filesystem::path& cache_folder);

  /** What LoadOrBuild would read; nothing when it would build. */
  static std::shared_ptr<const SignedDistanceField> LoadCached(
      const TriMesh& mesh, const std::filesystem::path& cache_folder);

  struct Sample {
    double distance = 0.0;                                ///< [m]
    Eigen::Vector3d gradient = Eigen::Vector3d::UnitZ();  ///< unit, points away from the object
  };
  /** The interpolant, and the gradient by central differences at the nodes, interpolated likewise
  and made unit: continuous, where the interpolant's own jumps from cell to cell. Outside the grid:
  a lower bound of the distance, gradient from the nearest grid point. */
  Sample Query(const Eigen::Vector3d& p_O) const;
  /** The distance alone: a sixth of the work. */
  double CalcDistance(const Eigen::Vector3d& p_O) const { return CalcDistance(FindCell(p_O)); }

  /** Where a point lies in the grid, for those who want its gradient only when it is near. */
  struct Cell {
    Eigen::Vector3i node;   ///< its lowest corner
    Eigen::Vector3d share;  ///< position in the cell, in [0, 1]
    double beyond;          ///< distance from the grid [m]
  };
  Cell FindCell(const Eigen::Vector3d& p_O) const;
  double CalcDistance(const Cell& cell) const;
  Eigen::Vector3d CalcGradient(const Cell& cell) const;

  const Eigen::Vector3d& lower() const { return lower_; }  ///< corner of node (0,0,0), in O [m]
  double cell() const { return cell_; }                    ///< [m]
  const Eigen::Vector3i& num_nodes() const { return num_nodes_; }

 private:
  size_t FindIndex(const Eigen::Vector3i& node) const {
    return node.x() + num_nodes_.x() * (node.y() + static_cast<size_t>(num_nodes_.y()) * node.z());
  }
  void CalcValues(const TriMesh& mesh, const std::vector<bool>& is_inside, bool only_inside);
  std::string FormatCache() const;
  // False, and the field is of no use, when the bytes are not those of a whole field.
  bool ParseCache(const std::string& bytes);
  double Interpolate(const Eigen::Vector3i& node, const Eigen::Vector3d& share) const;

  Eigen::Vector3d lower_ = Eigen::Vector3d::Zero();
  double cell_ = 0.0;
  Eigen::Vector3i num_nodes_ = Eigen::Vector3i::Zero();
  std::vector<float> values_;  ///< (nx * ny * nz), x fastest [m]
};

}  // namespace graspbench
