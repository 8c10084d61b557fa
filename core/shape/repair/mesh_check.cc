#include "core/shape/repair/mesh_check.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

#include "core/base/text/text.h"
#include "core/base/units.h"
#include "core/shape/mass_properties.h"
#include "core/shape/repair/mesh_topology.h"
#include "core/shape/triangle_tree.h"

namespace graspbench {
namespace {

constexpr int kMaxListed = 4;              // items listed per problem
constexpr int64_t kMaxCrossings = 200000;  // then counting stops
constexpr int64_t kMaxPairs = 50'000'000;  // of triangles whose boxes overlap: takes seconds
constexpr double kMinFlatness = 1e-9;      // volume over the cube of the extent; flat below

std::string FormatPoint(const Eigen::Vector3d& p) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", MmFromM(p.x()), MmFromM(p.y()), MmFromM(p.z()));
}

// Formats "a, b, c and 9 more".
template <class Item, class Format>
std::string FormatList(const std::vector<Item>& items, const Format& format, int64_t count) {
  std::string text;
  for (size_t i = 0; i < items.size() && i < kMaxListed; ++i) {
    text += (i ? ", " : "") + format(items[i]);
  }
  if (count > kMaxListed) text += " and " + std::to_string(count - kMaxListed) + " more";
  return text;
}
template <class Item, class Format>
std::string FormatList(const std::vector<Item>& items, const Format& format) {
  return FormatList(items, format, static_cast<int64_t>(items.size()));
}

// Compares twice the area with the square of the longest edge.
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

// Whether the open segment pq passes through the triangle. Touching from one side does not count.
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

// Two triangles cross when an edge of one passes through the other. Edges that meet the other
// triangle in a shared corner only touch it.
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

struct Crossings {
  int64_t count = 0;
  std::vector<std::pair<int, int>> first;  // the first few
  std::vector<bool> is_folded;             // by shell: whether it crosses itself
  int64_t num_pairs = 0;                   // tested; above kMaxPairs the result is undecided
};

Crossings FindCrossings(const TriMesh& mesh, const Shells& shells) {
  const TriangleTree tree(mesh);
  Crossings crossings;
  crossings.is_folded.assign(shells.count, false);
  std::vector<int> near, crossed;
  for (int i = 0; i < mesh.num_triangles(); ++i) {
    const Eigen::Vector3i& t = mesh.triangles[i];
    Eigen::AlignedBox3d box(mesh.vertices[t[0]]);
    box.extend(mesh.vertices[t[1]]).extend(mesh.vertices[t[2]]);
    near.clear();
    tree.FindNear(box, near);
    crossings.num_pairs += static_cast<int64_t>(near.size());
    if (crossings.num_pairs > kMaxPairs) break;
    crossed.clear();
    std::copy_if(near.begin(), near.end(), std::back_inserter(crossed),
                 [&](int j) { return j > i && AreCrossing(mesh, t, mesh.triangles[j]); });
    std::sort(crossed.begin(), crossed.end());
    for (const int j : crossed) {
      ++crossings.count;
      if (crossings.first.size() < kMaxListed) crossings.first.emplace_back(i, j);
      const int shell = shells.of_triangle[i];
      if (shells.of_triangle[j] == shell) crossings.is_folded[shell] = true;
    }
    if (crossings.count >= kMaxCrossings) {
      crossings.is_folded.assign(shells.count, true);
      break;
    }
  }
  return crossings;
}

// Returns the vertex with the most triangles and their number.
std::pair<int, int> FindCrowdedVertex(const TriMesh& mesh) {
  std::vector<int> counts(mesh.vertices.size());
  for (const Eigen::Vector3i& t : mesh.triangles) {
    for (const int corner : t) ++counts[static_cast<size_t>(corner)];
  }
  const auto most = std::max_element(counts.begin(), counts.end());
  return {static_cast<int>(most - counts.begin()), *most};
}

// Which of the two cyclic orders of its corners the triangle has.
bool IsEven(const Eigen::Vector3i& t) { return (t[0] < t[1]) + (t[1] < t[2]) + (t[2] < t[0]) == 2; }

class Checker {
 public:
  Checker(const TriMesh& mesh, PartsApart parts_apart)
      : mesh_(mesh),
        parts_apart_(parts_apart),
        edges_(ListEdges(mesh)),
        is_whole_(IsWhole(edges_)) {}

