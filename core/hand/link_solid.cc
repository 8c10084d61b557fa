#include "core/hand/link_solid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace graspbench {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double kClosingBall = 0.0015;   // [m]
constexpr double kMostCells = 200.0;      // along the longest side
constexpr double kSmallestCell = 0.0007;  // [m]
constexpr double kNumMeshPoints = 4000.0, kMostMeshPoints = 6e4;
constexpr double kNearestPoints = 0.0005, kFarthestPoints = 0.001;  // [m] from each other
constexpr double kBeside = 0.0002;                                  // distance off a mesh [m]
constexpr double kInTheWay = 0.0005;  // depth of another surface in the probe [m]
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

/** Calls `visit` with points of a triangle at most `spacing` apart. */
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
    if (!mesh.triangles.empty()) meshes_.push_back(mesh);
    for (const Vector3i& t : mesh.triangles) {
      for (int k = 0; k < 3; ++k) box.extend(mesh.vertices[t[k]]);
    }
  }
  for (const TriMesh& mesh : meshes_) {
    trees_.emplace_back(mesh);
    lines_.push_back({LineCrossings(mesh, 0), LineCrossings(mesh, 1), LineCrossings(mesh, 2)});
  }
  size_ = std::max(kSmallestCell, box.sizes().maxCoeff() / kMostCells);
  const double margin = kProbeRadius + 3.0 * size_;
  lower_ = box.min() - Vector3d::Constant(margin);
  num_ = ((box.sizes() + Vector3d::Constant(2.0 * margin)) / size_).cast<int>() + Vector3i::Ones();
  FindOutside();
  AddMeshPoints();
  AddMembrane();
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

bool LinkSolid::IsEnclosed(const Vector3d& p) const {
  std::vector<LineCrossings::Crossing> crossings;
  for (const auto& lines : lines_) {
    int votes = 0;
    for (int axis = 0; axis < 3; ++axis) {
      crossings.clear();
      lines[static_cast<size_t>(axis)].Find(p[(axis + 1) % 3], p[(axis + 2) % 3], crossings);
      int all = 0, below = 0;
      for (const auto& crossing : crossings) {
        all += crossing.winding;
        if (crossing.at < p[axis]) below += crossing.winding;
      }
      votes += all == 0 && below != 0;
    }
    if (votes >= 2) return true;
  }
  return false;
}

/** Whether the point is within the closing ball of a free centre, plus one cell. */
bool LinkSolid::IsNearFree(const Vector3d& p) const {
  const Vector3i cell = FindCell(p);
  const double reach = kClosingBall / size_ + 1.0;
  return !Holds(cell) || from_free_[IndexOf(cell)] < reach * reach;
}

double LinkSolid::CalcMeshDistance(const Vector3d& p) const {
  double square = std::numeric_limits<double>::infinity();
  for (const TriangleTree& tree : trees_) {
    square = std::min(square, tree.FindNearest(p).squared_distance);
  }
  return std::sqrt(square);
}

/** Finds the cells that the centre of a ball from far away can reach. */
std::vector<uint8_t> LinkSolid::FindReached(double radius) const {
  const double reach = std::max(1.0, radius / size_);
  std::vector<uint8_t> is_reached(from_mesh_.size(), 0);
  std::vector<Vector3i> open = {Vector3i::Zero()};
  is_reached[0] = 1;
  while (!open.empty()) {
    const Vector3i cell = open.back();
    open.pop_back();
    for (const Vector3i& side : ListSides()) {
      const Vector3i next = cell + side;
      if (!Holds(next)) continue;
      const size_t index = IndexOf(next);
      if (is_reached[index] || from_mesh_[index] < reach * reach) continue;
      is_reached[index] = 1;
      open.push_back(next);
    }
  }
  return is_reached;
}

