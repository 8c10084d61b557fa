#include "core/shape/mesh_check.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/shape/mass_properties.h"
#include "core/shape/mesh_edges.h"
#include "core/shape/mesh_shells.h"
#include "core/shape/triangle_tree.h"

namespace graspbench {
namespace {

constexpr int kMaxListed = 4;          // places reported per problem
constexpr int kMaxCrossings = 1000;    // then counting stops
constexpr double kMinFlatness = 1e-9;  // volume against the cube of the extent: flat below

std::string FormatPoint(const Eigen::Vector3d& p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", MmFromM(p.x()), MmFromM(p.y()), MmFromM(p.z()));
}

// "a, b, c and 9 more".
template <class Item, class Format>
std::string FormatList(const std::vector<Item>& items, const Format& format) {
  std::string text;
  for (size_t i = 0; i < items.size() && i < kMaxListed; ++i) {
    text += (i ? ", " : "") + format(items[i]);
  }
  if (items.size() > kMaxListed) {
    text += " and " + std::to_string(items.size() - kMaxListed) + " more";
  }
  return text;
}

// Twice the area against the square of the longest edge.
bool IsDegenerate(const TriMesh& mesh, const Eigen::Vector3i& t) {
  const Eigen::Vector3d& a = mesh.vertices[t[0]];
  const Eigen::Vector3d u = mesh.vertices[t[1]] - a, v = mesh.vertices[t[2]] - a;
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), (v - u).squaredNorm()});
  return !(u.cross(v).norm() > kMinAspect * longest);
}

double CalcOrientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                       const Eigen::Vector3d& p) {
  return (b - a).cross(c - a).dot(p - a);
}

// Does the open segment pq pass through the triangle? Touching from one side does not count.
bool IsCrossing(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& a,
                const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double scale = (b - a).norm() * (c - a).norm() * std::max((p - a).norm(), (q - a).norm());
  const double tolerance = 1e-9 * scale;
  const double at_p = CalcOrientation(a, b, c, p), at_q = CalcOrientation(a, b, c, q);
  const bool is_through =
      (at_p > tolerance && at_q < -tolerance) || (at_p < -tolerance && at_q > tolerance);
  if (!is_through) return false;
  const double ab = CalcOrientation(p, q, a, b), bc = CalcOrientation(p, q, b, c),
               ca = CalcOrientation(p, q, c, a);
  return (ab >= 0.0 && bc >= 0.0 && ca >= 0.0) || (ab <= 0.0 && bc <= 0.0 && ca <= 0.0);
}

// Two triangles cut each other when an edge of one passes through the other. Edges that meet the
// other triangle in a shared corner only touch it.
bool AreCrossing(const TriMesh& mesh, const Eigen::Vector3i& s, const Eigen::Vector3i& t) {
  const auto is_corner = [](int vertex, const Eigen::Vector3i& of) {
    return (of.array() == vertex).any();
  };
  const auto& v = mesh.vertices;
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if (!is_corner(s[k], t) && !is_corner(s[next], t) &&
        IsCrossing(v[s[k]], v[s[next]], v[t[0]], v[t[1]], v[t[2]])) {
      return true;
    }
    if (!is_corner(t[k], s) && !is_corner(t[next], s) &&
        IsCrossing(v[t[k]], v[t[next]], v[s[0]], v[s[1]], v[s[2]])) {
      return true;
    }
  }
  return false;
}

std::vector<std::pair<int, int>> FindCrossings(const TriMesh& mesh) {
  const TriangleTree tree(mesh);
  std::vector<std::pair<int, int>> crossings;
  std::vector<int> near;
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    Eigen::AlignedBox3d box(mesh.vertices[t[0]]);
    box.extend(mesh.vertices[t[1]]).extend(mesh.vertices[t[2]]);
    near.clear();
    tree.FindNear(box, near);
    std::sort(near.begin(), near.end());
    for (const int j : near) {
      if (j > i && AreCrossing(mesh, t, mesh.triangles[j])) crossings.emplace_back(i, j);
    }
    if (crossings.size() >= kMaxCrossings) break;
  }
  return crossings;
}

class Checker {
 public:
  explicit Checker(const TriMesh& mesh) : mesh_(mesh) {}

  MeshReport Check() {
    report_.num_triangles = mesh_.num_triangles();
    if (mesh_.triangles.empty()) {
      Add(MeshFault::kEmpty,
          "the mesh has no triangles; export faces, not points, lines or an empty scene");
      return report_;
    }
    if (!CheckFinite()) return report_;
    CheckSize();
    CheckFaces();
    CheckEdges();
    shells_ = FindShells(mesh_);
    if (shells_.count <= kMaxShells) parts_ = SplitShells(mesh_, shells_);
    CheckVolume();
    CheckCrossings();
    return report_;
  }

 private:
  void Add(MeshFault fault, const std::string& text) { report_.problems.push_back({fault, text}); }

  void Warn(const std::string& text) { report_.warnings.push_back(text + "; tolerated"); }

