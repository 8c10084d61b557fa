#include "core/shape/obj_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/shape/polygon.h"

namespace graspbench {
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

/** "7", "7/1/2", "-1" (the last vertex so far) to an index from 0. */
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
  /** What is wrong with the line; empty: nothing. */
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
             " corners and is not convex; cut such faces into triangles in the mesh's program";
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
  std::string joined;  // lines that end with a backslash
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
