#include "core/hand/link_solid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/shape/line_crossings.h"

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double kClosingBall = 0.003;                           // [m]
constexpr double kMostCells = 120.0;                             // along the longest side
constexpr double kSmallestCell = 0.0006, kLargestCell = 0.0015;  // [m]
constexpr double kNumMeshPoints = 8000.0;
constexpr double kNearestPoints = 0.0005, kFarthestPoints = 0.001;  // [m] from each other
constexpr int kCellsByBin = 4;
constexpr float kFar = 1e12f;

/** Squared distances from the cells of value 0, in cells, along one axis (Felzenszwalb and
Huttenlocher 2012: the lower envelope of parabolas). */
void SweepDistances(float* values, int count, int64_t stride, std::vector<float>& copy,
                    std::vector<int>& at, std::vector<double>& from) {
  copy.resize(static_cast<size_t>(count));
  at.resize(static_cast<size_t>(count));
  from.resize(static_cast<size_t>(count) + 1);
  for (int i = 0; i < count; ++i) copy[static_cast<size_t>(i)] = values[i * stride];
  int last = -1;
  for (int i = 0; i < count; ++i) {
    const double value = copy[static_cast<size_t>(i)];
    if (value >= kFar) continue;
    double begin = -std::numeric_limits<double>::infinity();
    while (last >= 0) {
      const int j = at[static_cast<size_t>(last)];
      begin =
          (value + double(i) * i - copy[static_cast<size_t>(j)] - double(j) * j) / (2.0 * (i - j));
      if (begin > from[static_cast<size_t>(last)]) break;
      --last;
      begin = -std::numeric_limits<double>::infinity();
    }
    ++last;
    at[static_cast<size_t>(last)] = i;
    from[static_cast<size_t>(last)] = begin;
  }
  if (last < 0) return;
  int k = 0;
  for (int i = 0; i < count; ++i) {
    while (k < last && from[static_cast<size_t>(k + 1)] < i) ++k;
    const int j = at[static_cast<size_t>(k)];
    values[i * stride] = static_cast<float>(double(i - j) * (i - j) + copy[static_cast<size_t>(j)]);
  }
}

void SpreadDistances(const Vector3i& num, std::vector<float>& values) {
  std::vector<float> copy;
  std::vector<int> at;
  std::vector<double> from;
  const int64_t row = num.x(), layer = row * num.y();
  for (int z = 0; z < num.z(); ++z) {
    for (int y = 0; y < num.y(); ++y) {
      SweepDistances(&values[static_cast<size_t>(z * layer + y * row)], num.x(), 1, copy, at, from);
    }
    for (int x = 0; x < num.x(); ++x) {
      SweepDistances(&values[static_cast<size_t>(z * layer + x)], num.y(), row, copy, at, from);
    }
  }
  for (int y = 0; y < num.y(); ++y) {
    for (int x = 0; x < num.x(); ++x) {
      SweepDistances(&values[static_cast<size_t>(y * row + x)], num.z(), layer, copy, at, from);
    }
  }
}

/** Calls with points of a triangle at most `spacing` apart. */
template <class Visit>
void VisitPoints(const Vector3d& a, const Vector3d& b, const Vector3d& c, double spacing,
                 Visit&& visit) {
  const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
  const int n = std::clamp(static_cast<int>(std::ceil(longest / spacing)), 1, 4000);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      const double u = (i + 1.0 / 3.0) / n, v = (j + 1.0 / 3.0) / n;
      visit(Vector3d(a + u * (b - a) + v * (c - a)));
      if (i + j + 1 < n)
        visit(Vector3d(a + (u + 1.0 / 3.0 / n) * (b - a) + (v + 1.0 / 3.0 / n) * (c - a)));
    }
  }
}

const std::array<Vector3i, 6>& ListSides() {
  static const std::array<Vector3i, 6> sides = {Vector3i(1, 0, 0), Vector3i(-1, 0, 0),
                                                Vector3i(0, 1, 0), Vector3i(0, -1, 0),
                                                Vector3i(0, 0, 1), Vector3i(0, 0, -1)};
  return sides;
}

}  // namespace

LinkSolid::LinkSolid(const std::vector<TriMesh>& meshes) {
  Eigen::AlignedBox3d box;
  for (const TriMesh& mesh : meshes) {
    for (const Vector3i& t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) box.extend(mesh.vertices[t[k]]);
    }
  }
  size_ = std::clamp(box.sizes().maxCoeff() / kMostCells, kSmallestCell, kLargestCell);
  const double margin = kClosingBall + 3.0 * size_;
  lower_ = box.min() - Vector3d::Constant(margin);
  num_ = ((box.sizes() + Vector3d::Constant(2.0 * margin)) / size_).cast<int>() + Vector3i::Ones();
  for (const TriMesh& mesh : meshes) {
    if (!mesh.triangles.empty()) trees_.emplace_back(mesh);
  }
  FindOutside(meshes);
  AddMeshPoints(meshes);
  AddMembrane();
  SortIntoBins();
}

