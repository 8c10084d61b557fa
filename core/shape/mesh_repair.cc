#include "core/shape/mesh_repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/base/units.h"
#include "core/shape/mass_properties.h"
#include "core/shape/mesh_edges.h"
#include "core/shape/weld_vertices.h"

namespace graspbench {
namespace {

constexpr double kRelativeWeldTolerance = 1e-6;
constexpr int kMaxShells = 64;  // more is a soup of triangles, not solids and cavities

double CalcExtent(const TriMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  return box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
}

void Flip(Eigen::Vector3i& triangle) { std::swap(triangle[1], triangle[2]); }

// Slivers and copies; the vertices stay.
int DropBadFaces(TriMesh& mesh) {
  std::set<std::array<int, 3>> seen;
  std::vector<Eigen::Vector3i> kept;
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3d u = mesh.vertices[t[1]] - mesh.vertices[t[0]];
    const Eigen::Vector3d v = mesh.vertices[t[2]] - mesh.vertices[t[0]];
    const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()});
    std::array<int, 3> corners = {t[0], t[1], t[2]};
    std::sort(corners.begin(), corners.end());
    if (u.cross(v).norm() > kMinAspect * longest && seen.insert(corners).second) kept.push_back(t);
  }
  const int num_dropped = mesh.num_triangles() - static_cast<int>(kept.size());
  mesh.triangles = std::move(kept);
  return num_dropped;
}

// Walks over edges with two triangles; gives every shell one orientation (that of its first
// triangle) and every triangle the number of its shell.
int Orient(TriMesh& mesh, std::vector<int>& shell_of) {
  std::vector<std::vector<std::pair<int, bool>>> neighbours(mesh.triangles.size());
  for (const MeshEdge& edge : ListEdges(mesh)) {
    if (edge.num_forward + edge.num_backward != 2) continue;
    const bool is_opposed = edge.num_forward != 1;
    neighbours[edge.first_triangle].emplace_back(edge.last_triangle, is_opposed);
    neighbours[edge.last_triangle].emplace_back(edge.first_triangle, is_opposed);
  }
  int num_flipped = 0, num_shells = 0;
  shell_of.assign(mesh.triangles.size(), -1);
  std::vector<bool> is_flipped(mesh.triangles.size(), false);
  for (int start = 0; start < mesh.num_triangles(); ++start) {
    if (shell_of[start] >= 0) continue;
    std::vector<int> members = {start};
    shell_of[start] = num_shells;
    for (size_t i = 0; i < members.size(); ++i) {
      for (const auto& [neighbour, is_opposed] : neighbours[members[i]]) {
        if (shell_of[neighbour] >= 0) continue;
        shell_of[neighbour] = num_shells;
        is_flipped[neighbour] = is_flipped[members[i]] != is_opposed;
        members.push_back(neighbour);
      }
    }
    ++num_shells;
    // The majority was right.
    const auto count = std::count_if(members.begin(), members.end(),
                                     [&](int member) { return is_flipped[member]; });
    const bool is_start_right = 2 * count <= static_cast<int64_t>(members.size());
    for (const int member : members) {
      if (is_flipped[member] != is_start_right) continue;
      Flip(mesh.triangles[member]);
      ++num_flipped;
    }
  }
  return num_flipped;
}

// Closes holes whose rim is one simple loop of open edges.
int FillHoles(TriMesh& mesh) {
  std::map<int, std::vector<int>> next;  // against the direction of the triangle at the edge
  for (const MeshEdge& edge : ListEdges(mesh)) {
    if (edge.num_forward + edge.num_backward != 1) continue;
    if (edge.num_forward == 1) next[edge.to].push_back(edge.from);
    if (edge.num_backward == 1) next[edge.from].push_back(edge.to);
  }
  const double max_length = CalcExtent(mesh);
  int num_filled = 0;
  std::set<int> visited;
  for (const auto& [start, unused] : next) {
    if (visited.count(start) > 0) continue;
    std::vector<int> rim;
    double length = 0.0;
    int here = start;
    bool is_loop = false;
    while (visited.insert(here).second) {
      rim.push_back(here);
      const auto found = next.find(here);
      if (found == next.end() || found->second.size() != 1) break;
      length += (mesh.vertices[found->second[0]] - mesh.vertices[here]).norm();
      here = found->second[0];
      is_loop = here == start;
    }
    if (!is_loop || rim.size() < 3 || rim.size() > kMaxHoleEdges || length > max_length) continue;
    ++num_filled;
    if (rim.size() == 3) {
      mesh.triangles.emplace_back(rim[0], rim[1], rim[2]);
      continue;
    }
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int i : rim) middle += mesh.vertices[i] / static_cast<double>(rim.size());
    const int hub = mesh.num_vertices();
    mesh.vertices.push_back(middle);
    for (size_t i = 0; i < rim.size(); ++i) {
      mesh.triangles.emplace_back(rim[i], rim[(i + 1) % rim.size()], hub);
    }
  }
  return num_filled;
}

