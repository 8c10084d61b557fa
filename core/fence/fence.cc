#include "core/fence/fence.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "core/base/files/open_file.h"
#include "core/fence/serve_fence.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

constexpr int kWallPerProcessorTime = 6;  // where the machine is busy or its disk slow
constexpr char kProgram[] = "graspbench-reader";
constexpr size_t kPiece = size_t{1} << 20;  // of an answer

[[noreturn]] void FailEnvironment(const std::string& what) {
  throw Error(ErrorKind::kEnvironment, "no " + what + ": " + std::strerror(errno));
}

int MakeMemoryFile() {
  const int file = ::memfd_create("fence", MFD_CLOEXEC);
  if (file < 0) FailEnvironment("memory for a foreign file");
  return file;
}

void WriteMemoryFile(int file, std::string_view bytes) {
  for (size_t written = 0; written < bytes.size();) {
    const ssize_t count =
        ::pwrite(file, bytes.data() + written, bytes.size() - written, static_cast<off_t>(written));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) FailEnvironment("memory for a foreign file");
    written += static_cast<size_t>(count);
  }
}

// Beside the program, as installed; else where it was built.
fs::path FindProgram() {
  std::error_code status;
  const fs::path beside = fs::read_symlink("/proc/self/exe", status).parent_path() / kProgram;
  for (const fs::path& path : {beside, fs::path(GRASPBENCH_READER)}) {
    if (::access(path.c_str(), X_OK) == 0) return path;
  }
  throw Error(ErrorKind::kEnvironment, std::string("the program ") + kProgram +
                                           " is missing; it belongs at \"" + beside.string() +
                                           "\"; build or install graspbench again");
}

// What ended a reader, from the status that waitpid gives.
[[noreturn]] void FailEnded(int status, const std::string& name, int seconds) {
  const std::string subject = "\"" + name + "\" cannot be read (";
  if (WIFEXITED(status) && WEXITSTATUS(status) != kFenceNoMemory) {
    throw Error(ErrorKind::kEnvironment,
                subject + std::string(kProgram) + " ended with exit code " +
                    std::to_string(WEXITSTATUS(status)) +
                    "): a fault of the reader, not of the file; build or install graspbench again, "
                    "and report the file if that does not help");
  }
  if (WIFEXITED(status)) {
    throw Error(ErrorKind::kFormat,
                subject +
                    "reading it takes more memory than 1 GB and four times its size); the file may "
                    "be damaged, export it again from its program or cut it into smaller ones");
  }
  const int signal = WTERMSIG(status);
  if (signal == SIGPROF) {
    throw Error(ErrorKind::kEnvironment, subject + "reading it takes more than " +
                                             std::to_string(seconds) +
                                             " s of processor time); leave the file out, or cut it "
                                             "into smaller ones");
  }
  if (signal == SIGKILL || signal == SIGBUS || signal == SIGTERM) {
    throw Error(ErrorKind::kEnvironment,
                subject + "its reader was ended by signal " + std::to_string(signal) +
                    "); the machine may lack memory, or the disk fail: try again");
  }
  const char* const description = ::sigdescr_np(signal);
  throw Error(ErrorKind::kFormat,
              subject + "its reader ended by signal " + std::to_string(signal) +
                  (description ? ", " + std::string(description) : "") +
                  ", while reading it); the file is damaged or holds what the reader does not "
                  "bear: export it again from its program or in another format, else leave it out");
}

}  // namespace

FencedFile::FencedFile(const fs::path& path) : id_(OpenRegularFile(path)), name_(path.string()) {}

FencedFile::FencedFile(std::string_view bytes, std::string name)
    : id_(MakeMemoryFile()), name_(std::move(name)) {
  WriteMemoryFile(id_, bytes);
}

FencedFile::~FencedFile() { ::close(id_); }

FencedAnswer::FencedAnswer(std::unique_ptr<FencedFile> file) : file_(std::move(file)) {
  struct stat properties = {};
  if (::fstat(file_->id(), &properties) != 0) FailEnvironment("answer of a reader");
  size_ = static_cast<size_t>(properties.st_size);
}

IncomingValues FencedAnswer::values() {
  return {size_ - num_fetched_ + piece_.size() - num_taken_,
          [this](void* data, size_t size) { Take(static_cast<char*>(data), size); }};
}

void FencedAnswer::Take(char* data, size_t size) {
  const size_t num_here = std::min(size, piece_.size() - num_taken_);
  std::memcpy(data, piece_.data() + num_taken_, num_here);
  num_taken_ += num_here;
  data += num_here;
  size -= num_here;
  for (; size >= kPiece; data += kPiece, size -= kPiece) Fetch(data, kPiece);
  if (size == 0) return;
  piece_.resize(std::min(kPiece, size_ - num_fetched_));
  Fetch(piece_.data(), piece_.size());
  std::memcpy(data, piece_.data(), size);
  num_taken_ = size;
}

