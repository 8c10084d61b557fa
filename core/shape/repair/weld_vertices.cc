#include "core/shape/repair/weld_vertices.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace graspbench {
namespace {

using Key = std::array<int64_t, 3>;
struct KeyHash {
  size_t operator()(const Key& key) const {
    uint64_t hash = 0;
    for (const int64_t k : key) {
      hash = (hash ^ static_cast<uint64_t>(k)) * 0x9E3779B97F4A7C15ull;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

// Cells of one tolerance; whoever lies within it is in the same cell or in one of 26 neighbours.
class VertexGrid {
 public:
  explicit VertexGrid(double tolerance) : tolerance_(tolerance) {}

  // Index of a stored point within the tolerance, the earliest one; -1: none.
  int FindNear(const Eigen::Vector3d& p, const std::vector<Eigen::Vector3d>& stored) const {
    const Key centre = KeyOf(p);
    int found = -1;
    for (int64_t dx = -1; dx <= 1; ++dx) {
      for (int64_t dy = -1; dy <= 1; ++dy) {
        for (int64_t dz = -1; dz <= 1; ++dz) {
          const auto cell = cells_.find({centre[0] + dx, centre[1] + dy, centre[2] + dz});
          if (cell == cells_.end()) continue;
          for (const int i : cell->second) {
            if ((found < 0 || i < found) && (stored[i] - p).norm() <= tolerance_) found = i;
          }
        }
      }
    }
    return found;
  }
  void Store(const Eigen::Vector3d& p, int index) { cells_[KeyOf(p)].push_back(index); }

 private:
  Key KeyOf(const Eigen::Vector3d& p) const {
    // Far out the cells are clamped together: slower, not wrong.
    const auto cell = [&](double x) {
      return static_cast<int64_t>(std::floor(std::fmin(std::fmax(x / tolerance_, -9e15), 9e15)));
    };
    return {cell(p.x()), cell(p.y()), cell(p.z())};
  }
  double tolerance_;
  std::unordered_map<Key, std::vector<int>, KeyHash> cells_;
};

}  // namespace

TriMesh WeldVertices(const TriMesh& mesh, double tolerance, const std::vector<bool>& may_join) {
  VertexGrid grid(tolerance);
  std::vector<Eigen::Vector3d> distinct;
  std::vector<int> welded(mesh.vertices.size());
  for (size_t i = 0; i < mesh.vertices.size(); ++i) {
    const bool is_free = may_join.empty() || may_join[i];
    welded[i] = is_free ? grid.FindNear(mesh.vertices[i], distinct) : -1;
    if (welded[i] >= 0) continue;
    welded[i] = static_cast<int>(distinct.size());
    if (is_free) grid.Store(mesh.vertices[i], welded[i]);
    distinct.push_back(mesh.vertices[i]);
  }

  TriMesh result;
  std::vector<int> kept(distinct.size(), -1);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    Eigen::Vector3i corners(welded[t[0]], welded[t[1]], welded[t[2]]);
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    for (int& corner : corners) {
      if (kept[corner] < 0) {
        kept[corner] = result.num_vertices();
        result.vertices.push_back(distinct[corner]);
      }
      corner = kept[corner];
    }
    result.triangles.push_back(corners);
  }
  return result;
}

}  // namespace graspbench
