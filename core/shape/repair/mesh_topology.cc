#include "core/shape/repair/mesh_topology.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/units.h"
#include "core/shape/mass_properties.h"
#include "core/shape/triangle_tree.h"

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

// Cells as wide as the tolerance: a point within it lies in the same cell or in a neighbouring one.
class VertexGrid {
 public:
  explicit VertexGrid(double tolerance) : tolerance_(tolerance) {}

  // Returns the index of the first stored point within the tolerance; -1 when there is none.
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
    // Far cells are clamped together, which is slower but still correct.
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

std::vector<MeshEdge> ListEdges(const TriMesh& mesh) {
  std::vector<MeshEdge> sides;
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), a < b ? 1 : 0, a < b ? 0 : 1, i, i});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const MeshEdge& a, const MeshEdge& b) {
    return std::tie(a.from, a.to, a.first_triangle) < std::tie(b.from, b.to, b.first_triangle);
  });
  std::vector<MeshEdge> edges;
  for (const MeshEdge& side : sides) {
    if (edges.empty() || edges.back().from != side.from || edges.back().to != side.to) {
      edges.push_back(side);
      continue;
    }
    edges.back().num_forward += side.num_forward;
    edges.back().num_backward += side.num_backward;
    edges.back().last_triangle = side.last_triangle;
  }
  return edges;
}

bool IsWhole(const std::vector<MeshEdge>& edges) {
  return std::all_of(edges.begin(), edges.end(),
                     [](const MeshEdge& edge) { return edge.num_forward == edge.num_backward; });
}

namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

Triangle CornersOf(const TriMesh& mesh, int triangle) {
  const Eigen::Vector3i& t = mesh.triangles[triangle];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/** Squared distance of the segments pq and rs (Ericson 2005, 5.1.9). */
double CalcSquaredDistance(const Eigen::Vector3d& p, const Eigen::Vector3d& q,
                           const Eigen::Vector3d& r, const Eigen::Vector3d& s) {
  const auto clamp = [](double x) { return std::clamp(x, 0.0, 1.0); };
  const Eigen::Vector3d u = q - p, v = s - r, w = p - r;
  const double a = u.squaredNorm(), e = v.squaredNorm(), b = u.dot(v), c = u.dot(w), f = v.dot(w);
  const double determinant = a * e - b * b;
  double along = determinant > 1e-12 * a * e ? clamp((b * f - c * e) / determinant) : 0.0;
  double across = e > 0.0 ? (b * along + f) / e : 0.0;
  if (across < 0.0 || across > 1.0) {
    across = clamp(across);
    along = a > 0.0 ? clamp((b * across - c) / a) : 0.0;
  }
  return (w + along * u - across * v).squaredNorm();
}

/** Whether p lies above or below the inside of the triangle, nearer than `gap`. */
bool IsOnFace(const Eigen::Vector3d& p, const Triangle& t, double gap) {
  const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double height = normal.dot(p - t[0]);
  if (height * height > gap * gap * normal.squaredNorm()) return false;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d& from = t[k];
    if (normal.dot((t[(k + 1) % 3] - from).cross(p - from)) < 0.0) return false;
  }
  return true;
}

/** Whether the triangles are within `gap`. The nearest points of triangles that do not cross lie on
two edges, or on a corner and a face. */
bool AreNear(const Triangle& a, const Triangle& b, double gap) {
  for (int i = 0; i < 3; ++i) {
    if (IsOnFace(a[i], b, gap) || IsOnFace(b[i], a, gap)) return true;
    for (int j = 0; j < 3; ++j) {
      if (CalcSquaredDistance(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]) <= gap * gap) return true;
    }
  }
  return false;
}

/** Whether the segment passes through the inside of the triangle. */
bool IsThrough(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Triangle& t) {
  const Eigen::Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double at_p = normal.dot(p - t[0]), at_q = normal.dot(q - t[0]);
  if ((at_p > 0.0) == (at_q > 0.0)) return false;
  return IsOnFace(p + at_p / (at_p - at_q) * (q - p), t, 1e-9 * (q - p).norm());
}

bool AreTouching(const Triangle& a, const Triangle& b, double gap) {
  for (int i = 0; i < 3; ++i) {
    if (IsThrough(a[i], a[(i + 1) % 3], b) || IsThrough(b[i], b[(i + 1) % 3], a)) return true;
  }
  return AreNear(a, b, gap);
}

/** Returns the body of each shell, named by its lowest shell. */
std::vector<int> JoinTouching(const TriMesh& mesh, const Shells& shells, double gap) {
  std::vector<int> body(static_cast<size_t>(shells.count));
  std::iota(body.begin(), body.end(), 0);
  const TriangleTree tree(mesh);
  std::vector<int> near;
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const Triangle corners = CornersOf(mesh, i);
    Eigen::AlignedBox3d box(corners[0]);
    box.extend(corners[1]).extend(corners[2]);
    box.min().array() -= gap;
    box.max().array() += gap;
    near.clear();
    tree.FindNear(box, near);
    for (const int j : near) {
      const int one = body[shells.of_triangle[i]], other = body[shells.of_triangle[j]];
      if (one == other || !AreTouching(corners, CornersOf(mesh, j), gap)) continue;
      std::replace(body.begin(), body.end(), std::max(one, other), std::min(one, other));
    }
  }
  return body;
}

struct Body {
  TriMesh mesh;
  Eigen::AlignedBox3d box;
  double volume = 0.0;  ///< negative for a cavity
};

