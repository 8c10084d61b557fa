#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

#include "core/shape/mass_properties.h"
#include "core/shape/repair/mesh_repair.h"
#include "core/shape/repair/mesh_topology.h"

namespace graspbench {
namespace {

// A step along the rim of a hole, against the direction of the triangle at the edge.
struct RimEdge {
  int to = -1;
  int triangle = -1;
};

struct Hole {
  std::vector<int> rim;        // vertices in the order of the closing triangles
  std::vector<int> triangles;  // at the rim
};

// Splits rims into loops that do not touch themselves.
class HoleFinder {
 public:
  explicit HoleFinder(const TriMesh& mesh) : mesh_(mesh) {
    for (const MeshEdge& edge : ListEdges(mesh)) {
      if (edge.num_forward + edge.num_backward != 1) continue;
      const bool is_forward = edge.num_forward == 1;
      next_[is_forward ? edge.to : edge.from].push_back(
          {is_forward ? edge.from : edge.to, edge.first_triangle});
    }
  }

  std::vector<Hole> Find() {
    for (const auto& [start, ways] : next_) {
      while (!ways.empty()) Follow(start);
    }
    return std::move(holes_);
  }

 private:
  // Walks until no edge is left. When the path returns to a vertex, the loop between is a hole.
  void Follow(int start) {
    std::vector<int> path = {start};
    std::vector<int> triangles;
    std::map<int, size_t> place = {{start, 0}};
    while (true) {
      RimEdge edge;
      if (!TakeWay(path, edge)) return;
      triangles.push_back(edge.triangle);
      const auto [known, is_new] = place.emplace(edge.to, path.size());
      if (is_new) {
        path.push_back(edge.to);
        continue;
      }
      const auto first = static_cast<std::ptrdiff_t>(known->second);
      holes_.push_back(
          {{path.begin() + first, path.end()}, {triangles.begin() + first, triangles.end()}});
      for (size_t i = known->second + 1; i < path.size(); ++i) place.erase(path[i]);
      path.resize(known->second + 1);
      triangles.resize(known->second);
    }
  }

  // Where several holes meet, the sharpest turn stays on the smallest of them.
  bool TakeWay(const std::vector<int>& path, RimEdge& edge) {
    const auto found = next_.find(path.back());
    if (found == next_.end() || found->second.empty()) return false;
    std::vector<RimEdge>& ways = found->second;
    size_t best = 0;
    if (path.size() > 1 && ways.size() > 1) {
      const Eigen::Vector3d back =
          (mesh_.vertices[path[path.size() - 2]] - mesh_.vertices[path.back()]).normalized();
      double sharpest = -std::numeric_limits<double>::infinity();
      for (size_t i = 0; i < ways.size(); ++i) {
        const double turn =
            back.dot((mesh_.vertices[ways[i].to] - mesh_.vertices[path.back()]).normalized());
        if (turn <= sharpest) continue;
        sharpest = turn;
        best = i;
      }
    }
    edge = ways[best];
    ways.erase(ways.begin() + static_cast<std::ptrdiff_t>(best));
    return true;
  }

  const TriMesh& mesh_;
  std::map<int, std::vector<RimEdge>> next_;
  std::vector<Hole> holes_;
};

}  // namespace

int SewSeams(double tolerance, TriMesh& mesh) {
  std::vector<bool> is_open(mesh.vertices.size(), false);
  for (const MeshEdge& edge : ListEdges(mesh)) {
    if (edge.num_forward + edge.num_backward == 1) is_open[edge.from] = is_open[edge.to] = true;
  }
  if (std::find(is_open.begin(), is_open.end(), true) == is_open.end()) return 0;
  TriMesh sewn = WeldVertices(mesh, tolerance, is_open);
  const TriMesh tidy = WeldVertices(mesh, tolerance, std::vector<bool>(is_open.size(), false));
  const int num_joined = tidy.num_vertices() - sewn.num_vertices();
  if (num_joined > 0) mesh = std::move(sewn);
  return num_joined;
}

int FillHoles(double max_share, TriMesh& mesh) {
  const std::vector<Hole> holes = HoleFinder(mesh).Find();
  if (holes.empty()) return 0;
  const Shells shells = FindShells(mesh);
  std::vector<double> area(shells.count, 0.0);
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    area[shells.of_triangle[i]] += CalcArea(mesh, mesh.triangles[i]);
  }
  const double total = std::accumulate(area.begin(), area.end(), 0.0);
  int num_filled = 0;
  for (const Hole& hole : holes) {
    const auto size = static_cast<int>(hole.rim.size());
    if (size < 3) continue;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int i : hole.rim) middle += mesh.vertices[i] / static_cast<double>(size);
    const int hub = mesh.num_vertices();
    mesh.vertices.push_back(middle);
    std::vector<Eigen::Vector3i> fan;
    double fan_area = 0.0;
    for (int i = 0; i < size; ++i) {
      fan.emplace_back(hole.rim[i], hole.rim[(i + 1) % size], hub);
      fan_area += CalcArea(mesh, fan.back());
    }
    double own_area = 0.0;  // of the largest shell at the rim
    for (const int i : hole.triangles) {
      own_area = std::max(own_area, area[shells.of_triangle[i]]);
    }
    const bool is_small = fan_area <= max_share * total && fan_area <= kMaxOwnShare * own_area;
    if (is_small && size == 3) fan = {{hole.rim[0], hole.rim[1], hole.rim[2]}};
    if (!is_small || size == 3) mesh.vertices.pop_back();
    if (!is_small) continue;
    ++num_filled;
    mesh.triangles.insert(mesh.triangles.end(), fan.begin(), fan.end());
  }
  return num_filled;
}

}  // namespace graspbench
