#pragma once
/** @file
The solid that the meshes of a link represent, also if they are open or overlap, as boundary points.

Points on a grid of cells of size h are classified as:

- free: centres of balls of 1.5 mm that can come from far away without touching a mesh;
- enclosed: at least two of the three axis-parallel lines through the point wind around it. The
  winding number at the point is not 0, but that of the whole line is, so lines through an opening
  do not count;
- outside: within 1.5 mm of a free centre, and not enclosed.

All other points form the solid. Its boundary consists of the parts of the meshes that have the
outside on one side, and of a membrane where the solid ends away from the meshes. A boundary point
is open if a probe of 5 mm from far away can rest on it.

h is a 200th of the longest side, at least 0.7 mm. Points on the meshes are 0.5 to 1 mm apart, more
on surfaces above 0.06 m^2, and lie exactly on the meshes. Points of a membrane are accurate to
h. */

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
    Eigen::Vector3d nhat = Eigen::Vector3d::Zero();  ///< unit outward normal
    bool is_membrane = false;
  };

  /** @param meshes  meshes of one link, in its frame [m]. @pre one has a triangle; indices are
  valid; vertices are finite and within 2 m. */
  explicit LinkSolid(const std::vector<TriMesh>& meshes);
  LinkSolid(const LinkSolid&) = delete;
  LinkSolid& operator=(const LinkSolid&) = delete;

  const std::vector<BoundaryPoint>& boundary() const { return boundary_; }
  /** Returns every k-th boundary point that is open, with k chosen to test `num_points` of them. */
  std::vector<BoundaryPoint> ListOpen(size_t num_points) const;
  /** Whether the cell that contains the point is outside. */
  bool IsOutside(const Eigen::Vector3d& p) const;
  /** Distance of an outside point from the meshes or the membrane; 0 in the solid [m]. Exact except
  in gaps that the ball of 1.5 mm cannot enter. */
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
  // By cell; distances are squared, in units of a cell.
  std::vector<uint8_t> is_outside_, is_probe_;
  std::vector<float> from_mesh_, from_free_;
  std::vector<TriMesh> meshes_;  // those with a triangle
  std::vector<TriangleTree> trees_;
  std::vector<std::array<LineCrossings, 3>> lines_;  // along each axis
  std::vector<BoundaryPoint> boundary_;
  std::vector<Eigen::Vector3d> membrane_;
};

/** By link; nullptr if the link has no triangle. */
using LinkSolids = std::vector<std::unique_ptr<LinkSolid>>;
LinkSolids MakeLinkSolids(const std::vector<std::vector<TriMesh>>& meshes);

}  // namespace graspbench
