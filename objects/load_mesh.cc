#include "objects/load_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <regex>

#include "core/base/error.h"
#include "core/base/files/files.h"
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

[[noreturn]] void FailDamaged(const std::string& name, const std::string& what) {
  Fail(name, ": " + what + "; the file is cut off or damaged, export it again from its program");
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

// The text before the data of a PLY file. assimp 5.2 reads for ever in a header that is cut off or
// damaged, so every line must be one that the format knows, and in the lines of an ASCII file that
// is cut off, so all of them must be there.
void CheckPly(const std::string& bytes, const std::string& name) {
  static const std::regex kLine(
      "ply|format (ascii|binary_little_endian|binary_big_endian) 1\\.0|(comment|obj_info)[ -~]*|"
      "element \\w+ (\\d{1,9})|property (list \\w+ )?\\w+ \\w+|end_header");
  bool is_ascii = false;
  int64_t num_elements = 0;
  size_t begin = 0;
  std::string line;
  for (int line_number = 1; line != "end_header"; ++line_number) {
    const size_t end = bytes.find('\n', begin);
    if (end == std::string::npos) FailDamaged(name, "its PLY header has no end_header");
    line = bytes.substr(begin, std::min<size_t>(end - begin, 256));
    while (!line.empty() && (line.back() == '\r' || line.back() == ' ')) line.pop_back();
    std::smatch match;
    if (!std::regex_match(line, match, kLine)) {
      FailDamaged(name, "line " + std::to_string(line_number) +
                            " is not of a PLY header, or says more than 999999999 of something");
    }
    if (match[1] == "ascii") is_ascii = true;
    if (match[3].matched) num_elements += std::stoll(match[3]);
    begin = end + 1;
  }
  if (!is_ascii) return;
  int64_t num_lines =
      std::count(bytes.begin() + static_cast<std::ptrdiff_t>(begin), bytes.end(), '\n');
  if (bytes.back() != '\n') ++num_lines;
  if (num_lines < num_elements) {
    FailDamaged(name, "it has " + std::to_string(num_lines) + " of " +
                          std::to_string(num_elements) + " lines after its PLY header");
  }
}

constexpr size_t kStlHead = 84, kStlTriangle = 50;  // bytes

// assimp wants an ASCII file in small letters and a binary one without a byte too many; the format
// does not. Only what it would refuse is changed.
std::string TidyStl(const std::string& bytes) {
  if (bytes.size() > kStlHead) {
    uint32_t num_triangles = 0;
    std::memcpy(&num_triangles, bytes.data() + kStlHead - sizeof num_triangles,
                sizeof num_triangles);
    const size_t size = kStlHead + kStlTriangle * static_cast<size_t>(num_triangles);
    // Text read as a count is larger than any such file: four printable bytes are 5e8 triangles.
    if (num_triangles > 0 && size == bytes.size()) return bytes;
    if (num_triangles > 0 && size < bytes.size()) return bytes.substr(0, size);
  }
  std::string head = bytes.substr(0, 5);
  const auto lower = [](unsigned char c) { return static_cast<char>(std::tolower(c)); };
  std::transform(head.begin(), head.end(), head.begin(), lower);
  if (head != "solid") return bytes;
  std::string text = bytes;
  std::transform(text.begin(), text.end(), text.begin(), lower);
  return text;
}

// What a glTF file must be read with and is not.
void CheckGltf(const std::string& bytes, const std::string& name) {
  const size_t begin = bytes.find("\"extensionsRequired\"");
  if (begin == std::string::npos) return;
  const std::string required = bytes.substr(begin, bytes.find(']', begin) - begin);
  for (const char* extension :
       {"KHR_mesh_quantization", "EXT_meshopt_compression", "KHR_draco_mesh_compression"}) {
    if (required.find(extension) == std::string::npos) continue;
    Fail(name, std::string(" requires the glTF extension ") + extension +
                   ", which is not read; export it without");
  }
}

TriMesh ReadMesh(const std::string& bytes, const std::string& name, const std::string& format,
                 const fs::path& folder, LengthUnit unit) {
  if (bytes.empty()) Fail(name, " is empty (0 bytes); export it again from its program");
  if (static_cast<int64_t>(bytes.size()) > kMaxMeshFileBytes) {
    Fail(name, " is larger than 256 MB; simplify it");
  }
  if (bytes.rfind("version https://git-lfs", 0) == 0) {
    Fail(name, " is a Git LFS pointer, not the mesh itself; get it with: git lfs pull");
  }
  if (format == "ply") CheckPly(bytes, name);
  if (format == "gltf" || format == "glb") CheckGltf(bytes, name);
  TriMesh mesh = RunMeshReader(format == "stl" ? TidyStl(bytes) : bytes, format, folder, name);
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
  std::error_code status;
  if (const auto size = fs::file_size(path, status); !status && size > kMaxMeshFileBytes) {
    Fail(path.string(), " is larger than 256 MB; simplify it");
  }
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  return ReadMesh(ReadFile(path), path.string(), format, folder, unit);
}

}  // namespace

TriMesh RunMeshReader(const std::string& bytes, const std::string& format, const fs::path& folder,
                      const std::string& name) {
  TriMesh mesh = Fence::Shared().Read<TriMesh>("mesh", FencedFile(bytes, name), FindIn(folder),
                                               kReaderSeconds, format);
  for (const Eigen::Vector3i& t : mesh.triangles) {
    if (t.minCoeff() < 0 || t.maxCoeff() >= mesh.num_vertices()) Fail(name, ": read wrongly");
  }
  return mesh;
}

std::string ListMeshFormats() { return "OBJ, STL, PLY, GLB or glTF"; }

TriMesh ParseMesh(const std::string& bytes, const std::string& name, LengthUnit unit) {
  return ReadMesh(bytes, name, FindFormat(name), {}, unit);
}

TriMesh LoadMesh(const fs::path& path, LengthUnit unit) {
  return ReadMeshFile(path, FindFormat(path.string()), unit);
}

TriMesh LoadPictureMesh(const fs::path& path) {
  const std::string format = FindEnding(path.string());
  return ReadMeshFile(path, format == "dae" ? format : FindFormat(path.string()), LengthUnit::kM);
}

}  // namespace graspbench
