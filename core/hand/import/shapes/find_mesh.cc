#include "core/hand/import/shapes/find_mesh.h"

#include "core/base/text/text.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr int kMostFoldersUp = 6;

struct Address {
  std::string package;  // empty: none
  fs::path path;        // below the package, or as given
};

bool StartsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

Address ParseAddress(std::string text) {
  std::replace(text.begin(), text.end(), '\\', '/');
  for (const char* scheme : {"package://", "model://"}) {
    if (!StartsWith(text, scheme)) continue;
    const std::string rest = text.substr(std::string(scheme).size());
    const size_t slash = rest.find('/');
    if (slash == std::string::npos) return {"", rest};
    return {rest.substr(0, slash), rest.substr(slash + 1)};
  }
  if (const std::string find = "$(find "; StartsWith(text, find)) {
    const size_t close = text.find(')');
    if (close != std::string::npos && close + 2 <= text.size()) {
      return {text.substr(find.size(), close - find.size()), text.substr(close + 2)};
    }
  }
  if (StartsWith(text, "file://")) text = text.substr(7);
  return {"", text};
}

/** A file of the folder whose name differs only in case; empty: none. */
fs::path FindInOtherLetters(const fs::path& path) {
  std::error_code status;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(path.parent_path(), status)) {
    if (ToLower(entry.path().filename().string()) == ToLower(path.filename().string()) &&
        entry.is_regular_file(status)) {
      found.push_back(entry.path());
    }
  }
  std::sort(found.begin(), found.end());
  return found.empty() ? fs::path() : found.front();
}

/** The URDF's folder and those above it. */
std::vector<fs::path> ListFoldersUp(const fs::path& folder) {
  std::error_code status;
  fs::path at = fs::absolute(folder, status).lexically_normal();
  if (!at.has_filename()) at = at.parent_path();
  std::vector<fs::path> folders;
  for (int i = 0; i < kMostFoldersUp && at.has_relative_path(); ++i) {
    folders.push_back(at);
    at = at.parent_path();
  }
  if (folders.empty()) folders.push_back(at);
  return folders;
}

}  // namespace

FoundMesh FindMesh(const std::string& text, const fs::path& folder,
                   const std::vector<fs::path>& package_path,
                   const std::vector<std::string>& endings) {
  const Address address = ParseAddress(text);
  const std::vector<fs::path> up = ListFoldersUp(folder);
  std::vector<fs::path> candidates;
  const auto add = [&](const fs::path& candidate) {
    const fs::path path = candidate.lexically_normal();
    if (std::find(candidates.begin(), candidates.end(), path) == candidates.end()) {
      candidates.push_back(path);
    }
  };
  if (address.path.is_absolute()) add(address.path);
  for (const fs::path& place : package_path) {
    if (!address.package.empty()) add(place / address.package / address.path);
    add(place / address.path.relative_path());
  }
  if (!address.package.empty()) {
    for (const fs::path& above : up) add(above / address.package / address.path);
  }
  if (!address.path.is_absolute()) {
    for (const fs::path& above : up) add(above / address.path);
  } else {
    const auto meshes = std::find(address.path.begin(), address.path.end(), fs::path("meshes"));
    fs::path rest;
    for (auto part = meshes; part != address.path.end(); ++part) rest /= *part;
    if (rest.empty()) rest = address.path.filename();
    for (const fs::path& above : up) add(above / rest);
  }
  FoundMesh found;
  std::error_code status;
  for (const fs::path& path : candidates) {
    if (fs::is_regular_file(path, status)) found.path = path;
    if (found.path.empty()) found.path = FindInOtherLetters(path);
    if (!found.path.empty()) return found;
    found.tried.push_back(path.string());
  }
  for (const fs::path& path : candidates) {
    for (const std::string& ending : endings) {
      fs::path other = path;
      other.replace_extension(ending);
      if (!fs::is_regular_file(other, status)) other = FindInOtherLetters(other);
      if (other.empty()) continue;
      found.path = other;
      found.is_other = true;
      return found;
    }
  }
  return found;
}

}  // namespace graspbench
