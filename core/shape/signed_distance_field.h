#pragma once
/** @file
Signed distance to a closed mesh, sampled on a grid. The contact solver queries it hundreds of times
per step, so a query costs one trilinear interpolation.

    phi(p) = +- min over the surface of |p - s|,  positive outside

Every node is exact: the nearest triangle comes from a tree of boxes, the sign from the winding
number (line_crossings.h). So parts that overlap or touch are one body; surfaces inside such a body
are ignored, to within a cell of where they emerge. Between nodes the error is that of trilinear
interpolation, O(cell^2 * curvature). Next to a sharp edge it reaches about half a cell. So query a
few millimetres away from the surface (sphere centres), where the field is smooth. */

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
  static constexpr double kMargin = 0.015;    ///< margin of the grid around the mesh [m]
  static constexpr double kMinCell = 0.0005;  ///< [m]
  static constexpr int kMaxNodes = 500000;  ///< sets the cell size of all but the smallest objects

  /** Builds the field; takes about half a second for 5,000 triangles. Cells are cubes.
  @pre every edge has as many triangles in either direction (core/shape/repair/mesh_check.h). */
  static SignedDistanceField Build(const TriMesh& mesh);

  /** Builds the field, or reads the one that an earlier call stored in `cache_folder` under the
  mesh's hash (core/base/files/kept.h). Both give the same bits. */
  static std::shared_ptr<const SignedDistanceField> LoadOrBuild(
      const TriMesh& mesh, const std::filesystem::path& cache_folder);

  /** Returns the stored field, or null if LoadOrBuild would have to build it. */
  static std::shared_ptr<const SignedDistanceField> LoadCached(
      const TriMesh& mesh, const std::filesystem::path& cache_folder);

  struct Sample {
    double distance = 0.0;                                ///< [m]
    Eigen::Vector3d gradient = Eigen::Vector3d::UnitZ();  ///< unit vector, away from the object
  };
  /** Returns the interpolated distance and gradient. The gradient comes from central differences at
  the nodes, interpolated and normalised. It is continuous, whereas the interpolant's own gradient
  jumps between cells. Outside the grid the distance is a lower bound, and the gradient is that of
  the nearest grid point. */
  Sample Query(const Eigen::Vector3d& p_O) const;
  /** Returns only the distance, at a sixth of the cost. */
  double CalcDistance(const Eigen::Vector3d& p_O) const { return CalcDistance(FindCell(p_O)); }

  /** Position of a point in the grid, for callers that need the gradient only near the surface. */
  struct Cell {
    Eigen::Vector3i node;   ///< lowest corner of the cell
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
  // Returns false, and leaves the field unusable, unless the bytes are a complete field.
  bool ParseCache(const std::string& bytes);
  double Interpolate(const Eigen::Vector3i& node, const Eigen::Vector3d& share) const;

  Eigen::Vector3d lower_ = Eigen::Vector3d::Zero();
  double cell_ = 0.0;
  Eigen::Vector3i num_nodes_ = Eigen::Vector3i::Zero();
  std::vector<float> values_;  ///< (nx * ny * nz), x fastest [m]
};

}  // namespace graspbench
