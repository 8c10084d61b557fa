#pragma once
/** @file
Intersections of a mesh with lines parallel to an axis, which give the winding number of the surface
around each point of a line: it increases by one at every entry and decreases by one at every exit.
A point belongs to the solid if the winding number is at least one. So overlapping parts are one
body, and a shell that faces inwards makes a cavity. */

#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {

class LineCrossings {
 public:
  /** @pre valid indices, finite vertices. Keeps a pointer to the mesh. */
  LineCrossings(const TriMesh& mesh, int axis);

  struct Crossing {
    double at = 0.0;  ///< position along the axis [m]
    int winding = 0;  ///< +1 into the solid, -1 out of it, in the axis direction
  };
  /** Finds the crossings of one line, ordered along the axis. (u, v) are the other two coordinates
  in cyclic order (axis 2: x, y). Lines through an edge or a corner are counted consistently, unless
  they miss it by less than the rounding error. */
  void Find(double u, double v, std::vector<Crossing>& crossings) const;

 private:
  Eigen::Vector2d Flatten(int vertex) const;
  bool IsLeftOf(int from, int to, double u, double v) const;
  Eigen::Vector2i FindCell(const Eigen::Vector2d& p) const;

  const TriMesh* mesh_;
  int axis_;
  Eigen::Vector2d lower_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d cell_ = Eigen::Vector2d::Ones();
  int num_cells_ = 1;           // per side
  std::vector<int> first_;      // of each cell in triangles_, and one past the last
  std::vector<int> triangles_;  // by cell
};

}  // namespace graspbench