  MeshReport Check() {
    report_.num_triangles = mesh_.num_triangles();
    if (mesh_.triangles.empty()) {
      Add(MeshFault::kEmpty,
          "the mesh has no triangles; export faces, not points, lines or an empty scene");
      return report_;
    }
    if (!CheckFinite()) return report_;
    CheckSize();
    if (!CheckCount()) return report_;
    CheckFaces();
    CheckEdges();
    shells_ = FindShells(mesh_);
    if (shells_.count <= kMaxShells) parts_ = SplitShells(mesh_, shells_);
    CheckVolume();
    CheckCrossings();
    CheckBodies();
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

  bool CheckCount() {
    if (mesh_.num_triangles() <= kMaxUsableTriangles) return true;
    Add(MeshFault::kTooMany,
        "the mesh has " + std::to_string(mesh_.num_triangles()) + " triangles, and at most " +
            std::to_string(kMaxUsableTriangles) +
            " can be used; reduce it (decimate) to 50000 or fewer in a modelling program: things "
            "to grasp are resolved to 0.5 mm at best");
    return false;
  }

  void CheckSize() {
    report_.extent = CalcBounds(mesh_).sizes();
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
    } else if (const double least = report_.extent.minCoeff(); least < kThinnestMesh) {
      Warn(
          fmt::format("the mesh is {:.3g} mm thick, a sheet of paper 0.1 mm; is one of its axes "
                      "scaled otherwise?",
                      MmFromM(least)));
    }
  }

  void CheckFaces() {
    std::vector<int> degenerate;
    std::map<std::array<int, 3>, std::vector<int>> piles;  // faces with the same corners
    for (int i = 0; i < mesh_.num_triangles(); ++i) {
      const Eigen::Vector3i& t = mesh_.triangles[i];
      if (IsDegenerate(mesh_, t)) degenerate.push_back(i);
      std::array<int, 3> corners = {t[0], t[1], t[2]};
      std::sort(corners.begin(), corners.end());
      piles[corners].push_back(i);
    }
    const auto format_face = [&](int face) { return FormatFace(face); };
    if (!degenerate.empty()) {
      Warn(FormatCount(degenerate.size(), "triangle has", "triangles have") +
           " no area: " + FormatList(degenerate, format_face) + " [mm]");
    }
    std::vector<int> duplicates, shared;
    TriMesh single = {mesh_.vertices, {}};  // one face per pile
    for (const auto& [corners, pile] : piles) {
      const bool first = IsEven(mesh_.triangles[pile[0]]);
      const bool is_alike = std::all_of(pile.begin(), pile.end(), [&](int face) {
        return IsEven(mesh_.triangles[face]) == first;
      });
      std::vector<int>& found = is_alike && is_whole_ ? shared : duplicates;
      found.insert(found.end(), pile.begin() + 1, pile.end());
      single.triangles.push_back(mesh_.triangles[pile[0]]);
    }
    if (!shared.empty() && IsWhole(ListEdges(single))) {  // the copies are not needed
      duplicates.insert(duplicates.end(), shared.begin(), shared.end());
      shared.clear();
    }
    std::sort(duplicates.begin(), duplicates.end());
    std::sort(shared.begin(), shared.end());
    if (!duplicates.empty()) {
      Add(MeshFault::kDuplicate,
          FormatCount(duplicates.size(), "triangle exists", "triangles exist") + " twice: " +
              FormatList(duplicates, format_face) + " [mm]; delete the copies, or repair");
    }
    if (!shared.empty()) {
      Warn(FormatCount(shared.size(), "triangle is", "triangles are") +
           " part of several bodies: " + FormatList(shared, format_face) + " [mm]");
    }
  }

  void CheckEdges() {
    std::vector<MeshEdge> open, crowded, shared, opposed;
    for (const MeshEdge& edge : edges_) {
      const int count = edge.num_forward + edge.num_backward;
      if (count == 1) open.push_back(edge);
      if (count > 2) (edge.num_forward == edge.num_backward ? shared : crowded).push_back(edge);
      if (count == 2 && edge.num_forward != 1) opposed.push_back(edge);
    }
    report_.num_open_edges = static_cast<int>(open.size());
    report_.is_closed = open.empty() && crowded.empty();
    are_parts_joined_ = !shared.empty();
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
    if (!is_whole_) return;
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
      for (const Eigen::Vector3d& p : SampleSurface(shell)) {
        int winding = 0;
        for (const TriMesh& other : parts_) {
          if (&other != &shell) winding += CalcWinding(other, p);
        }
        if (winding >= 1) continue;
        ++num_inverted;
        break;
      }
    }
    if (num_inverted > 0) {
      Add(MeshFault::kInverted, std::to_string(num_inverted) + " of " +
                                    std::to_string(parts_.size()) +
                                    " parts are inside out; flip their faces, or repair");
    }
  }

