#include "core/shape/obj_file.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/shape/tri_mesh.h"

namespace graspbench {
namespace {

// Cutting a polygon of a mesh file into triangles.
/** Appends triangles that turn like the polygon. A fan about the first corner is used where it is
valid (every convex polygon); otherwise ears are cut off (Meisters 1975), in time quadratic in the
number of corners. A polygon that crosses itself also gives triangles: they close what it closes.
@param corners  at least three valid indices into the mesh's vertices, in order.
@param work     corner tests still allowed, reduced by what was spent.
@returns false, and appends nothing, when the work does not suffice. */
bool AppendPolygon(const std::vector<int>& corners, TriMesh& mesh, int64_t& work);

constexpr double kRounding = 1e-6;  // of coordinates against the extent

using Points = std::vector<Eigen::Vector2d>;

double CalcTurn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

// Projects the polygon along its mean normal, so that it runs counter-clockwise.
Points Flatten(const std::vector<int>& corners, const TriMesh& mesh) {
  const Eigen::Vector3d origin = mesh.vertices[corners[0]];
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (size_t i = 2; i < corners.size(); ++i) {
    normal += (mesh.vertices[corners[i - 1]] - origin).cross(mesh.vertices[corners[i]] - origin);
  }
  Eigen::Index axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  Eigen::Index u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0.0) std::swap(u, v);
  Points points;
  for (const int corner : corners) {
    const Eigen::Vector3d p = mesh.vertices[corner] - origin;
    points.emplace_back(p[u], p[v]);
  }
  return points;
}

// Whether the first corner sees every edge from the left, within the rounding of coordinates.
bool IsFan(const Points& points) {
  double extent = 0.0;
  for (const Eigen::Vector2d& p : points) extent = std::max(extent, p.norm());
  for (size_t i = 2; i < points.size(); ++i) {
    const double edge = (points[i] - points[i - 1]).norm();
    if (CalcTurn(points[0], points[i - 1], points[i]) < -kRounding * extent * edge) return false;
  }
  return true;
}

// The remaining polygon while its ears are cut off.
class Remainder {
 public:
  explicit Remainder(const Points& points) : points_(points) {
    const int count = static_cast<int>(points.size());
    for (int i = 0; i < count; ++i) {
      next_.push_back((i + 1) % count);
      previous_.push_back((i + count - 1) % count);
    }
    for (int i = 0; i < count; ++i) is_ear_.push_back(IsEar(i));
  }

  // Returns (previous, ear, next) as indices into the points. An ear has no other corner inside. A
  // polygon that crosses itself may have no ear: then the next corner is cut.
  Eigen::Vector3i CutEar() {
    const int start = here_;
    while (!is_ear_[here_] && next_[here_] != start) here_ = next_[here_];
    const int before = previous_[here_], after = next_[here_];
    Eigen::Vector3i ear(before, here_, after);
    next_[before] = after;
    previous_[after] = before;
    is_ear_[before] = IsEar(before);
    is_ear_[after] = IsEar(after);
    here_ = after;
    return ear;
  }

 private:
  bool IsEar(int i) const {
    const Eigen::Vector2d &a = points_[previous_[i]], &b = points_[i], &c = points_[next_[i]];
    if (CalcTurn(a, b, c) <= 0.0) return false;
    for (int k = next_[next_[i]]; k != previous_[i]; k = next_[k]) {
      const Eigen::Vector2d& p = points_[k];
      // A corner that coincides with a corner of the ear does not block it: two loops joined by a
      // bridge.
      if (p == a || p == b || p == c) continue;
      if (CalcTurn(a, b, p) >= 0.0 && CalcTurn(b, c, p) >= 0.0 && CalcTurn(c, a, p) >= 0.0) {
        return false;
      }
    }
    return true;
  }

  const Points& points_;
  std::vector<int> next_, previous_;
  std::vector<bool> is_ear_;
  int here_ = 0;
};

bool AppendPolygon(const std::vector<int>& corners, TriMesh& mesh, int64_t& work) {
  const int count = static_cast<int>(corners.size());
  const Points points = Flatten(corners, mesh);
  if (count == 3 || IsFan(points)) {
    for (int i = 2; i < count; ++i) {
      mesh.triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
    }
    return true;
  }
  const int64_t needed = 3 * static_cast<int64_t>(count) * count;
  if (needed > work) return false;
  work -= needed;
  Remainder remainder(points);
  for (int i = 2; i < count; ++i) {
    const Eigen::Vector3i ear = remainder.CutEar();
    mesh.triangles.emplace_back(corners[ear[0]], corners[ear[1]], corners[ear[2]]);
  }
  return true;
}

}  // namespace

