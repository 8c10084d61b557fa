#include "core/base/files/files.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>
#include <utility>

#include "core/base/error.h"
#include "core/base/files/open_file.h"
#include "core/base/hash.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

struct OpenedFile {
  ~OpenedFile() {
    if (id >= 0) ::close(id);
  }
  int id;
};

OpenedFile OpenFolder(const fs::path& folder) {
  return {::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
}

int Create(const fs::path& path) {
  return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
}

/** Throws an error of kind kIo with the reason in errno. */
[[noreturn]] void Fail(const std::string& task, const fs::path& path) {
  const std::string reason = std::strerror(errno);
  throw Error(ErrorKind::kIo, "cannot " + task + " \"" + path.string() + "\": " + reason);
}

constexpr size_t kPieceSize = 1 << 18;     // bytes per read
constexpr size_t kMostReserved = 1 << 26;  // reserved at most, whatever size a file reports [bytes]
constexpr size_t kGathered = 1 << 16;      // shorter pieces are written together [bytes]
constexpr char kPartSuffix[] = ".part";
constexpr size_t kRandomSize = 16;    // characters of MakeRandomName
constexpr size_t kLongestName = 200;  // longer names are shortened [bytes]

/** Identifies the host and process namespace whose process ids this process can check. Another host
that shares the disk uses the same ids for other processes. */
const std::string& FindProcessRealm() {
  static const std::string realm = [] {
    char host[256] = "";
    ::gethostname(host, sizeof host - 1);
    struct stat processes {};
    ::stat("/proc/self/ns/pid", &processes);
    return CalcHashHex(host + std::to_string(processes.st_ino)).substr(0, 8);
  }();
  return realm;
}

/** Whether the process has ended, even if its parent has not waited for it yet (a zombie). */
bool HasEnded(pid_t process) {
  if (::kill(process, 0) != 0) return errno == ESRCH;
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  const std::string stat((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const size_t name_end = stat.rfind(") ");  // the name may contain any character
  return name_end != std::string::npos && stat.size() > name_end + 2 && stat[name_end + 2] == 'Z';
}

/** Removes the partial files of processes that were killed while they wrote the file. */
void RemoveLeftParts(const fs::path& path) {
  const std::string suffix = "-" + FindProcessRealm() + "-";
  const std::string prefix = ShortenName(path.filename().string()) + kPartSuffix;
  std::error_code status;
  fs::directory_iterator entry(path.has_parent_path() ? path.parent_path() : fs::path("."), status);
  for (; !status && entry != fs::directory_iterator(); entry.increment(status)) {
    const std::string name = entry->path().filename().string();
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    pid_t writer = 0;
    const char* end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + prefix.size(), end, writer);
    const size_t id_end = static_cast<size_t>(rest - name.data());
    if (error != std::errc() || writer <= 0 || name.compare(id_end, suffix.size(), suffix) != 0 ||
        name.size() != id_end + suffix.size() + kRandomSize) {
      continue;
    }
    if (HasEnded(writer)) ::unlink(entry->path().c_str());
  }
}

/** Whether the error may be transient, as on a network disk. */
bool IsPassing(int reason) { return reason == ESTALE || reason == EIO || reason == EINTR; }

/** Calls `work`, up to four times while it returns -1 with an error that may be transient. */
template <class Work>
auto TryPatiently(const Work& work) {
  using std::chrono::milliseconds;
  for (const milliseconds wait : {milliseconds(10), milliseconds(90), milliseconds(400)}) {
    const auto result = work();
    if (result != -1 || !IsPassing(errno)) return result;
    if (errno != EINTR) std::this_thread::sleep_for(wait);
  }
  return work();
}

/** A regular file, open for reading. @throws Error(kNotFound, kIo). */
class ReadableFile {
 public:
  explicit ReadableFile(const fs::path& path) : path_(path), file_{-1} {
    if (TryPatiently([&] { return Open(); }) < 0) {
      if (errno == ENOENT || errno == ENOTDIR || errno == ENAMETOOLONG || errno == ELOOP) {
        throw Error(ErrorKind::kNotFound, "no file \"" + path.string() + "\"");
      }
      if (errno == ENXIO) RefuseDevice();
      Fail("read", path);
    }
    struct stat properties = {};
    if (TryPatiently([&] { return ::fstat(file_.id, &properties); }) != 0) Fail("read", path);
    if (S_ISDIR(properties.st_mode)) {
      throw Error(ErrorKind::kIo, "\"" + path.string() + "\" is a folder; a file was expected");
    }
    if (!S_ISREG(properties.st_mode)) RefuseDevice();
    size_ = static_cast<uintmax_t>(properties.st_size);
  }

  /** Size when the file was opened [bytes]. */
  uintmax_t size() const { return size_; }
  /** Returns the open file, which the caller must close. */
  int Release() { return std::exchange(file_.id, -1); }

  /** @returns the number of bytes read; 0 at the end of the file. */
  size_t Read(uintmax_t start, char* data, size_t size) {
    const ssize_t count = TryPatiently([&]() -> ssize_t {
      const ssize_t read = ::pread(file_.id, data, size, static_cast<off_t>(start));
      const int reason = errno;
      if (read < 0 && reason != EINTR) Open();  // a stale handle never recovers
      errno = reason;
      return read;
    });
    if (count < 0) Fail("read", path_);
    return static_cast<size_t>(count);
  }

 private:
  int Open() {
    const int file =
        ::open(path_.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);  // do not wait on a FIFO
    if (file < 0) return -1;
    if (file_.id >= 0) ::close(file_.id);
    return file_.id = file;
  }
  [[noreturn]] void RefuseDevice() const {
    throw Error(ErrorKind::kIo,
                "\"" + path_.string() + "\" is a device, a pipe or a socket; a file was expected");
  }

  fs::path path_;
  OpenedFile file_;
  uintmax_t size_ = 0;
};

class FileBuffer : public std::streambuf {
 public:
  explicit FileBuffer(const fs::path& path) : file_(path), piece_(kGathered, '\0') {}

 protected:
  int_type underflow() override {
    const size_t count = file_.Read(end_, piece_.data(), piece_.size());
    setg(piece_.data(), piece_.data(), piece_.data() + count);
    end_ += count;
    return count == 0 ? traits_type::eof() : traits_type::to_int_type(*gptr());
  }
  pos_type seekoff(off_type offset, std::ios_base::seekdir from, std::ios_base::openmode) override {
    const off_type here = static_cast<off_type>(end_) - (egptr() - gptr());
    const off_type start = from == std::ios_base::beg   ? 0
                           : from == std::ios_base::cur ? here
                                                        : static_cast<off_type>(file_.size());
    if (start + offset < 0) return pos_type(off_type(-1));
    if (start + offset == here) return here;
    end_ = static_cast<uintmax_t>(start + offset);
    setg(piece_.data(), piece_.data(), piece_.data());
    return start + offset;
  }
  pos_type seekpos(pos_type position, std::ios_base::openmode mode) override {
    return seekoff(off_type(position), std::ios_base::beg, mode);
  }

 private:
  ReadableFile file_;
  std::string piece_;
  uintmax_t end_ = 0;  // end of the piece, as an offset in the file
};

class FileStream : public std::istream {
 public:
  explicit FileStream(const fs::path& path) : std::istream(nullptr), buffer_(path) {
    rdbuf(&buffer_);
    exceptions(std::ios::badbit);  // a failed read is not taken for the end of the file
  }

 private:
  FileBuffer buffer_;
};

/** Returns false and sets errno when part of the content could not be written. */
[[nodiscard]] bool WriteAll(int file, std::string_view content) {
  for (size_t written = 0; written < content.size();) {
    const ssize_t count = ::write(file, content.data() + written, content.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    written += static_cast<size_t>(count);
  }
  return true;
}

}  // namespace

std::string MakeRandomName() {
  std::array<unsigned char, kRandomSize / 2> bytes{};
  while (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    if (errno == EINTR) continue;
    throw Error(ErrorKind::kEnvironment,
                std::string("the system gives no random numbers: ") + std::strerror(errno));
  }
  std::string name;
  for (const unsigned char byte : bytes) {
    for (const int digit : {byte >> 4, byte & 15}) name += "0123456789abcdef"[digit];
  }
  return name;
}

std::string ShortenName(const std::string& name) {
  if (name.size() <= kLongestName) return name;
  const std::string hash = "~" + CalcHashHex(name).substr(0, 16);
  size_t size = kLongestName - hash.size();
  // Do not cut a UTF-8 character.
  while (size > 0 && (static_cast<unsigned char>(name[size]) & 0xc0) == 0x80) --size;
  return name.substr(0, size) + hash;
}

fs::path FindDataRoot() {
  const char* home = std::getenv("GRASPBENCH_HOME");
  if (home && *home) return fs::path(home);
  // The installed data, even if the installation was moved; else the source tree.
  static const fs::path root = [] {
    std::error_code status;
    const fs::path program = fs::read_symlink("/proc/self/exe", status);
    const fs::path installed = program.parent_path().parent_path() / "share" / "graspbench";
    return fs::is_directory(installed / "objects" / "catalogue", status)
               ? installed
               : fs::path(GRASPBENCH_SOURCE_DIR);
  }();
  return root;
}

fs::path FindCacheRoot() {
  // The XDG Base Directory Specification says to ignore a relative path.
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache == '/') {
    return fs::path(cache) / "graspbench";
  }
  if (const char* home = std::getenv("HOME"); home && *home) {
    return fs::path(home) / ".cache" / "graspbench";
  }
  const fs::path folder = fs::temp_directory_path() / ("graspbench-" + std::to_string(::geteuid()));
  try {
    MakePrivateFolder(folder);
  } catch (const Error&) {
    return "/dev/null/graspbench";  // cannot be made or belongs to somebody else: nothing is cached
  }
  return folder;
}

int OpenRegularFile(const fs::path& path) { return ReadableFile(path).Release(); }

std::string ReadFile(const fs::path& path) {
  std::string content;
  std::error_code status;
  const auto size = fs::file_size(path, status);
  if (!status) content.reserve(std::min<uintmax_t>(size, kMostReserved));
  ReadPieces(path, [&](std::string_view piece) {
    content += piece;
    return true;
  });
  return content;
}

void ReadPieces(const fs::path& path, const std::function<bool(std::string_view)>& take,
                uintmax_t start) {
  ReadableFile file(path);
  std::string piece(kPieceSize, '\0');
  while (true) {
    const size_t count = file.Read(start, piece.data(), piece.size());
    if (count == 0 || !take(std::string_view(piece).substr(0, count))) return;
    start += count;
  }
}

std::unique_ptr<std::istream> OpenStream(const fs::path& path) {
  return std::make_unique<FileStream>(path);
}

void MakeFolder(const fs::path& folder) {
  std::error_code status;
  fs::create_directories(folder, status);
  errno = status.value();
  if (status) Fail("create folder", folder);
}

void MakePrivateFolder(const fs::path& folder) {
  if (folder.has_parent_path()) MakeFolder(folder.parent_path());
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) Fail("create folder", folder);
  const OpenedFile file{::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC)};
  if (file.id < 0 || ::fchmod(file.id, 0700) != 0 || !IsPrivateFolder(folder)) {
    throw Error(ErrorKind::kIo, "\"" + folder.string() +
                                    "\" is not a folder of this user's own; remove it, or name "
                                    "another one");
  }
}

