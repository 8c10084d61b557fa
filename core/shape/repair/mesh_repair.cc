#include "core/shape/repair/mesh_repair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "core/shape/mass_properties.h"
#include "core/shape/repair/mesh_topology.h"

namespace graspbench {
namespace {

double CalcExtent(const TriMesh& mesh) {
  return mesh.vertices.empty() ? 0.0 : CalcBounds(mesh).sizes().maxCoeff();
}

void Flip(Eigen::Vector3i& triangle) { std::swap(triangle[1], triangle[2]); }

// Walks over edges with two triangles and gives each patch the orientation of its majority.
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
    // The majority decides.
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

// Turns inverted shells: an outermost shell must face outwards, and the shells inside turn with it.
int TurnShells(TriMesh& mesh) {
  const Shells shells = FindShells(mesh);
  if (shells.count > kMaxShells) return 0;
  const std::vector<TriMesh> parts = SplitShells(mesh, shells);
  std::vector<bool> is_inverted(parts.size()), is_wrong(parts.size());
  for (size_t s = 0; s < parts.size(); ++s) is_inverted[s] = CalcVolume(parts[s]) < 0.0;
  for (size_t s = 0; s < parts.size(); ++s) {
    const std::vector<Eigen::Vector3d> points = SampleSurface(parts[s]);
    const auto lies_in = [&points](const TriMesh& other) {
      return std::all_of(points.begin(), points.end(),
                         [&](const Eigen::Vector3d& p) { return CalcWinding(other, p) != 0; });
    };
    size_t outermost = s;
    double largest = 0.0;
    for (size_t other = 0; other < parts.size(); ++other) {
      if (other == s || !lies_in(parts[other])) continue;
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

constexpr char kOneFlipped[] = "1 triangle flipped to face like its neighbours";
constexpr char kManyFlipped[] = " triangles flipped to face like their neighbours";
constexpr char kOneTurned[] = "1 shell turned the right way round";
constexpr char kManyTurned[] = " shells turned the right way round";

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

// Fills holes before seams: joining vertices across a small hole could crumple its rim.
void CloseUp(double max_share, double max_seam, MeshRepair& repair) {
  int num_holes = FillHoles(max_share, repair.mesh);
  Note(SewSeams(max_seam * CalcExtent(repair.mesh), repair.mesh), "1 vertex joined along a seam",
       " vertices joined along seams", repair);
  num_holes += FillHoles(max_share, repair.mesh);
  Note(num_holes, "1 hole closed", " holes closed", repair);
  Note(DropLooseSheets(max_share, repair.mesh), "1 loose triangle dropped",
       " loose triangles dropped", repair);
  DropUnusedVertices(repair.mesh);
}

}  // namespace

MeshRepair MendMesh(const TriMesh& mesh) {
  MeshRepair repair = {mesh, {}};
  if (!IsFinite(mesh) || mesh.triangles.empty()) return repair;
  DropUseless(repair);
  if (!repair.mesh.triangles.empty()) CloseUp(kMaxMendedHole, kMaxMendedSeam, repair);
  return repair;
}

MeshRepair FaceOutwards(const TriMesh& mesh) {
  MeshRepair repair = {mesh, {}};
  const double extent = IsFinite(mesh) ? CalcExtent(mesh) : 0.0;
  if (!(extent > 0.0) || !std::isfinite(extent)) return repair;
  TriMesh turned = WeldVertices(mesh, kRelativeWeldTolerance * extent);
  Note(Orient(turned), kOneFlipped, kManyFlipped, repair);
  if (IsWhole(ListEdges(turned))) Note(TurnShells(turned), kOneTurned, kManyTurned, repair);
  if (!repair.actions.empty()) repair.mesh = std::move(turned);
  return repair;
}

MeshRepair RepairMesh(const TriMesh& mesh) {
  MeshRepair repair = {mesh, {}};
  const double extent = IsFinite(mesh) ? CalcExtent(mesh) : 0.0;
  if (!(extent > 0.0) || !std::isfinite(extent)) return repair;
  if (mesh.num_triangles() > kMaxUsableTriangles) return repair;
  repair.mesh = WeldVertices(mesh, kRelativeWeldTolerance * extent);
  Note(mesh.num_vertices() - repair.mesh.num_vertices(),
       "1 vertex merged into its neighbour or unused",
       " vertices merged into their neighbours or unused", repair);
  DropUseless(repair);
  if (repair.mesh.triangles.empty()) return repair;
  Note(Orient(repair.mesh), kOneFlipped, kManyFlipped, repair);
  CloseUp(kMaxRepairedHole, kMaxRepairedSeam, repair);
  Orient(repair.mesh);  // the fans also belong to shells
  Note(TurnShells(repair.mesh), kOneTurned, kManyTurned, repair);
  return repair;
}

UsableMesh MakeUsable(const TriMesh& mesh, PartsApart parts_apart) {
  UsableMesh usable = {mesh, {}, CheckMesh(mesh, parts_apart)};
  MeshReport& first = usable.report;
  if (first.problems.empty() || first.num_triangles > kMaxUsableTriangles) return usable;
  if (first.num_triangles > kMaxMendedSoup && first.num_open_edges > first.num_triangles) {
    first.problems.push_back(
        {MeshFault::kOpen,
         "with " + std::to_string(first.num_triangles) +
             " triangles and more open edges than these it is too large to be mended; merge its "
             "vertices, and reduce it (decimate) to " +
             std::to_string(kMaxMendedSoup) + " triangles in a modelling program"});
    return usable;
  }
  MeshRepair mended = MendMesh(mesh);
  if (mended.actions.empty()) return usable;
  MeshReport report = CheckMesh(mended.mesh, parts_apart);
  if (!report.problems.empty()) return usable;
  return {std::move(mended.mesh), std::move(mended.actions), std::move(report)};
}

}  // namespace graspbench