std::vector<Body> SplitBodies(const TriMesh& mesh, const Shells& shells, double gap) {
  const std::vector<int> body_of = JoinTouching(mesh, shells, gap);
  std::vector<Body> bodies(static_cast<size_t>(shells.count));
  const std::vector<TriMesh> parts = SplitShells(mesh, shells);
  for (size_t i = 0; i < parts.size(); ++i) {
    TriMesh& joined = bodies[static_cast<size_t>(body_of[i])].mesh;
    const Eigen::Vector3i first = Eigen::Vector3i::Constant(joined.num_vertices());
    joined.vertices.insert(joined.vertices.end(), parts[i].vertices.begin(),
                           parts[i].vertices.end());
    for (const Eigen::Vector3i& t : parts[i].triangles) joined.triangles.push_back(t + first);
  }
  bodies.erase(std::remove_if(bodies.begin(), bodies.end(),
                              [](const Body& body) { return body.mesh.triangles.empty(); }),
               bodies.end());
  for (Body& body : bodies) {
    body.box = CalcBounds(body.mesh);
    body.volume = CalcVolume(body.mesh);
  }
  return bodies;
}

/** Winding number of the other bodies about a point of this one. They do not cross it: any point
does. */
int CalcWindingOfOthers(const std::vector<Body>& bodies, const Body& body) {
  const Triangle first = CornersOf(body.mesh, 0);
  const Eigen::Vector3d p = (first[0] + first[1] + first[2]) / 3.0;
  int winding = 0;
  for (const Body& other : bodies) {
    if (&other != &body && other.box.contains(body.box)) winding += CalcWinding(other.mesh, p);
  }
  return winding;
}

void Add(const Body& body, BodyCount& count) {
  if (count.count++ == 0) count.place = body.mesh.vertices[0];
  count.volume += body.volume;
}

}  // namespace

Bodies FindBodies(const TriMesh& mesh, const Shells& shells, double gap) {
  const std::vector<Body> bodies = SplitBodies(mesh, shells, gap);
  const auto largest =
      std::max_element(bodies.begin(), bodies.end(),
                       [](const Body& a, const Body& b) { return a.volume < b.volume; });
  Bodies found;
  for (const Body& body : bodies) {
    if (&body == &*largest || body.volume <= 0.0) continue;
    Add(body, CalcWindingOfOthers(bodies, body) >= 1 ? found.nested : found.apart);
  }
  return found;
}

namespace {

constexpr int kNumSamples = 12;

// Numbers joined into sets; each set is known by its least member.
class JoinedSets {
 public:
  explicit JoinedSets(int count) : earlier_(count) {
    std::iota(earlier_.begin(), earlier_.end(), 0);
  }
  int FindFirst(int i) {
    while (earlier_[i] != i) i = earlier_[i] = earlier_[earlier_[i]];
    return i;
  }
  void Join(int i, int j) {
    i = FindFirst(i);
    j = FindFirst(j);
    earlier_[std::max(i, j)] = std::min(i, j);
  }

 private:
  std::vector<int> earlier_;
};

// Sides of the triangles at one edge: the triangle, and +1 or -1 for its direction.
using Sides = std::vector<std::pair<int, int>>;

}  // namespace

Shells FindShells(const TriMesh& mesh) {
  JoinedSets sets(mesh.num_triangles());
  std::map<std::pair<int, int>, Sides> sides_at;
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      sides_at[std::minmax(a, b)].emplace_back(i, a < b ? 1 : -1);
    }
  }
  for (const auto& [edge, sides] : sides_at) {
    if (sides.size() == 2) sets.Join(sides[0].first, sides[1].first);
  }
  for (const auto& [edge, sides] : sides_at) {
    if (sides.size() <= 2) continue;
    std::map<int, int> excess;  // by set: sides in one direction less those in the other
    for (const auto& [triangle, direction] : sides) excess[sets.FindFirst(triangle)] += direction;
    int first = -1;
    for (const auto& [set, count] : excess) {
      if (count == 0) continue;
      if (first >= 0) sets.Join(first, set);
      first = set;
    }
  }
  Shells shells;
  shells.of_triangle.resize(mesh.triangles.size());
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const int first = sets.FindFirst(i);
    shells.of_triangle[i] = first == i ? shells.count++ : shells.of_triangle[first];
  }
  return shells;
}

std::vector<TriMesh> SplitShells(const TriMesh& mesh, const Shells& shells) {
  std::vector<TriMesh> parts(shells.count);
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    parts[shells.of_triangle[i]].triangles.push_back(mesh.triangles[i]);
  }
  for (TriMesh& part : parts) {
    std::map<int, int> kept;
    for (Eigen::Vector3i& t : part.triangles) {
      for (int& corner : t) {
        const auto [place, is_new] = kept.emplace(corner, part.num_vertices());
        if (is_new) part.vertices.push_back(mesh.vertices[corner]);
        corner = place->second;
      }
    }
  }
  return parts;
}

int CalcWinding(const TriMesh& mesh, const Eigen::Vector3d& p) {
  double angle = 0.0;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p,
                          c = mesh.vertices[t[2]] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(c)),
                              la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return static_cast<int>(std::lround(angle / (4.0 * kPi)));
}

std::vector<Eigen::Vector3d> SampleSurface(const TriMesh& mesh) {
  std::vector<Eigen::Vector3d> points;
  const int step = std::max(1, mesh.num_triangles() / kNumSamples);
  for (int i = 0; i < mesh.num_triangles(); i += step) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    points.emplace_back(0.5 * mesh.vertices[t[0]] + 0.3 * mesh.vertices[t[1]] +
                        0.2 * mesh.vertices[t[2]]);
  }
  return points;
}

}  // namespace graspbench
