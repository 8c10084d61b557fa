#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <utility>
#include <vector>

#include "core/shape/mass_properties.h"
#include "core/shape/repair/mesh_repair.h"
#include "core/shape/repair/mesh_topology.h"

namespace graspbench {
namespace {

constexpr int kMaxFins = 256;              // tested one by one
constexpr int64_t kMaxFinWork = 20000000;  // triangles visited in these tests

TriMesh TakeTriangles(const TriMesh& mesh, std::vector<int> taken) {
  std::sort(taken.begin(), taken.end());
  TriMesh result = {mesh.vertices, {}};
  for (const int i : taken) result.triangles.push_back(mesh.triangles[i]);
  return result;
}

// Connected triangles, bounded by edges that do not have exactly two triangles.
struct Patch {
  double area = 0.0;
  bool is_open = false;  // has an edge of one triangle
  bool hangs = false;    // has an edge of more than two triangles
  bool is_wall = true;   // without it, each of these edges is balanced
};

// Returns the patch of each triangle: triangles connected over edges of exactly two triangles.
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

std::vector<Patch> DescribePatches(const TriMesh& mesh, const std::vector<MeshEdge>& edges,
                                   const std::vector<int>& patch_of) {
  std::vector<Patch> patches(1 + *std::max_element(patch_of.begin(), patch_of.end()));
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    patches[patch_of[i]].area += CalcArea(mesh, mesh.triangles[i]);
  }
  // Forward less backward triangles at each crowded edge: in all, and by patch.
  std::map<std::pair<int, int>, std::pair<int, std::map<int, int>>> crowded;
  for (const MeshEdge& edge : edges) {
    const int count = edge.num_forward + edge.num_backward;
    if (count == 1) patches[patch_of[edge.first_triangle]].is_open = true;
    if (count > 2) crowded[{edge.from, edge.to}].first = edge.num_forward - edge.num_backward;
  }
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    for (int k = 0; k < 3; ++k) {
      const int a = t[k], b = t[(k + 1) % 3];
      const auto edge = crowded.find(std::minmax(a, b));
      if (edge != crowded.end()) edge->second.second[patch_of[i]] += a < b ? 1 : -1;
    }
  }
  for (const auto& [edge, excess] : crowded) {
    for (const auto& [patch, own] : excess.second) {
      patches[patch].hangs = true;
      if (excess.first == 0 || own != excess.first) patches[patch].is_wall = false;
    }
  }
  return patches;
}

}  // namespace

int DropDoubledFaces(TriMesh& mesh) {
  std::map<std::array<int, 3>, std::pair<std::vector<int>, std::vector<int>>> piles;
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    std::array<int, 3> corners = {t[0], t[1], t[2]};
    std::sort(corners.begin(), corners.end());
    const bool is_even = (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2;
    auto& [even, odd] = piles[corners];
    (is_even ? even : odd).push_back(i);
  }
  if (static_cast<int>(piles.size()) == mesh.num_triangles()) return 0;
  std::vector<int> all_left, one_left, first_of_each;
  for (const auto& [corners, pile] : piles) {
    const auto& [even, odd] = pile;
    const std::vector<int>& more = even.size() > odd.size() ? even : odd;
    const std::ptrdiff_t num_left = std::abs(static_cast<std::ptrdiff_t>(even.size()) -
                                             static_cast<std::ptrdiff_t>(odd.size()));
    all_left.insert(all_left.end(), more.begin(), more.begin() + num_left);
    if (num_left > 0) one_left.push_back(more.front());
    first_of_each.push_back(even.empty()  ? odd.front()
                            : odd.empty() ? even.front()
                                          : std::min(even.front(), odd.front()));
  }
  const int num_before = mesh.num_triangles();
  if (2 * one_left.size() < first_of_each.size()) {
    mesh = TakeTriangles(mesh, first_of_each);
  } else {
    TriMesh single = TakeTriangles(mesh, one_left), full = TakeTriangles(mesh, all_left);
    mesh = !IsWhole(ListEdges(single)) && IsWhole(ListEdges(full)) ? std::move(full)
                                                                   : std::move(single);
  }
  return num_before - mesh.num_triangles();
}

int DropFins(TriMesh& mesh) {
  const int num_before = mesh.num_triangles();
  int64_t work = 0;
  for (int round = 0; round < kMaxFins && work < kMaxFinWork; ++round) {
    work += mesh.num_triangles();
    const std::vector<MeshEdge> edges = ListEdges(mesh);
    const std::vector<int> patch_of = FindPatches(mesh, edges);
    const std::vector<Patch> patches = DescribePatches(mesh, edges, patch_of);
    double area = 0.0;
    for (const Patch& patch : patches) area += patch.area;
    int fin = -1;
    for (int p = 0; p < static_cast<int>(patches.size()); ++p) {
      const Patch& patch = patches[p];
      if (patch.hangs && (patch.is_open || patch.is_wall) && 2.0 * patch.area < area &&
          (fin < 0 || patch.area < patches[fin].area)) {
        fin = p;
      }
    }
    if (fin < 0) break;
    std::vector<int> left;
    for (int i = 0; i < mesh.num_triangles(); ++i) {
      if (patch_of[i] != fin) left.push_back(i);
    }
    mesh = TakeTriangles(mesh, left);
  }
  return num_before - mesh.num_triangles();
}

int DropLooseSheets(double max_share, TriMesh& mesh) {
  const Shells shells = FindShells(mesh);
  std::vector<double> area(shells.count, 0.0);
  double total = 0.0;
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const double own = CalcArea(mesh, mesh.triangles[i]);
    area[shells.of_triangle[i]] += own;
    total += own;
  }
  std::vector<bool> is_open(shells.count, false);
  for (const MeshEdge& edge : ListEdges(mesh)) {
    if (edge.num_forward + edge.num_backward == 1) {
      is_open[shells.of_triangle[edge.first_triangle]] = true;
    }
  }
  std::vector<int> left;
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const int shell = shells.of_triangle[i];
    if (!is_open[shell] || area[shell] > max_share * total) left.push_back(i);
  }
  const int num_dropped = mesh.num_triangles() - static_cast<int>(left.size());
  if (num_dropped > 0) mesh = TakeTriangles(mesh, left);
  return num_dropped;
}

void DropUnusedVertices(TriMesh& mesh) {
  std::vector<int> place(mesh.vertices.size(), -1);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (const int corner : t) place[corner] = 0;
  }
  std::vector<Eigen::Vector3d> used;
  for (int i = 0; i < mesh.num_vertices(); ++i) {
    if (place[i] < 0) continue;
    place[i] = static_cast<int>(used.size());
    used.push_back(mesh.vertices[i]);
  }
  mesh.vertices = std::move(used);
  for (Eigen::Vector3i& t : mesh.triangles) {
    for (int& corner : t) corner = place[corner];
  }
}

}  // namespace graspbench