  void CheckCrossings() {
    const Crossings crossings = FindCrossings(mesh_, shells_);
    if (crossings.num_pairs > kMaxPairs) {
      const auto [vertex, count] = FindCrowdedVertex(mesh_);
      Add(MeshFault::kTooMany,
          fmt::format("the mesh has {} triangles, {} of them at the corner {} [mm]: it takes more "
                      "than {} tests to tell whether they cross; reduce it (decimate) in a "
                      "modelling program",
                      mesh_.num_triangles(), count, FormatPoint(mesh_.vertices[vertex]),
                      kMaxPairs));
      return;
    }
    if (crossings.count > 0 && !AreFoldsSmall(crossings)) {
      Add(MeshFault::kSelfCrossing,
          FormatCrossings(crossings) + "; unite the parts (boolean union) in a modelling program");
      return;
    }
    if (!report_.problems.empty()) return;
    if (crossings.count == 0 && shells_.count == 1 && !are_parts_joined_) return;
    report_.overlap = CalcOverlap(mesh_);
    report_.volume -= report_.overlap.volume;
    report_.centroid = CalcSolidMassProperties(mesh_, 1.0, report_.overlap).p_OOcm;
    const auto format_share = [&](double volume) {
      return fmt::format("{:.3g} % of the volume", 100.0 * volume / report_.volume);
    };
    if (!(report_.overlap.inverted_volume < kMaxFoldedShare * report_.volume)) {
      Add(MeshFault::kInverted, format_share(report_.overlap.inverted_volume) +
                                    " lies in a surface that is inside out; flip its faces, or "
                                    "repair");
      return;
    }
    const std::string text =
        format_share(report_.overlap.absolute_volume) +
        (shells_.count > 1 ? " lies in several parts, counted" : " is counted") +
        " more than once and taken once";
    if (crossings.count > 0) {
      Warn(FormatCrossings(crossings) + ": " + text);
    } else if (report_.overlap.absolute_volume > 0.0) {
      Warn(text);
    }
  }

  void CheckBodies() {
    if (!report_.problems.empty() || shells_.count == 1 || shells_.count > kMaxShells) return;
    const double gap = std::min(kTouchingShare * report_.extent.maxCoeff(), kMaxTouchingGap);
    const Bodies bodies = FindBodies(mesh_, shells_, gap);
    const auto format = [&](const BodyCount& parts) {
      return FormatCount(parts.count, "part", "parts") +
             fmt::format(" with {:.3g} % of the volume, the first at ",
                         100.0 * parts.volume / report_.volume) +
             FormatPoint(parts.place) + " [mm], ";
    };
    const auto is_small = [&](const BodyCount& parts) {
      return parts.volume < kMaxStrayShare * report_.volume;
    };
    if (bodies.apart.count > 0) {
      const std::string text = format(bodies.apart) +
                               "apart from the rest, with which one rigid "
                               "object would carry them along";
      if (is_small(bodies.apart) || parts_apart_ == PartsApart::kMeant) {
        Warn(text);
      } else {
        Add(MeshFault::kApart, text +
                                   "; delete them, join them in a modelling program, or say "
                                   "separate_parts: true in object.yaml if it is meant");
      }
    }
    if (bodies.nested.count > 0) {
      const std::string text =
          format(bodies.nested) + "inside others and facing outwards as these do";
      if (is_small(bodies.nested)) {
        Warn(text);
      } else {
        Add(MeshFault::kNested, text +
                                    ": that space counts twice; flip their faces if they are "
                                    "cavities, delete them if the body is solid");
      }
    }
  }

  // Whether in every part that crosses itself the overlap is a small share of its volume.
  bool AreFoldsSmall(const Crossings& crossings) const {
    if (!is_whole_ || shells_.count > kMaxShells) return false;
    for (size_t i = 0; i < parts_.size(); ++i) {
      if (!crossings.is_folded[i]) continue;
      TriMesh part = parts_[i];
      const double volume = CalcVolume(part);
      if (volume < 0.0) {  // a cavity: test the body that would fill it
        for (Eigen::Vector3i& t : part.triangles) std::swap(t[1], t[2]);
      }
      if (!(CalcOverlap(part).absolute_volume < kMaxFoldedShare * std::abs(volume))) return false;
    }
    return true;
  }

  std::string FormatCrossings(const Crossings& crossings) const {
    const auto format_pair = [&](const std::pair<int, int>& pair) {
      return FormatFace(pair.first) + " and face " + std::to_string(pair.second + 1);
    };
    return (crossings.count >= kMaxCrossings ? "at least " : "") +
           FormatCount(crossings.count, "pair of triangles cuts", "pairs of triangles cut") +
           " through each other: " + FormatList(crossings.first, format_pair, crossings.count) +
           " [mm]";
  }

  const TriMesh& mesh_;
  const PartsApart parts_apart_;
  const std::vector<MeshEdge> edges_;
  const bool is_whole_;            // at every edge as many triangles run one way as the other
  bool are_parts_joined_ = false;  // at edges
  MeshReport report_;
  Shells shells_;
  std::vector<TriMesh> parts_;  // empty when there are too many
};

}  // namespace

MeshReport CheckMesh(const TriMesh& mesh, PartsApart parts_apart) {
  return Checker(mesh, parts_apart).Check();
}

std::string FormatProblems(const MeshReport& report) {
  std::string text;
  for (const MeshProblem& problem : report.problems)
    text += (text.empty() ? "" : "\n") + problem.text;
  return text;
}

}  // namespace graspbench