void LinkSolid::FindOutside() {
  const size_t count = static_cast<size_t>(num_.cast<int64_t>().prod());
  from_mesh_.assign(count, kFar);
  for (const TriMesh& mesh : meshes_) {
    for (const Vector3i& t : mesh.triangles) {
      VisitPoints(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]], 0.7 * size_,
                  [&](const Vector3d& p) { from_mesh_[IndexOf(FindCell(p))] = 0.0f; });
    }
  }
  SpreadDistances(num_, from_mesh_);

  std::vector<uint8_t> is_enclosed(count, 0);
  std::vector<LineCrossings::Crossing> crossings;
  for (const auto& lines : lines_) {
    std::vector<uint8_t> votes(count, 0);
    for (int axis = 0; axis < 3; ++axis) {
      const int u_axis = (axis + 1) % 3, v_axis = (axis + 2) % 3;
      for (int u = 0; u < num_[u_axis]; ++u) {
        for (int v = 0; v < num_[v_axis]; ++v) {
          Vector3i cell = Vector3i::Zero();
          cell[u_axis] = u;
          cell[v_axis] = v;
          const Vector3d start = CentreOf(cell);
          crossings.clear();
          lines[static_cast<size_t>(axis)].Find(start[u_axis], start[v_axis], crossings);
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
            if (winding != 0) ++votes[IndexOf(cell)];
          }
        }
      }
    }
    for (size_t i = 0; i < count; ++i) is_enclosed[i] |= votes[i] >= 2;
  }

  // The centre of a probe that rests on a mesh is within one cell of the centres without contact.
  is_probe_ = FindReached(kProbeRadius - 1.5 * size_);
  const std::vector<uint8_t> is_free = FindReached(kClosingBall - 0.5 * size_);
  from_free_.resize(count);
  for (size_t i = 0; i < count; ++i) from_free_[i] = is_free[i] && !is_enclosed[i] ? 0.0f : kFar;
  SpreadDistances(num_, from_free_);
  const double reach = std::max(1.0, kClosingBall / size_);
  is_outside_.resize(count);
  for (size_t i = 0; i < count; ++i) {
    is_outside_[i] = !is_enclosed[i] && from_free_[i] < reach * reach;
    is_probe_[i] = is_probe_[i] && !is_enclosed[i];
  }
}

void LinkSolid::AddMeshPoints() {
  double area = 0.0;
  for (const TriMesh& mesh : meshes_) {
    for (const Vector3i& t : mesh.triangles) {
      area += 0.5 * (mesh.vertices[t[1]] - mesh.vertices[t[0]])
                        .cross(mesh.vertices[t[2]] - mesh.vertices[t[0]])
                        .norm();
    }
  }
  const double spacing =
      std::max(std::clamp(std::sqrt(area / kNumMeshPoints), kNearestPoints, kFarthestPoints),
               std::sqrt(area / kMostMeshPoints));
  // Points are spaced evenly by area along the triangles, within one by a Kronecker sequence.
  const double share = spacing * spacing;
  double until = 0.5 * share, so_far = 0.0, u = 0.0, v = 0.0;
  for (const TriMesh& mesh : meshes_) {
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
          if (!IsEnclosed(p + kBeside * nhat) && IsNearFree(p + size_ * nhat)) {
            boundary_.push_back({p, nhat, false});
          }
        }
      }
    }
  }
}

void LinkSolid::AddMembrane() {
  constexpr float kOff = 1.6f * 1.6f;  // squared, in cells: nearer cells belong to the mesh itself
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
        membrane_.push_back(boundary_.back().p);
      }
    }
  }
}

/** Whether a probe can rest on the point: nothing else penetrates it by more than 0.5 mm. */
bool LinkSolid::IsOpen(const BoundaryPoint& point) const {
  const Vector3d centre = point.p + kProbeRadius * point.nhat;
  const Vector3i middle = FindCell(centre);
  bool is_reached = !Holds(middle);
  for (int z = -1; z <= 1 && !is_reached; ++z) {
    for (int y = -1; y <= 1 && !is_reached; ++y) {
      for (int x = -1; x <= 1 && !is_reached; ++x) {
        const Vector3i cell = middle + Vector3i(x, y, z);
        is_reached = !Holds(cell) || is_probe_[IndexOf(cell)];
      }
    }
  }
  return is_reached && CalcMeshDistance(centre) > kProbeRadius - kInTheWay;
}

std::vector<LinkSolid::BoundaryPoint> LinkSolid::ListOpen(size_t num_points) const {
  std::vector<BoundaryPoint> open;
  const double step = std::max(1.0, static_cast<double>(boundary_.size()) /
                                        static_cast<double>(std::max<size_t>(1, num_points)));
  for (double k = 0.5 * step; k < static_cast<double>(boundary_.size()); k += step) {
    const BoundaryPoint& point = boundary_[static_cast<size_t>(k)];
    if (IsOpen(point)) open.push_back(point);
  }
  return open;
}

double LinkSolid::CalcOutside(const Vector3d& p) const {
  if (!IsNearFree(p) || IsEnclosed(p)) return 0.0;
  double distance = CalcMeshDistance(p);
  for (const Vector3d& other : membrane_) distance = std::min(distance, (other - p).norm());
  return distance;
}

LinkSolids MakeLinkSolids(const std::vector<std::vector<TriMesh>>& meshes) {
  LinkSolids solids;
  for (const std::vector<TriMesh>& of_link : meshes) {
    const bool has_triangle = std::any_of(of_link.begin(), of_link.end(), [](const TriMesh& mesh) {
      return !mesh.triangles.empty();
    });
    solids.push_back(has_triangle ? std::make_unique<LinkSolid>(of_link) : nullptr);
  }
  return solids;
}

}  // namespace graspbench
