#pragma once
/** @file
The solid that the meshes of a link stand for, open or overlapping ones too, as boundary points.

On a grid of cells of size h:

- free: centres of balls of 1.5 mm that come from far away and touch no mesh;
- enclosed: two of the three lines along the axes through a point wind around it (a winding number
  other than 0, and 0 in all, so a line through an opening does not count);
- outside: nearer than 1.5 mm to a free centre, and not enclosed.

The rest is the solid. Its boundary is the part of the meshes with the outside on one side of it,
and a membrane where the solid ends away from the meshes. A boundary point is open where
a probe of 5 mm that comes from far away rests on it.

h is a 200th of the longest side, at least 0.6 mm; points of the meshes lie 0.5 to 1 mm apart and on
the meshes, those of a membrane within h. */

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/shape/line_crossings.h"
#include "core/shape/tri_mesh.h"
#include "core/shape/triangle_tree.h"

namespace graspbench {

inline constexpr double kProbeRadius = 0.005;  ///< [m]

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
  LinkSolid(const LinkSolid&) = delete;
  LinkSolid& operator=(const LinkSolid&) = delete;

  const std::vector<BoundaryPoint>& boundary() const { return boundary_; }
  /** Every k-th open point of the boundary, about as many as asked for. */
  std::vector<BoundaryPoint> ListOpen(size_t num_points) const;
  /** Of the cell that holds the point. */
  bool IsOutside(const Eigen::Vector3d& p) const;
  /** How far a point lies outside: its distance from the meshes or the membrane; 0 in the solid
  [m]. Exact but for what the closing ball fills: within 1.5 mm of two meshes. */
  double CalcOutside(const Eigen::Vector3d& p) const;

 private:
  bool IsEnclosed(const Eigen::Vector3d& p) const;
  double CalcMeshDistance(const Eigen::Vector3d& p) const;
  bool IsNearFree(const Eigen::Vector3d& p) const;
  bool IsOpen(const BoundaryPoint& point) const;
  void FindOutside();
  std::vector<uint8_t> FindReached(double radius) const;
  void AddMeshPoints();
  void AddMembrane();
  Eigen::Vector3i FindCell(const Eigen::Vector3d& p) const;
  size_t IndexOf(const Eigen::Vector3i& cell) const;
  bool Holds(const Eigen::Vector3i& cell) const;
  Eigen::Vector3d CentreOf(const Eigen::Vector3i& cell) const;

  double size_ = 0.0;  // h
  Eigen::Vector3d lower_ = Eigen::Vector3d::Zero();
  Eigen::Vector3i num_ = Eigen::Vector3i::Zero();
  // By cell; distances are squared, in cells.
  std::vector<uint8_t> is_outside_, is_probe_;
  std::vector<float> from_mesh_, from_free_;
  std::vector<TriMesh> meshes_;  // with a triangle
  std::vector<TriangleTree> trees_;
  std::vector<std::array<LineCrossings, 3>> lines_;  // along each axis
  std::vector<BoundaryPoint> boundary_;
  std::vector<Eigen::Vector3d> membrane_;
};

/** By link; nullptr: it has no triangle. */
using LinkSolids = std::vector<std::unique_ptr<LinkSolid>>;
LinkSolids MakeLinkSolids(const std::vector<std::vector<TriMesh>>& meshes);

}  // namespace graspbench
