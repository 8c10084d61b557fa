#include "objects/run_mesh_reader.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "core/base/error.h"
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

}  // namespace graspbench