Vector3i LinkSolid::FindCell(const Vector3d& p) const {
  return ((p - lower_) / size_).array().floor().cast<int>();
}
bool LinkSolid::Holds(const Vector3i& cell) const {
  return cell.minCoeff() >= 0 && (cell.array() < num_.array()).all();
}
size_t LinkSolid::IndexOf(const Vector3i& cell) const {
  return static_cast<size_t>(cell.x()) +
         static_cast<size_t>(num_.x()) *
             (static_cast<size_t>(cell.y()) +
              static_cast<size_t>(num_.y()) * static_cast<size_t>(cell.z()));
}
Vector3d LinkSolid::CentreOf(const Vector3i& cell) const {
  return lower_ + size_ * (cell.cast<double>() + Vector3d::Constant(0.5));
}
bool LinkSolid::IsOutside(const Vector3d& p) const {
  const Vector3i cell = FindCell(p);
  return !Holds(cell) || is_outside_[IndexOf(cell)] != 0;
}

void LinkSolid::FindOutside(const std::vector<TriMesh>& meshes) {
  const size_t count = static_cast<size_t>(num_.cast<int64_t>().prod());
  from_mesh_.assign(count, kFar);
  for (const TriMesh& mesh : meshes) {
    for (const Vector3i& t : mesh.triangles) {
      VisitPoints(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], 0.7 * size_,
                  [&](const Vector3d& p) { from_mesh_[IndexOf(FindCell(p))] = 0.0f; });
    }
  }
  SpreadDistances(num_, from_mesh_);

  const double reach = kClosingBall / size_;
  std::vector<float> from_free(count, kFar);
  std::vector<Vector3i> open = {Vector3i::Zero()};
  from_free[0] = 0.0f;
  while (!open.empty()) {
    const Vector3i cell = open.back();
    open.pop_back();
    for (const Vector3i& side : ListSides()) {
      const Vector3i next = cell + side;
      if (!Holds(next)) continue;
      const size_t index = IndexOf(next);
      if (from_free[index] == 0.0f || from_mesh_[index] < reach * reach) continue;
      from_free[index] = 0.0f;
      open.push_back(next);
    }
  }
  SpreadDistances(num_, from_free);

  std::vector<uint8_t> votes(count, 0);
  std::vector<LineCrossings::Crossing> crossings;
  for (const TriMesh& mesh : meshes) {
    if (mesh.triangles.empty()) continue;
    std::vector<uint8_t> own(count, 0);
    for (int axis = 0; axis < 3; ++axis) {
      const LineCrossings lines(mesh, axis);
      const int u_axis = (axis + 1) % 3, v_axis = (axis + 2) % 3;
      for (int u = 0; u < num_[u_axis]; ++u) {
        for (int v = 0; v < num_[v_axis]; ++v) {
          Vector3i cell = Vector3i::Zero();
          cell[u_axis] = u;
          cell[v_axis] = v;
          const Vector3d start = CentreOf(cell);
          crossings.clear();
          lines.Find(start[u_axis], start[v_axis], crossings);
          int all = 0;
          for (const auto& crossing : crossings) all += crossing.winding;
          if (crossings.empty() || all != 0) continue;
          size_t next = 0;
          int winding = 0;
          for (; cell[axis] < num_[axis]; ++cell[axis]) {
            const double at = CentreOf(cell)[axis];
            for (; next < crossings.size() && crossings[next].at < at; ++next) {
              winding += crossings[next].winding;
            }
            if (winding != 0) ++own[IndexOf(cell)];
          }
        }
      }
    }
    for (size_t i = 0; i < count; ++i) votes[i] |= own[i] >= 2;
  }
  is_outside_.resize(count);
  for (size_t i = 0; i < count; ++i) {
    is_outside_[i] = votes[i] == 0 && from_free[i] < reach * reach;
  }
}