namespace {

constexpr std::string_view kBlanks = " \t\r";

std::vector<std::string_view> SplitWords(std::string_view line) {
  std::vector<std::string_view> words;
  for (size_t at = 0; (at = line.find_first_not_of(kBlanks, at)) != line.npos;) {
    const size_t end = std::min(line.find_first_of(kBlanks, at), line.size());
    words.push_back(line.substr(at, end - at));
    at = end;
  }
  return words;
}

bool ParseCoordinate(std::string_view word, double& value) {
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);
  const char* const end = word.data() + word.size();
  const auto [next, status] = std::from_chars(word.data(), end, value);
  return status == std::errc() && next == end && std::isfinite(value);
}

/** Parses "7", "7/1/2" or "-1" (the last vertex so far) to an index from 0. */
bool ParseCorner(std::string_view word, int num_vertices, int& index) {
  const char* const end = word.data() + word.size();
  int number = 0;
  const auto [next, status] = std::from_chars(word.data(), end, number);
  if (status != std::errc() || (next != end && *next != '/')) return false;
  index = number < 0 ? num_vertices + number : number - 1;
  return index >= 0 && index < num_vertices;
}

class ObjReader {
 public:
  /** Returns what is wrong with the line; empty when nothing is. */
  std::string ReadLine(std::string_view line) {
    const std::vector<std::string_view> words = SplitWords(line);
    if (words.empty()) return {};
    if (words[0] == "v") return ReadVertex(words);
    if (words[0] == "f") return ReadFace(words);
    return {};
  }
  TriMesh TakeMesh() { return std::move(mesh_); }

 private:
  std::string ReadVertex(const std::vector<std::string_view>& words) {
    Eigen::Vector3d& p = mesh_.vertices.emplace_back();
    if (words.size() < 4 || !ParseCoordinate(words[1], p.x()) ||
        !ParseCoordinate(words[2], p.y()) || !ParseCoordinate(words[3], p.z())) {
      return "expected three finite numbers after v";
    }
    return {};
  }

  std::string ReadFace(const std::vector<std::string_view>& words) {
    corners_.resize(words.size() - 1);
    bool is_valid = corners_.size() >= 3;
    for (size_t i = 0; i < corners_.size(); ++i) {
      is_valid = ParseCorner(words[i + 1], mesh_.num_vertices(), corners_[i]) && is_valid;
    }
    if (!is_valid) return "expected three or more numbers of vertices above after f";
    if (!AppendPolygon(corners_, mesh_, polygon_work_)) {
      return "the face has " + std::to_string(corners_.size()) +
             " corners and is not convex; cut such faces into triangles in the program that made "
             "the mesh";
    }
    return {};
  }

  TriMesh mesh_;
  std::vector<int> corners_;
  int64_t polygon_work_ = 150'000'000;  // less than a second
};

}  // namespace

TriMesh ParseObj(const std::string& text, const std::string& file, Diagnostics& problems) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::string_view rest = text;
  if (rest.substr(0, 3) == kByteOrderMark) rest.remove_prefix(3);
  ObjReader reader;
  std::string joined;  // from lines that end with a backslash
  for (int number = 1; !rest.empty(); ++number) {
    const size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    const bool is_continued = !line.empty() && line.back() == '\\';
    if (is_continued) line.remove_suffix(1);
    if (is_continued || !joined.empty()) {
      joined.append(line).append(" ");
      line = joined;
    }
    if (is_continued) continue;
    const std::string problem = reader.ReadLine(line);
    joined.clear();
    if (problem.empty()) continue;
    problems.Fail(file, number, problem);
    return {};
  }
  TriMesh mesh = reader.TakeMesh();
  if (mesh.triangles.empty()) {
    problems.Fail(file, 0, "the mesh has no triangle");
    return {};
  }
  return mesh;
}

std::string FormatObj(const TriMesh& mesh, double units_per_metre) {
  std::string text;
  for (const Eigen::Vector3d& p : mesh.vertices) {
    // Adding zero turns "-0.000000" into "0.000000".
    const Eigen::Vector3d rounded = (p * units_per_metre * 1e6).array().round() / 1e6 + 0.0;
    text += fmt::format("v {:.6f} {:.6f} {:.6f}\n", rounded.x(), rounded.y(), rounded.z());
  }
  for (const Eigen::Vector3i& t : mesh.triangles) {
    text += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  }
  return text;
}

}  // namespace graspbench
