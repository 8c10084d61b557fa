#include "core/shape/exposed_surface.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/shape/line_crossings.h"

namespace graspbench {
namespace {

constexpr double kSameSurface = 1e-7;  // [m] sheets closer than this touch: nothing is between them

class Exposer {
 public:
  Exposer(const TriMesh& mesh, double resolution)
      : lines_{LineCrossings(mesh, 0), LineCrossings(mesh, 1), LineCrossings(mesh, 2)},
        resolution_(resolution) {}

  void Add(const std::array<Eigen::Vector3d, 3>& corners) {
    const Eigen::Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    int num_exposed = IsExposed(middle, normal) ? 1 : 0;
    for (const Eigen::Vector3d& corner : corners) {
      if (IsExposed(0.9 * corner + 0.1 * middle, normal)) ++num_exposed;
    }
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
      longest = std::max(longest, (corners[(k + 1) % 3] - corners[k]).norm());
    }
    if (num_exposed == 4 || (num_exposed > 0 && longest < resolution_)) {
      const int first = exposed_.num_vertices();
      exposed_.vertices.insert(exposed_.vertices.end(), corners.begin(), corners.end());
      exposed_.triangles.emplace_back(first, first + 1, first + 2);
    } else if (num_exposed > 0) {
      const Eigen::Vector3d &a = corners[0], &b = corners[1], &c = corners[2];
      const Eigen::Vector3d ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
      for (const auto& part :
           {std::array<Eigen::Vector3d, 3>{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) {
        Add(part);
      }
    }
  }
  TriMesh TakeMesh() { return std::move(exposed_); }

 private:
  // Is the solid on one side of this point of the surface only? Seen along the axis closest to the normal.
  bool IsExposed(const Eigen::Vector3d& p, const Eigen::Vector3d& normal) {
    Eigen::Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    lines_[axis].Find(p[(axis + 1) % 3], p[(axis + 2) % 3], crossings_);
    int below = 0, above = 0;
    for (const LineCrossings::Crossing& crossing : crossings_) {
      if (crossing.at < p[axis] - kSameSurface) below += crossing.winding;
      if (crossing.at < p[axis] + kSameSurface) above += crossing.winding;
    }
    return (below >= 1) != (above >= 1);
  }

  std::array<LineCrossings, 3> lines_;
  double resolution_;
  std::vector<LineCrossings::Crossing> crossings_;
  TriMesh exposed_;
};

}  // namespace

TriMesh FindExposedSurface(const TriMesh& mesh, double resolution) {
  Exposer exposer(mesh, resolution);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    exposer.Add({mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]});
  }
  return exposer.TakeMesh();
}

}  // namespace graspbench
