#include "core/shape/line_crossings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace graspbench {

LineCrossings::LineCrossings(const TriMesh& mesh, int axis) : mesh_(&mesh), axis_(axis) {
  Eigen::AlignedBox2d box;
  for (int i = 0; i < mesh.num_vertices(); ++i) box.extend(Flatten(i));
  num_cells_ = std::clamp(static_cast<int>(4.0 * std::sqrt(mesh.num_triangles())), 1, 256);
  if (!box.isEmpty()) {
    lower_ = box.min();
    cell_ = (box.sizes() / num_cells_).cwiseMax(1e-12);
  }
  // Counts first, then stores cell by cell, in the order of the triangles.
  const auto for_cells = [&](const auto& visit) {
    for (int i = 0; i < mesh.num_triangles(); ++i) {
      const Eigen::Vector3i& t = mesh.triangles[i];
      const Eigen::AlignedBox2d bounds =
          Eigen::AlignedBox2d(Flatten(t[0])).extend(Flatten(t[1])).extend(Flatten(t[2]));
      const Eigen::Vector2i low = FindCell(bounds.min()), high = FindCell(bounds.max());
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) visit(x + num_cells_ * y, i);
      }
    }
  };
  first_.assign(static_cast<size_t>(num_cells_) * num_cells_ + 1, 0);
  for_cells([&](int cell, int) { ++first_[cell + 1]; });
  for (size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
  triangles_.resize(first_.back());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for_cells([&](int cell, int triangle) { triangles_[next[cell]++] = triangle; });
}

Eigen::Vector2d LineCrossings::Flatten(int vertex) const {
  const Eigen::Vector3d& p = mesh_->vertices[vertex];
  return {p[(axis_ + 1) % 3], p[(axis_ + 2) % 3]};
}

Eigen::Vector2i LineCrossings::FindCell(const Eigen::Vector2d& p) const {
  const auto find = [this](double offset, double size) {
    return static_cast<int>(std::min(std::max(offset / size, 0.0), num_cells_ - 1.0));
  };
  return {find(p.x() - lower_.x(), cell_.x()), find(p.y() - lower_.y(), cell_.y())};
}

// Both triangles at an edge get the same answer, so that a line passes through exactly one of them.
// Plain arrays, because this is called millions of times, also where sanitizers check every access.
bool LineCrossings::IsLeftOf(int from, int to, double u, double v) const {
  const double* const a = mesh_->vertices[static_cast<size_t>(std::min(from, to))].data();
  const double* const b = mesh_->vertices[static_cast<size_t>(std::max(from, to))].data();
  const int along = (axis_ + 1) % 3, across = (axis_ + 2) % 3;
  const double d_u = b[along] - a[along], d_v = b[across] - a[across];
  const bool is_left = d_u * (v - a[across]) - d_v * (u - a[along]) >= 0.0;
  return is_left == (from <= to);
}

void LineCrossings::Find(double u, double v, std::vector<Crossing>& crossings) const {
  crossings.clear();
  const Eigen::Vector2d p(u, v);
  const Eigen::Vector2i at = FindCell(p);
  const int cell = at.x() + num_cells_ * at.y();
  for (int i = first_[cell]; i < first_[cell + 1]; ++i) {
    const int* const t = mesh_->triangles[static_cast<size_t>(triangles_[i])].data();
    const bool is_left = IsLeftOf(t[0], t[1], u, v);
    if (IsLeftOf(t[1], t[2], u, v) != is_left || IsLeftOf(t[2], t[0], u, v) != is_left) continue;
    const Eigen::Vector3d& a = mesh_->vertices[t[0]];
    const Eigen::Vector3d normal = (mesh_->vertices[t[1]] - a).cross(mesh_->vertices[t[2]] - a);
    const Eigen::Vector2d along(normal[(axis_ + 1) % 3], normal[(axis_ + 2) % 3]);
    const Eigen::Vector2d offset = p - Flatten(t[0]);
    // A triangle that runs counter-clockwise as seen from above has its front up the axis: the line
    // leaves the solid. A triangle without area that contains the line only by rounding is met at a
    // corner.
    const double rise = normal[axis_] == 0.0 ? 0.0 : along.dot(offset) / normal[axis_];
    crossings.push_back({a[axis_] - rise, is_left ? -1 : 1});
  }
  std::sort(crossings.begin(), crossings.end(), [](const Crossing& a, const Crossing& b) {
    return a.at != b.at ? a.at < b.at : a.winding > b.winding;
  });
}

}  // namespace graspbench