bool IsPrivateFolder(const fs::path& folder) {
  struct stat status = {};
  return ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
         status.st_uid == ::geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

void SyncFolder(const fs::path& folder) {
  const OpenedFile file = OpenFolder(folder);
  // EINVAL: the file system cannot sync a folder.
  if (file.id < 0 || (::fsync(file.id) != 0 && errno != EINVAL)) Fail("sync folder", folder);
}

void SyncFileSystem(const fs::path& folder) {
  const OpenedFile file = OpenFolder(folder);
  if (file.id < 0 || ::syncfs(file.id) != 0) Fail("sync the disk of", folder);
}

void WriteFile(const fs::path& path, std::string_view content) {
  OpenedFile file{Create(path)};
  if (file.id < 0) Fail("create", path);
  if (!WriteAll(file.id, content)) Fail("write", path);
  // A network disk may not report a failed write until the file is closed.
  if (::close(std::exchange(file.id, -1)) != 0) Fail("close", path);
}

AtomicFile::AtomicFile(fs::path path)
    : path_(std::move(path)),
      temporary_(path_.parent_path() /
                 (ShortenName(path_.filename().string()) + kPartSuffix +
                  std::to_string(::getpid()) + "-" + FindProcessRealm() + "-" + MakeRandomName())) {
  RemoveLeftParts(path_);
  file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0644);
  if (file_ < 0) Fail("create", path_);
}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) ::close(file_);
  if (!is_committed_) ::unlink(temporary_.c_str());
}

void AtomicFile::Write(std::string_view piece) {
  if (gathered_.size() + piece.size() < kGathered) {
    gathered_ += piece;
    return;
  }
  Flush();
  if (!WriteAll(file_, piece)) Fail("write", path_);
}

void AtomicFile::Commit() {
  Flush();
  if (::fsync(file_) != 0) Fail("sync", path_);
  // A network disk may not report a failed write until the file is closed.
  if (::close(std::exchange(file_, -1)) != 0) Fail("close", path_);
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) Fail("rename to", path_);
  is_committed_ = true;
  SyncFolder(path_.has_parent_path() ? path_.parent_path() : fs::path("."));
}

void AtomicFile::Flush() {
  if (!WriteAll(file_, gathered_)) Fail("write", path_);
  gathered_.clear();
}

void WriteFileAtomically(const fs::path& path, std::string_view content) {
  AtomicFile file(path);
  file.Write(content);
  file.Commit();
}

}  // namespace graspbench
