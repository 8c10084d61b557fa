#pragma once
/** @file
The solid that the meshes of a link stand for, open or overlapping ones too, as a boundary of points.

On a grid of cells of size h, with a closing ball of radius 3 mm:

- free: centres of balls that come from far away and touch no mesh;
- outside: nearer than 3 mm to a free centre, and not enclosed;
- enclosed: two of the three lines along the axes through the cell wind around it (a winding number
  other than 0, and 0 in all, so a line through an opening does not count).

The rest is the solid. Its boundary is the part of the meshes with the outside on one side of it, and
a membrane where the closing ball spans a hole.

h is a 120th of the longest side, within 0.6 and 1.5 mm; points of the meshes lie 0.5 to 1.2 mm
apart and on the meshes, those of a membrane within h. */

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "core/shape/tri_mesh.h"
#include "core/shape/triangle_tree.h"

namespace graspbench {

class LinkSolid {
 public:
  struct BoundaryPoint {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();     ///< [m]
    Eigen::Vector3d nhat = Eigen::Vector3d::Zero();  ///< outwards
    bool is_membrane = false;
  };

  /** @param meshes  of one link in its frame [m]. @pre one has a triangle; valid indices, finite
  vertices within 2 m. */
  explicit LinkSolid(const std::vector<TriMesh>& meshes);

  const std::vector<BoundaryPoint>& boundary() const { return boundary_; }
  /** Every k-th point of the boundary, about as many as asked for. */
  std::vector<BoundaryPoint> ListSpread(size_t num_points) const;
  bool IsOutside(const Eigen::Vector3d& p) const;
  /** How far a point lies outside: its distance from the meshes or the membrane, 0 behind the nearest
  boundary point [m]. */
  double CalcOutside(const Eigen::Vector3d& p) const;

 private:
  void FindOutside(const std::vector<TriMesh>& meshes);
  void AddMeshPoints(const std::vector<TriMesh>& meshes);
  void AddMembrane();
  void SortIntoBins();
  Eigen::Vector3i FindCell(const Eigen::Vector3d& p) const;
  size_t IndexOf(const Eigen::Vector3i& cell) const;
  bool Holds(const Eigen::Vector3i& cell) const;
  Eigen::Vector3d CentreOf(const Eigen::Vector3i& cell) const;

  double size_ = 0.0;  // h
  Eigen::Vector3d lower_ = Eigen::Vector3d::Zero();
  Eigen::Vector3i num_ = Eigen::Vector3i::Zero();
  std::vector<uint8_t> is_outside_;  // by cell
  std::vector<float> from_mesh_;     // by cell, squared, in cells
  std::vector<TriangleTree> trees_;  // of the meshes
  std::vector<BoundaryPoint> boundary_;
  Eigen::Vector3i num_bins_ = Eigen::Vector3i::Zero();
  std::vector<std::vector<int>> bins_;  // of boundary points
};

}  // namespace graspbench