void FencedAnswer::Fetch(char* data, size_t size) {
  while (size > 0) {
    const ssize_t count = ::pread(file_->id(), data, size, static_cast<off_t>(num_fetched_));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw Error(ErrorKind::kFormat, "an answer that is none");
    data += count;
    size -= static_cast<size_t>(count);
    num_fetched_ += static_cast<size_t>(count);
  }
  if (num_fetched_ == size_) return;
  ::fallocate(file_->id(), FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, 0,
              static_cast<off_t>(num_fetched_));
}

// One process. Ends it: idle it ends by itself when its socket closes.
struct Fence::Reader {
  ~Reader() {
    if (socket >= 0) ::close(socket);
    if (process > 0) Wait();
  }
  int Wait() {
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
    process = 0;
    return status;
  }
  // What it says next; nothing: it has ended, and is ended here where it took too long.
  std::optional<FencePacket> Receive(int seconds) {
    pollfd waiting = {socket, POLLIN, 0};
    int count = -1;
    while ((count = ::poll(&waiting, 1, 1000 * seconds)) < 0 && errno == EINTR) continue;
    if (count <= 0) ::kill(process, SIGPROF);  // as when it has used up its time
    return count <= 0 ? std::nullopt : ReceiveFencePacket(socket);
  }

  pid_t process = 0;
  int socket = -1;
};

Fence::Fence(fs::path program) : program_(std::move(program)) {}

Fence::~Fence() = default;

Fence& Fence::Shared() {
  static Fence fence(FindProgram());
  return fence;
}

std::unique_ptr<Fence::Reader> Fence::Start() const {
  int pair[2];
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair) != 0) {
    FailEnvironment(std::string("socket for ") + kProgram);
  }
  auto reader = std::make_unique<Reader>();
  reader->socket = pair[0];
  const std::string program = program_.string();
  char* const arguments[] = {const_cast<char*>(program.c_str()), nullptr};
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  ::posix_spawn_file_actions_adddup2(&actions, pair[1], STDIN_FILENO);
  for (const int file : {STDOUT_FILENO, STDERR_FILENO}) {  // what is written there is lost
    ::posix_spawn_file_actions_addopen(&actions, file, "/dev/null", O_RDONLY, 0);
  }
  const int failure =
      ::posix_spawn(&reader->process, program.c_str(), &actions, nullptr, arguments, environ);
  ::posix_spawn_file_actions_destroy(&actions);
  ::close(pair[1]);
  if (failure != 0) {
    reader->process = 0;
    errno = failure;
    FailEnvironment(std::string("process for ") + kProgram);
  }
  return reader;
}

std::unique_ptr<FencedAnswer> Fence::Run(const std::string& reader, const FencedFile& file,
                                         const FindBeside& find_beside, int seconds,
                                         const std::string& arguments) {
  std::unique_ptr<Reader> process;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!idle_.empty()) {
      process = std::move(idle_.back());
      idle_.pop_back();
    }
  }
  OutgoingValues values;
  std::string asked = reader, name = file.name(), sent = arguments;
  Cross(values, asked, name, seconds, sent);
  const FencedFile request(values.bytes(), "");
  auto output = std::make_unique<FencedFile>(std::string_view(), "");
  const std::vector<int> files = {request.id(), file.id(), output->id()};
  if (!process || !SendFencePacket(process->socket, std::string(1, kRequest), files)) {
    process = Start();  // the idle one may have been ended by somebody
    SendFencePacket(process->socket, std::string(1, kRequest), files);
  }
  for (;;) {
    const std::optional<FencePacket> packet = process->Receive(kWallPerProcessorTime * seconds);
    if (!packet || packet->text.empty()) FailEnded(process->Wait(), file.name(), seconds);
    for (const int extra : packet->files) ::close(extra);  // it has none to give
    if (packet->text[0] == kDone) break;
    std::optional<FencedFile> beside;
    try {
      const auto path =
          find_beside ? find_beside(packet->text.substr(1)) : std::optional<fs::path>();
      if (path) beside.emplace(*path);
    } catch (const Error& error) {  // it is not there; else the reader goes, and so does the read
      if (error.kind() != ErrorKind::kNotFound) throw;
    }
    SendFencePacket(process->socket, std::string(1, kBeside),
                    beside ? std::vector<int>{beside->id()} : std::vector<int>());
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    idle_.push_back(std::move(process));
  }
  auto answer = std::make_unique<FencedAnswer>(std::move(output));
  char status = kIsRead;
  answer->values().Bytes(&status, 1);
  if (status == kIsRead) return answer;
  IncomingValues refusal = answer->values();
  ErrorKind kind = ErrorKind::kFormat;
  std::string message;
  Cross(refusal, kind, message);
  throw Error(kind, message);
}

}  // namespace graspbench
