#include "objects/load_mesh.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <regex>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/shape/obj_file.h"
#include "core/shape/repair/mesh_topology.h"
#include "objects/mesh_reader_protocol.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMaxMessage = 200;

// A file without a name: the reader's input or output.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& content) : file_(::memfd_create("mesh", MFD_CLOEXEC)) {
    if (file_ < 0) Fail("memory for a mesh file");
    for (size_t written = 0; written < content.size();) {
      const ssize_t count = ::write(file_, content.data() + written, content.size() - written);
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) Fail("memory for a mesh file");
      written += static_cast<size_t>(count);
    }
    ::lseek(file_, 0, SEEK_SET);
  }
  ~MemoryFile() { ::close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[noreturn]] static void Fail(const std::string& what) {
    throw Error(ErrorKind::kEnvironment, "no " + what + ": " + std::strerror(errno));
  }
  int number() const { return file_; }
  size_t FindSize() const { return static_cast<size_t>(::lseek(file_, 0, SEEK_END)); }
  bool Read(size_t offset, void* data, size_t size) const {
    for (size_t done = 0; done < size;) {
      const ssize_t count = ::pread(file_, static_cast<char*>(data) + done, size - done,
                                    static_cast<off_t>(offset + done));
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      done += static_cast<size_t>(count);
    }
    return true;
  }

 private:
  int file_;
};

// Beside the program, as installed; else where it was built.
fs::path FindReader() {
  std::error_code status;
  const fs::path beside =
      fs::read_symlink("/proc/self/exe", status).parent_path() / "graspbench-mesh-reader";
  for (const fs::path& path : {beside, fs::path(GRASPBENCH_MESH_READER)}) {
    if (::access(path.c_str(), X_OK) == 0) return path;
  }
  throw Error(ErrorKind::kEnvironment,
              "the program graspbench-mesh-reader is missing; it belongs at \"" + beside.string() +
                  "\"; build or install graspbench again");
}

// The reader's exit status as of waitpid.
int RunReader(const std::string& format, const fs::path& folder, int input, int output) {
  const std::string reader = FindReader().string();
  const std::string place = folder.string();
  char* const arguments[] = {const_cast<char*>(reader.c_str()), const_cast<char*>(format.c_str()),
                             const_cast<char*>(place.c_str()), nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  ::posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t process = 0;
  const int failure =
      ::posix_spawn(&process, reader.c_str(), &actions, nullptr, arguments, environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) {
    errno = failure;
    MemoryFile::Fail("process for graspbench-mesh-reader");
  }
  int status = 0;
  while (::waitpid(process, &status, 0) < 0) {
    if (errno != EINTR) MemoryFile::Fail("answer from graspbench-mesh-reader");
  }
  return status;
}

// The reader's own words are partly the file's: nothing but printable characters reaches a
// terminal.
std::string ReadMessage(const MemoryFile& output) {
  std::string text(std::min(output.FindSize(), kMaxMessage), '\0');
  if (!output.Read(0, text.data(), text.size())) return {};
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

std::string DescribeFailure(int status, const MemoryFile& output) {
  if (WIFEXITED(status)) return ReadMessage(output);  // refused
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU || signal == SIGALRM) {
    return "reading it took longer than " + std::to_string(kMeshReaderSeconds) + " s";
  }
  return "reading it failed with signal " + std::to_string(signal) + ", perhaps for lack of memory";
}

bool ReadSoup(const MemoryFile& output, TriMesh& mesh) {
  MeshReaderHead head;
  if (!output.Read(0, &head, sizeof head) || head.num_vertices < 0 || head.num_triangles < 0 ||
      head.num_vertices > 3 * kMaxMeshTriangles || head.num_triangles > kMaxMeshTriangles) {
    return false;
  }
  mesh.vertices.resize(static_cast<size_t>(head.num_vertices));
  mesh.triangles.resize(static_cast<size_t>(head.num_triangles));
  const size_t size = mesh.vertices.size() * sizeof mesh.vertices[0];
  if (!output.Read(sizeof head, mesh.vertices.data(), size) ||
      !output.Read(sizeof head + size, mesh.triangles.data(),
                   mesh.triangles.size() * sizeof mesh.triangles[0])) {
    return false;
  }
  for (const Eigen::Vector3i& t : mesh.triangles) {
    if (t.minCoeff() < 0 || t.maxCoeff() >= mesh.num_vertices()) return false;
  }
  return true;
}

}  // namespace

TriMesh RunMeshReader(const std::string& bytes, const std::string& format, const fs::path& folder,
                      const std::string& name) {
  const MemoryFile input(bytes), output("");
  const int status = RunReader(format, folder, input.number(), output.number());
  TriMesh mesh;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kMeshRead && ReadSoup(output, mesh)) return mesh;
  if (WIFEXITED(status) && WEXITSTATUS(status) != kMeshRefused) {
    throw Error(ErrorKind::kEnvironment,
                "the reader of meshes failed on \"" + name + "\" (exit " +
                    std::to_string(WEXITSTATUS(status)) +
                    "): a fault of the reader, not of the file; build or install graspbench again, "
                    "and report the file if that does not help");
  }
  throw Error(ErrorKind::kFormat, "mesh \"" + name + "\" cannot be read (" +
                                      DescribeFailure(status, output) +
                                      "); the file may be cut off or damaged, export it again from "
                                      "its program");
}

namespace {

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

// The nearest number of single precision, whole and fractional part each: the catalogue's recorded
// results stand on coordinates read so.
double RoundToSingle(double value) {
  const double whole = std::trunc(value);
  return static_cast<float>(whole) + static_cast<float>(value - whole);
}

TriMesh ReadObj(const std::string& bytes, const std::string& name) {
  Diagnostics problems;
  TriMesh mesh = ParseObj(bytes, name, problems);
  problems.ThrowIfErrors(ErrorKind::kFormat, "the mesh cannot be read");
  if (mesh.num_triangles() > kMaxMeshTriangles) {
    Fail(name, " has more than " + std::to_string(kMaxMeshTriangles) + " triangles; simplify it");
  }
  for (Eigen::Vector3d& p : mesh.vertices) p = p.unaryExpr(&RoundToSingle);
  return mesh;
}

TriMesh ReadMesh(const std::string& bytes, const std::string& name, const std::string& format,
                 const fs::path& folder, LengthUnit unit) {
  if (bytes.empty()) Fail(name, " is empty (0 bytes); export it again from its program");
  if (static_cast<int64_t>(bytes.size()) > kMaxMeshFileBytes) {
    Fail(name, " is larger than 256 MB; simplify it");
  }
  if (format == "ply") CheckPly(bytes, name);
  TriMesh mesh =
      format == "obj" ? ReadObj(bytes, name) : RunMeshReader(bytes, format, folder, name);
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
