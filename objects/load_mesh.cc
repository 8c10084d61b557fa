#include "objects/load_mesh.h"

#include <fmt/core.h>
#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>

#include "core/base/error.h"
#include "core/fence/fence.h"
#include "core/shape/repair/mesh_topology.h"
#include "objects/mesh_limits.h"

namespace graspbench {

namespace fs = std::filesystem;

namespace {

// A regular file in the folder or below it, links followed: the only ones that a mesh may name.
FindBeside FindIn(const fs::path& folder) {
  return [folder](const std::string& name) -> std::optional<fs::path> {
    if (folder.empty()) return std::nullopt;
    std::error_code status;
    const fs::path root = fs::canonical(folder, status);
    const fs::path path = fs::canonical(root / name, status);
    if (status || !fs::is_regular_file(path, status)) return std::nullopt;
    const fs::path inside = path.lexically_relative(root);
    if (inside.empty() || *inside.begin() == "..") return std::nullopt;
    return path;
  };
}

[[noreturn]] void Fail(const std::string& name, const std::string& what) {
  throw Error(ErrorKind::kFormat, "mesh \"" + name + "\"" + what);
}

std::string FindEnding(const std::string& name) {
  std::string format = fs::path(name).extension().string();
  if (!format.empty()) format.erase(0, 1);
  std::transform(format.begin(), format.end(), format.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return format;
}

// The ending in small letters, of a format that can be read.
std::string FindFormat(const std::string& name) {
  const std::string format = FindEnding(name);
  for (const char* known : {"obj", "stl", "ply", "glb", "gltf"}) {
    if (format == known) return format;
  }
  const std::string advice = "; export it as " + ListMeshFormats();
  if (format == "3ds") Fail(name, ": 3DS is not read, its axes are not certain" + advice);
  if (format == "dxf") Fail(name, ": DXF is not read, its axes are not certain" + advice);
  if (format == "dae") Fail(name, ": COLLADA is not read, its reader is not safe" + advice);
  if (!format.empty() && format.size() <= 5 &&
      std::all_of(format.begin(), format.end(), [](unsigned char c) { return std::isalnum(c); })) {
    std::string known_as = format;
    std::transform(format.begin(), format.end(), known_as.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    Fail(name, ": " + known_as + " is not read" + advice);
  }
  Fail(name, " has an ending that names no known format" + advice);
}

TriMesh RunReader(const FencedFile& file, const std::string& format, const fs::path& folder) {
  TriMesh mesh =
      Fence::Shared().Read<TriMesh>("mesh", file, FindIn(folder), kReaderSeconds, format);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    if (t.minCoeff() < 0 || t.maxCoeff() >= mesh.num_vertices())
      Fail(file.name(), ": read wrongly");
  }
  return mesh;
}

TriMesh ReadMesh(const FencedFile& file, const std::string& format, const fs::path& folder,
                 LengthUnit unit) {
  const std::string& name = file.name();
  struct stat properties = {};
  if (::fstat(file.id(), &properties) != 0 || properties.st_size == 0) {
    Fail(name, " is empty (0 bytes); export it again from its program");
  }
  if (properties.st_size > kMaxMeshFileBytes) Fail(name, " is larger than 256 MB; simplify it");
  TriMesh mesh = RunReader(file, format, folder);
  double largest = 0.0;
  bool is_finite = true;
  for (Eigen::Vector3d& p : mesh.vertices) {
    p *= MetresPer(unit);
    is_finite = is_finite && p.allFinite();
    largest = std::fmax(largest, p.cwiseAbs().maxCoeff());
  }
  if (largest == 0.0 || !is_finite) return mesh;
  TriMesh welded = WeldVertices(mesh, kRelativeWeldTolerance * largest);
  if (welded.triangles.empty() && !mesh.triangles.empty()) {
    Fail(name, fmt::format(" lies up to {:.3g} m from its origin, too far for its numbers to tell "
                           "its corners apart; move it to the origin",
                           largest));
  }
  return welded;
}

TriMesh ReadMeshFile(const fs::path& path, const std::string& format, LengthUnit unit) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  return ReadMesh(FencedFile(path), format, folder, unit);
}

}  // namespace

TriMesh RunMeshReader(const std::string& bytes, const std::string& format, const fs::path& folder,
                      const std::string& name) {
  return RunReader(FencedFile(bytes, name), format, folder);
}

std::string ListMeshFormats() { return "OBJ, STL, PLY, GLB or glTF"; }

TriMesh ParseMesh(const std::string& bytes, const std::string& name, LengthUnit unit) {
  const std::string format = FindFormat(name);
  return ReadMesh(FencedFile(bytes, name), format, {}, unit);
}

TriMesh LoadMesh(const fs::path& path, LengthUnit unit) {
  return ReadMeshFile(path, FindFormat(path.string()), unit);
}

TriMesh LoadPictureMesh(const fs::path& path) {
  const std::string format = FindEnding(path.string());
  return ReadMeshFile(path, format == "dae" ? format : FindFormat(path.string()), LengthUnit::kM);
}

}  // namespace graspbench
