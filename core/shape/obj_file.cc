#include "core/shape/obj_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>
#include <vector>

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

}  // namespace

TriMesh ParseObj(const std::string& text, const std::string& file, Diagnostics& problems) {
  TriMesh mesh;
  std::istringstream in(text);
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    const std::vector<std::string_view> words = SplitWords(line);
    if (words.empty()) continue;
    if (words[0] == "v") {
      Eigen::Vector3d& p = mesh.vertices.emplace_back();
      if (words.size() < 4 || !ParseCoordinate(words[1], p.x()) ||
          !ParseCoordinate(words[2], p.y()) || !ParseCoordinate(words[3], p.z())) {
        problems.Fail(file, number, "expected three finite numbers after v");
        return {};
      }
    } else if (words[0] == "f") {
      std::vector<int> corners(words.size() - 1);
      bool is_valid = corners.size() >= 3;
      for (size_t i = 0; i < corners.size(); ++i) {
        is_valid = ParseCorner(words[i + 1], mesh.num_vertices(), corners[i]) && is_valid;
      }
      if (!is_valid) {
        problems.Fail(file, number, "expected three or more numbers of vertices above after f");
        return {};
      }
      for (size_t i = 2; i < corners.size(); ++i) {
        mesh.triangles.emplace_back(corners[0], corners[i - 1], corners[i]);
      }
    }
  }
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