// How often the surface winds around p: odd inside, even outside (Van Oosterom, Strackee 1983).
int CalcWinding(const TriMesh& mesh, const std::vector<Eigen::Vector3i>& triangles,
                const Eigen::Vector3d& p) {
  double angle = 0.0;
  for (const Eigen::Vector3i& t : triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]] - p, b = mesh.vertices[t[1]] - p,
                          c = mesh.vertices[t[2]] - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(c)),
                              la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return static_cast<int>(std::lround(angle / (4.0 * kPi)));
}

// Shells with an even number of others around them face outwards, the rest inwards.
int TurnShells(TriMesh& mesh, const std::vector<int>& shell_of, int num_shells) {
  std::vector<TriMesh> shells(num_shells);
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    shells[shell_of[i]].triangles.push_back(mesh.triangles[i]);
  }
  std::vector<bool> is_wrong(num_shells);
  for (int s = 0; s < num_shells; ++s) {
    const Eigen::Vector3d& p = mesh.vertices[shells[s].triangles.front()[0]];
    int num_around = 0;
    for (int other = 0; other < num_shells; ++other) {
      if (other != s && CalcWinding(mesh, shells[other].triangles, p) != 0) ++num_around;
    }
    TriMesh shell;
    shell.vertices = mesh.vertices;
    shell.triangles = shells[s].triangles;
    is_wrong[s] = (CalcVolume(shell) < 0.0) != (num_around % 2 == 1);
  }
  int num_turned = 0;
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    if (is_wrong[shell_of[i]]) Flip(mesh.triangles[i]);
  }
  for (const bool wrong : is_wrong) num_turned += wrong;
  return num_turned;
}

}  // namespace

MeshRepair RepairMesh(const TriMesh& mesh) {
  MeshRepair repair;
  repair.mesh = mesh;
  const double extent = CalcExtent(mesh);
  const bool is_finite = std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                                     [](const Eigen::Vector3d& p) { return p.allFinite(); });
  if (!is_finite || !(extent > 0.0) || !std::isfinite(extent)) return repair;

  const auto note = [&](int count, const char* one, const char* many) {
    if (count > 0) {
      repair.actions.push_back(count == 1 ? one : std::to_string(count) + many);
    }
  };
  repair.mesh = WeldVertices(mesh, kRelativeWeldTolerance * extent);
  note(mesh.num_vertices() - repair.mesh.num_vertices(),
       "1 vertex merged into its neighbour or unused",
       " vertices merged into their neighbours or unused");
  note(DropBadFaces(repair.mesh), "1 triangle without area or doubled dropped",
       " triangles without area or doubled dropped");
  if (repair.mesh.triangles.empty()) return repair;

  std::vector<int> shell_of;
  note(Orient(repair.mesh, shell_of), "1 triangle flipped to face like its neighbours",
       " triangles flipped to face like their neighbours");
  note(FillHoles(repair.mesh), "1 hole closed", " holes closed");
  Orient(repair.mesh, shell_of);  // the fans belong to shells too
  const int num_shells = *std::max_element(shell_of.begin(), shell_of.end()) + 1;
  if (num_shells <= kMaxShells) {
    note(TurnShells(repair.mesh, shell_of, num_shells), "1 shell turned the right way round",
         " shells turned the right way round");
  }
  return repair;
}

}  // namespace graspbench