void LinkSolid::AddMeshPoints(const std::vector<TriMesh>& meshes) {
  double area = 0.0;
  for (const TriMesh& mesh : meshes) {
    for (const Vector3i& t : mesh.triangles) {
      area += 0.5 * (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                        .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]])
                        .norm();
    }
  }
  const double spacing =
      std::clamp(std::sqrt(area / kNumMeshPoints), kNearestPoints, kFarthestPoints);
  // Evenly by area: every share along the triangles, within one by a Kronecker sequence.
  const double share = spacing * spacing;
  double until = 0.5 * share, so_far = 0.0, u = 0.0, v = 0.0;
  for (const TriMesh& mesh : meshes) {
    for (const Vector3i& t : mesh.triangles) {
      const Vector3d a = mesh.vertices[t[0]], ab = mesh.vertices[t[1]] - a,
                     ac = mesh.vertices[t[2]] - a;
      const Vector3d normal = ab.cross(ac);
      so_far += 0.5 * normal.norm();
      for (; until < so_far; until += share) {
        u = std::fmod(u + 0.7548776662466927, 1.0);
        v = std::fmod(v + 0.5698402909980532, 1.0);
        const bool is_beyond = u + v > 1.0;
        const Vector3d p = a + (is_beyond ? 1.0 - u : u) * ab + (is_beyond ? 1.0 - v : v) * ac;
        for (const double sign : {1.0, -1.0}) {
          const Vector3d nhat = sign * normal.normalized();
          if (IsOutside(p + 1.5 * size_ * nhat)) boundary_.push_back({p, nhat, false});
        }
      }
    }
  }
}

void LinkSolid::AddMembrane() {
  constexpr float kOff = 1.6f * 1.6f;  // squared, in cells: nearer is the mesh itself
  Vector3i cell;
  for (cell.z() = 1; cell.z() + 1 < num_.z(); ++cell.z()) {
    for (cell.y() = 1; cell.y() + 1 < num_.y(); ++cell.y()) {
      for (cell.x() = 1; cell.x() + 1 < num_.x(); ++cell.x()) {
        const size_t index = IndexOf(cell);
        if (is_outside_[index] || from_mesh_[index] < kOff) continue;
        Vector3d out = Vector3d::Zero();
        for (const Vector3i& side : ListSides()) {
          if (is_outside_[IndexOf(cell + side)]) out += side.cast<double>();
        }
        if (out.norm() == 0.0) continue;
        const Vector3d nhat = out.normalized();
        boundary_.push_back({CentreOf(cell) + 0.5 * size_ * nhat, nhat, true});
      }
    }
  }
}

void LinkSolid::SortIntoBins() {
  num_bins_ = num_ / kCellsByBin + Vector3i::Ones();
  bins_.resize(static_cast<size_t>(num_bins_.prod()));
  for (size_t k = 0; k < boundary_.size(); ++k) {
    const Vector3i bin = FindCell(boundary_[k].p) / kCellsByBin;
    bins_[static_cast<size_t>(bin.x() + num_bins_.x() * (bin.y() + num_bins_.y() * bin.z()))]
        .push_back(static_cast<int>(k));
  }
}

std::vector<LinkSolid::BoundaryPoint> LinkSolid::ListSpread(size_t num_points) const {
  std::vector<BoundaryPoint> spread;
  const double step = std::max(1.0, static_cast<double>(boundary_.size()) /
                                        static_cast<double>(std::max<size_t>(1, num_points)));
  for (double k = 0.5 * step; k < static_cast<double>(boundary_.size()); k += step) {
    spread.push_back(boundary_[static_cast<size_t>(k)]);
  }
  return spread;
}

double LinkSolid::CalcOutside(const Vector3d& p) const {
  if (boundary_.empty()) return 0.0;
  const Vector3i middle =
      (FindCell(p) / kCellsByBin).cwiseMax(Vector3i::Zero()).cwiseMin(num_bins_ - Vector3i::Ones());
  const double bin_size = kCellsByBin * size_;
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int ring = 0; ring <= num_bins_.maxCoeff(); ++ring) {
    if (nearest >= 0 && (ring - 1) * bin_size > least) break;
    const Vector3i from = (middle - Vector3i::Constant(ring)).cwiseMax(Vector3i::Zero());
    const Vector3i to = (middle + Vector3i::Constant(ring)).cwiseMin(num_bins_ - Vector3i::Ones());
    for (int z = from.z(); z <= to.z(); ++z) {
      for (int y = from.y(); y <= to.y(); ++y) {
        for (int x = from.x(); x <= to.x(); ++x) {
          if ((Vector3i(x, y, z) - middle).cwiseAbs().maxCoeff() != ring) continue;
          for (const int k :
               bins_[static_cast<size_t>(x + num_bins_.x() * (y + num_bins_.y() * z))]) {
            const double distance = (boundary_[static_cast<size_t>(k)].p - p).norm();
            if (distance >= least) continue;
            least = distance;
            nearest = k;
          }
        }
      }
    }
  }
  const BoundaryPoint& point = boundary_[static_cast<size_t>(nearest)];
  if ((p - point.p).dot(point.nhat) <= 0.0) return 0.0;
  double distance = point.is_membrane ? (p - point.p).dot(point.nhat) : least;
  for (const TriangleTree& tree : trees_) {
    distance = std::min(distance, std::sqrt(tree.FindNearest(p).squared_distance));
  }
  return distance;
}

}  // namespace graspbench