  std::string FormatFace(int face) const {
    const Eigen::Vector3i& t = mesh_.triangles[face];
    const Eigen::Vector3d centre =
        (mesh_.vertices[t[0]] + mesh_.vertices[t[1]] + mesh_.vertices[t[2]]) / 3.0;
    return "face " + std::to_string(face + 1) + " at " + FormatPoint(centre);
  }
  std::string FormatEdge(const MeshEdge& edge) const {
    return FormatPoint(mesh_.vertices[edge.from]) + "-" + FormatPoint(mesh_.vertices[edge.to]);
  }

  bool CheckFinite() {
    std::vector<int> bad;
    for (int i = 0; i < mesh_.num_vertices(); ++i) {
      if (!mesh_.vertices[i].allFinite()) bad.push_back(i);
    }
    if (bad.empty()) return true;
    Add(MeshFault::kNotFinite,
        FormatCount(bad.size(), "vertex is", "vertices are") + " not made of finite numbers: " +
            FormatList(bad, [](int i) { return "vertex " + std::to_string(i + 1); }) +
            "; export the mesh again");
    return false;
  }

  void CheckSize() {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : mesh_.vertices) box.extend(p);
    report_.extent = box.sizes();
    const double largest = report_.extent.maxCoeff();
    if (largest > kMaxMeshExtent) {
      Add(MeshFault::kSize,
          fmt::format("the mesh is {:.4g} m long; a thing to grasp measures {:.0f} mm to {:.0f} m. "
                      "If its numbers are millimetres, say so (unit mm); else scale it",
                      largest, MmFromM(kMinMeshExtent), kMaxMeshExtent));
    } else if (largest < kMinMeshExtent) {
      Add(MeshFault::kSize,
          fmt::format(
              "the mesh is {:.4g} mm long; a thing to grasp measures {:.0f} mm to {:.0f} m. "
              "If its numbers are metres, say so (unit m); else scale it",
              MmFromM(largest), MmFromM(kMinMeshExtent), kMaxMeshExtent));
    }
  }

  void CheckFaces() {
    std::vector<int> degenerate;
    std::vector<std::pair<std::array<int, 3>, int>> faces;
    for (int i = 0; i < mesh_.num_triangles(); ++i) {
      const Eigen::Vector3i& t = mesh_.triangles[i];
      if (IsDegenerate(mesh_, t)) degenerate.push_back(i);
      std::array<int, 3> corners = {t[0], t[1], t[2]};
      std::sort(corners.begin(), corners.end());
      faces.emplace_back(corners, i);
    }
    const auto format_face = [&](int face) { return FormatFace(face); };
    if (!degenerate.empty()) {
      Warn(FormatCount(degenerate.size(), "triangle has", "triangles have") +
           " no area: " + FormatList(degenerate, format_face) + " [mm]");
    }
    std::sort(faces.begin(), faces.end());
    std::vector<int> duplicates;
    for (size_t i = 1; i < faces.size(); ++i) {
      if (faces[i].first == faces[i - 1].first) duplicates.push_back(faces[i].second);
    }
    if (!duplicates.empty()) {
      Add(MeshFault::kDuplicate,
          FormatCount(duplicates.size(), "triangle exists", "triangles exist") + " twice: " +
              FormatList(duplicates, format_face) + " [mm]; delete the copies, or repair");
    }
  }

  void CheckEdges() {
    std::vector<MeshEdge> open, crowded, shared, opposed;
    for (const MeshEdge& edge : ListEdges(mesh_)) {
      const int count = edge.num_forward + edge.num_backward;
      if (count == 1) open.push_back(edge);
      if (count > 2) (edge.num_forward == edge.num_backward ? shared : crowded).push_back(edge);
      if (count == 2 && edge.num_forward != 1) opposed.push_back(edge);
    }
    report_.num_open_edges = static_cast<int>(open.size());
    report_.is_closed = open.empty() && crowded.empty();
    is_consistent_ = opposed.empty();
    const auto format_edge = [&](const MeshEdge& edge) { return FormatEdge(edge); };
    if (!open.empty()) {
      Add(MeshFault::kOpen,
          "the surface is open: " +
              FormatCount(open.size(), "edge has a triangle", "edges have a triangle") +
              " on one side only: " + FormatList(open, format_edge) +
              " [mm]; close the holes, or repair if they are small");
    }
    if (!crowded.empty()) {
      Add(MeshFault::kNotManifold,
          FormatCount(crowded.size(), "edge belongs", "edges belong") +
              " to more than two triangles that do not pair up: " +
              FormatList(crowded, format_edge) +
              " [mm]; delete inner walls, or unite the touching parts in a modelling program");
    }
    if (!shared.empty()) {
      Warn(FormatCount(shared.size(), "edge belongs", "edges belong") +
           " to more than two triangles, where parts touch: " + FormatList(shared, format_edge) +
           " [mm]");
    }
    if (!opposed.empty()) {
      Add(MeshFault::kInconsistent,
          FormatCount(opposed.size(), "edge joins", "edges join") +
              " triangles that face opposite ways: " + FormatList(opposed, format_edge) +
              " [mm]; flip one side of each, or repair");
    }
  }

  void CheckVolume() {
    if (!IsOriented()) return;
    report_.volume = CalcVolume(mesh_);
    const double cube = std::pow(report_.extent.maxCoeff(), 3);
    if (!(std::abs(report_.volume) > kMinFlatness * cube)) {
      Add(MeshFault::kInverted,
          "the mesh encloses no volume; give it thickness in a modelling program");
      return;
    }
    if (report_.volume < 0.0) {
      Add(MeshFault::kInverted,
          "the mesh is inside out: all its faces point inwards; flip them, or repair");
    } else if (shells_.count > 1 && shells_.count <= kMaxShells) {
      CheckShells();
    }
    report_.centroid = CalcSolidMassProperties(mesh_, 1.0).p_OOcm;
  }

  // A shell that faces inwards must be a cavity of another one.
  void CheckShells() {
    int num_inverted = 0;
    for (const TriMesh& shell : parts_) {
      if (CalcVolume(shell) >= 0.0) continue;
      const Eigen::Vector3d& p = mesh_.vertices[shell.triangles.front()[0]];
      int winding = 0;
      for (const TriMesh& other : parts_) {
        if (&other != &shell) winding += CalcWinding(other, p);
      }
      if (winding < 1) ++num_inverted;
    }
    if (num_inverted > 0) {
      Add(MeshFault::kInverted, std::to_string(num_inverted) + " of " +
                                    std::to_string(parts_.size()) +
                                    " parts are inside out; flip their faces, or repair");
    }
  }

  void CheckCrossings() {
    const std::vector<std::pair<int, int>> crossings = FindCrossings(mesh_);
    if (!crossings.empty() && !AreFoldsSmall(crossings)) {
      Add(MeshFault::kSelfCrossing,
          FormatCrossings(crossings) + "; unite the parts (boolean union) in a modelling program");
      return;
    }
    if (!report_.problems.empty() || (crossings.empty() && shells_.count == 1)) return;
    report_.overlap = CalcOverlap(mesh_);
    report_.volume -= report_.overlap.volume;
    report_.centroid = CalcSolidMassProperties(mesh_, 1.0, report_.overlap).p_OOcm;
    const double share = report_.overlap.absolute_volume / report_.volume;
    char text[120];
    std::snprintf(text, sizeof text, "%.2g %% of the volume %s more than once and taken once",
                  100.0 * share,
                  shells_.count > 1 ? "lies in several parts, counted" : "is counted");
    if (!crossings.empty()) {
      Warn(FormatCrossings(crossings) + ": " + text);
    } else if (share > 0.0) {
      Warn(text);
    }
  }

  // Does no part that cuts through itself count much of its volume wrongly?
  bool AreFoldsSmall(const std::vector<std::pair<int, int>>& crossings) const {
    if (!IsOriented() || shells_.count > kMaxShells) return false;
    const bool is_cut_short = crossings.size() >= kMaxCrossings;
    std::vector<bool> is_folded(parts_.size(), is_cut_short);
    for (const auto& [a, b] : crossings) {
      if (shells_.of_triangle[a] == shells_.of_triangle[b])
        is_folded[shells_.of_triangle[a]] = true;
    }
    for (size_t i = 0; i < parts_.size(); ++i) {
      if (!is_folded[i]) continue;
      TriMesh part = parts_[i];
      const double volume = CalcVolume(part);
      if (volume < 0.0) {  // a cavity: as the body that would fill it
        for (Eigen::Vector3i& t : part.triangles) std::swap(t[1], t[2]);
      }
      if (!(CalcOverlap(part).absolute_volume < kMaxFoldedShare * std::abs(volume))) return false;
    }
    return true;
  }

  std::string FormatCrossings(const std::vector<std::pair<int, int>>& crossings) const {
    const auto format_pair = [&](const std::pair<int, int>& pair) {
      return FormatFace(pair.first) + " and face " + std::to_string(pair.second + 1);
    };
    return (crossings.size() >= kMaxCrossings ? "at least " : "") +
           FormatCount(crossings.size(), "pair of triangles cuts", "pairs of triangles cut") +
           " through each other: " + FormatList(crossings, format_pair) + " [mm]";
  }

  bool IsOriented() const { return report_.is_closed && is_consistent_; }

  const TriMesh& mesh_;
  MeshReport report_;
  bool is_consistent_ = false;
  Shells shells_;
  std::vector<TriMesh> parts_;  // empty when there are too many
};

}  // namespace

MeshReport CheckMesh(const TriMesh& mesh) { return Checker(mesh).Check(); }

std::string FormatProblems(const MeshReport& report) {
  std::string text;
  for (const MeshProblem& problem : report.problems)
    text += (text.empty() ? "" : "\n") + problem.text;
  return text;
}

}  // namespace graspbench
