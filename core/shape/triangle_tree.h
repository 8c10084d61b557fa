#pragma once
/** @file
A tree of bounding boxes over a mesh's triangles: the nearest triangle to a point, and all triangles
near a box, in logarithmic time. */

#include <Eigen/Geometry>
#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

class TriangleTree {
 public:
  /** @pre at least one triangle, valid indices, finite vertices. Keeps copies of the corners. */
  explicit TriangleTree(const TriMesh& mesh);

  /** Feature of the triangle on which the nearest point lies; it decides which normal determines
  the side. */
  enum class Feature { kFace, kEdge01, kEdge12, kEdge20, kVertex0, kVertex1, kVertex2 };
  struct Nearest {
    int triangle = -1;  ///< index into the mesh's triangles
    Feature feature = Feature::kFace;
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    double squared_distance = 0.0;  ///< [m^2]
  };
  /** Finds the nearest triangle. `hint` is any triangle of the mesh; a near one speeds up the
  search. */
  Nearest FindNearest(const Eigen::Vector3d& p, int hint = 0) const;

  /** Appends every triangle whose bounding box intersects `box`, in the tree's order. */
  void FindNear(const Eigen::AlignedBox3d& box, std::vector<int>& triangles) const;

 private:
  struct Corners {
    Eigen::Vector3d a, b, c;
  };
  // The children of an inner node are `first` and `first + 1`; a leaf contains triangles
  // order_[first .. first + count).
  struct Node {
    Eigen::AlignedBox3d box;
    int first = 0;
    int count = 0;  // 0: inner node
  };
  void Split(int node, int begin, int end, const std::vector<Eigen::Vector3d>& centres);
  static Nearest FindNearestOn(const Corners& t, const Eigen::Vector3d& p);

  std::vector<Node> nodes_;
  std::vector<int> order_;        // triangle indices, leaf by leaf
  std::vector<Corners> corners_;  // in the order of order_
  std::vector<int> slot_;         // triangle index -> position in order_
};

}  // namespace graspbench
