#include "core/shape/repair/mesh_bodies.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "core/shape/mass_properties.h"
#include "core/shape/triangle_tree.h"

namespace graspbench {
namespace {

using Triangle = std::array<Eigen::Vector3d, 3>;

Triangle CornersOf(const TriMesh& mesh, int triangle) {
  const Eigen::Vector3i& t = mesh.triangles[triangle];
  return {mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
}

/** Of the segments pq and rs (Ericson 2005, 5.1.9). */
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

/** Does p lie above or below the triangle's inside, nearer than `gap`? */
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

/** The nearest points of triangles that do not cross are those of two edges, or of a corner and a
face. */
bool AreNear(const Triangle& a, const Triangle& b, double gap) {
  for (int i = 0; i < 3; ++i) {
    if (IsOnFace(a[i], b, gap) || IsOnFace(b[i], a, gap)) return true;
    for (int j = 0; j < 3; ++j) {
      if (CalcSquaredDistance(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]) <= gap * gap) return true;
    }
  }
  return false;
}

/** Does the segment pass through the triangle's plane within it? */
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

/** The body of each shell, by its least shell. */
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
  double volume = 0.0;  ///< negative: a cavity
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
    for (const Eigen::Vector3d& p : body.mesh.vertices) body.box.extend(p);
    body.volume = CalcVolume(body.mesh);
  }
  return bodies;
}

/** Around a point of the body, by all others: they do not cross it, so that any point does. */
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

}  // namespace graspbench
