#include "core/shape/mesh_repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/shape/mass_properties.h"
#include "core/shape/mesh_edges.h"
#include "core/shape/mesh_shells.h"
#include "core/shape/weld_vertices.h"

namespace graspbench {
namespace {

constexpr int kMaxFins = 256;  // looked for one by one

double CalcExtent(const TriMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh.vertices) box.extend(p);
  return box.isEmpty() ? 0.0 : box.sizes().maxCoeff();
}

void Flip(Eigen::Vector3i& triangle) { std::swap(triangle[1], triangle[2]); }

// Of the triangles on the same three corners one is left where more face one way, none where as
// many face either way: they enclose nothing. Where that would leave little, the file has every
// face twice for the sake of pictures, and the first of each is left.
int DropDoubledFaces(TriMesh& mesh) {
  struct Pile {
    int num_even = 0, num_odd = 0;  // by the order of the corners
    int first_even = -1, first_odd = -1;
  };
  std::map<std::array<int, 3>, Pile> piles;
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    std::array<int, 3> corners = {t[0], t[1], t[2]};
    std::sort(corners.begin(), corners.end());
    Pile& pile = piles[corners];
    const bool is_even = (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2;
    int& first = is_even ? pile.first_even : pile.first_odd;
    if (first < 0) first = i;
    ++(is_even ? pile.num_even : pile.num_odd);
  }
  std::vector<int> left, first_of_each;
  for (const auto& [corners, pile] : piles) {
    const int even = pile.first_even, odd = pile.first_odd;
    if (pile.num_even > pile.num_odd) left.push_back(even);
    if (pile.num_odd > pile.num_even) left.push_back(odd);
    first_of_each.push_back(even >= 0 && (odd < 0 || even < odd) ? even : odd);
  }
  if (2 * left.size() < first_of_each.size()) left = first_of_each;
  const int num_dropped = mesh.num_triangles() - static_cast<int>(left.size());
  if (num_dropped == 0) return 0;
  std::sort(left.begin(), left.end());
  std::vector<Eigen::Vector3i> triangles;
  for (const int i : left) triangles.push_back(mesh.triangles[i]);
  mesh.triangles = std::move(triangles);
  return num_dropped;
}

// The number of each triangle's patch: connected over edges of exactly two triangles.
std::vector<int> FindPatches(const TriMesh& mesh, const std::vector<MeshEdge>& edges) {
  std::vector<std::vector<int>> neighbours(mesh.triangles.size());
  for (const MeshEdge& edge : edges) {
    if (edge.num_forward + edge.num_backward != 2) continue;
    neighbours[edge.first_triangle].push_back(edge.last_triangle);
    neighbours[edge.last_triangle].push_back(edge.first_triangle);
  }
  std::vector<int> patch_of(mesh.triangles.size(), -1);
  int num_patches = 0;
  for (int start = 0; start < mesh.num_triangles(); ++start) {
    if (patch_of[start] >= 0) continue;
    std::vector<int> members = {start};
    patch_of[start] = num_patches;
    for (size_t i = 0; i < members.size(); ++i) {
      for (const int neighbour : neighbours[members[i]]) {
        if (patch_of[neighbour] >= 0) continue;
        patch_of[neighbour] = num_patches;
        members.push_back(neighbour);
      }
    }
    ++num_patches;
  }
  return patch_of;
}

// Patches between edges of more than two triangles that have an open rim, except the largest:
// sheets that hang on the surface. One at a time, the smallest first, for that may make another one
// whole.
int DropFins(TriMesh& mesh) {
  int num_dropped = 0;
  for (int round = 0; round < kMaxFins; ++round) {
    const std::vector<MeshEdge> edges = ListEdges(mesh);
    std::map<std::pair<int, int>, bool> is_crowded;
    for (const MeshEdge& edge : edges) {
      is_crowded[{edge.from, edge.to}] = edge.num_forward + edge.num_backward > 2;
    }
    const std::vector<int> patch_of = FindPatches(mesh, edges);
    const int num_patches = 1 + *std::max_element(patch_of.begin(), patch_of.end());
    std::vector<int> size(num_patches, 0);
    std::vector<bool> is_open(num_patches, false), hangs(num_patches, false);
    for (const MeshEdge& edge : edges) {
      if (edge.num_forward + edge.num_backward == 1) is_open[patch_of[edge.first_triangle]] = true;
    }
    for (int i = 0; i < mesh.num_triangles(); ++i) {
      const Eigen::Vector3i& t = mesh.triangles[i];
      ++size[patch_of[i]];
      for (int k = 0; k < 3; ++k) {
        const std::pair<int, int> edge = std::minmax(t[k], t[(k + 1) % 3]);
        if (is_crowded.at(edge)) hangs[patch_of[i]] = true;
      }
    }
    int fin = -1;
    for (int p = 0; p < num_patches; ++p) {
      if (is_open[p] && hangs[p] && 2 * size[p] < mesh.num_triangles() &&
          (fin < 0 || size[p] < size[fin])) {
        fin = p;
      }
    }
    if (fin < 0) break;
    std::vector<Eigen::Vector3i> left;
    for (int i = 0; i < mesh.num_triangles(); ++i) {
      if (patch_of[i] != fin) left.push_back(mesh.triangles[i]);
    }
    num_dropped += size[fin];
    mesh.triangles = std::move(left);
  }
  return num_dropped;
}

// Walks over edges with two triangles; gives every patch one orientation, that of its majority.
int Orient(TriMesh& mesh) {
  std::vector<std::vector<std::pair<int, bool>>> neighbours(mesh.triangles.size());
  for (const MeshEdge& edge : ListEdges(mesh)) {
    if (edge.num_forward + edge.num_backward != 2) continue;
    const bool is_opposed = edge.num_forward != 1;
    neighbours[edge.first_triangle].emplace_back(edge.last_triangle, is_opposed);
    neighbours[edge.last_triangle].emplace_back(edge.first_triangle, is_opposed);
  }
  int num_flipped = 0;
  std::vector<bool> is_visited(mesh.triangles.size(), false);
  std::vector<bool> is_flipped(mesh.triangles.size(), false);
  for (int start = 0; start < mesh.num_triangles(); ++start) {
    if (is_visited[start]) continue;
    std::vector<int> members = {start};
    is_visited[start] = true;
    for (size_t i = 0; i < members.size(); ++i) {
      for (const auto& [neighbour, is_opposed] : neighbours[members[i]]) {
        if (is_visited[neighbour]) continue;
        is_visited[neighbour] = true;
        is_flipped[neighbour] = is_flipped[members[i]] != is_opposed;
        members.push_back(neighbour);
      }
    }
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
int FillHoles(double max_share, TriMesh& mesh) {
  std::map<int, std::vector<int>> next;  // against the direction of the triangle at the edge
  for (const MeshEdge& edge : ListEdges(mesh)) {
    if (edge.num_forward + edge.num_backward != 1) continue;
    if (edge.num_forward == 1) next[edge.to].push_back(edge.from);
    if (edge.num_backward == 1) next[edge.from].push_back(edge.to);
  }
  const double max_length = max_share * CalcExtent(mesh);
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

// A shell that lies in no other one must face outwards; what lies in it turns with it.
int TurnShells(TriMesh& mesh) {
  const Shells shells = FindShells(mesh);
  if (shells.count > kMaxShells) return 0;
  const std::vector<TriMesh> parts = SplitShells(mesh, shells);
  std::vector<bool> is_inverted(parts.size()), is_wrong(parts.size());
  for (size_t s = 0; s < parts.size(); ++s) is_inverted[s] = CalcVolume(parts[s]) < 0.0;
  for (size_t s = 0; s < parts.size(); ++s) {
    const Eigen::Vector3d& p = mesh.vertices[parts[s].triangles.front()[0]];
    size_t outermost = s;
    double largest = 0.0;
    for (size_t other = 0; other < parts.size(); ++other) {
      if (other == s || CalcWinding(parts[other], p) == 0) continue;
      const double volume = std::abs(CalcVolume(parts[other]));
      if (volume <= largest) continue;
      largest = volume;
      outermost = other;
    }
    is_wrong[s] = is_inverted[outermost];
  }
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    if (is_wrong[shells.of_triangle[i]]) Flip(mesh.triangles[i]);
  }
  return static_cast<int>(std::count(is_wrong.begin(), is_wrong.end(), true));
}

void Note(int count, const char* one, const char* many, MeshRepair& repair) {
  if (count > 0) repair.actions.push_back(count == 1 ? one : std::to_string(count) + many);
}

bool IsFinite(const TriMesh& mesh) {
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(),
                     [](const Eigen::Vector3d& p) { return p.allFinite(); });
}

void DropUseless(MeshRepair& repair) {
  Note(DropDoubledFaces(repair.mesh), "1 doubled triangle dropped", " doubled triangles dropped",
       repair);
  if (repair.mesh.triangles.empty()) return;
  Note(DropFins(repair.mesh), "1 triangle that only hangs on the surface dropped",
       " triangles that only hang on the surface dropped", repair);
}

void CloseHoles(double max_share, MeshRepair& repair) {
  Note(FillHoles(max_share, repair.mesh), "1 hole closed", " holes closed", repair);
}

}  // namespace

MeshRepair MendMesh(const TriMesh& mesh) {
  MeshRepair repair = {mesh, {}};
  if (!IsFinite(mesh) || mesh.triangles.empty()) return repair;
  DropUseless(repair);
  CloseHoles(kMaxMendedHole, repair);
  return repair;
}

MeshRepair RepairMesh(const TriMesh& mesh) {
  MeshRepair repair = {mesh, {}};
  const double extent = IsFinite(mesh) ? CalcExtent(mesh) : 0.0;
  if (!(extent > 0.0) || !std::isfinite(extent)) return repair;
  repair.mesh = WeldVertices(mesh, kRelativeWeldTolerance * extent);
  Note(mesh.num_vertices() - repair.mesh.num_vertices(),
       "1 vertex merged into its neighbour or unused",
       " vertices merged into their neighbours or unused", repair);
  DropUseless(repair);
  if (repair.mesh.triangles.empty()) return repair;
  Note(Orient(repair.mesh), "1 triangle flipped to face like its neighbours",
       " triangles flipped to face like their neighbours", repair);
  CloseHoles(kMaxRepairedHole, repair);
  Orient(repair.mesh);  // the fans belong to shells too
  Note(TurnShells(repair.mesh), "1 shell turned the right way round",
       " shells turned the right way round", repair);
  return repair;
}

UsableMesh MakeUsable(const TriMesh& mesh) {
  UsableMesh usable = {mesh, {}, CheckMesh(mesh)};
  if (usable.report.problems.empty()) return usable;
  MeshRepair mended = MendMesh(mesh);
  if (mended.actions.empty()) return usable;
  MeshReport report = CheckMesh(mended.mesh);
  if (!report.problems.empty()) return usable;
  return {std::move(mended.mesh), std::move(mended.actions), std::move(report)};
}

}  // namespace graspbench
