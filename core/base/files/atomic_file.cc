#include "core/base/files/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "core/base/hash.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr size_t kGathered = 1 << 16;  // pieces up to here are written together [bytes]
constexpr char kPartSuffix[] = ".part";

/** Names those processes whose ids this process can judge: those of this host and its process
namespace. Another host that shares the disk has the same ids for other processes. */
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

/** Also one that has ended and that its parent has not asked about yet. */
bool HasEnded(pid_t process) {
  if (::kill(process, 0) != 0) return errno == ESRCH;
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  const std::string stat((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const size_t name_end = stat.rfind(") ");  // the name may have any characters
  return name_end != std::string::npos && stat.size() > name_end + 2 && stat[name_end + 2] == 'Z';
}

/** Processes that were killed while they wrote the file left their parts behind. */
void RemoveLeftParts(const fs::path& path) {
  const std::string suffix = "-" + FindProcessRealm();
  const std::string prefix = path.filename().string() + kPartSuffix;
  std::error_code status;
  fs::directory_iterator entry(path.has_parent_path() ? path.parent_path() : fs::path("."), status);
  for (; !status && entry != fs::directory_iterator(); entry.increment(status)) {
    const std::string name = entry->path().filename().string();
    if (name.size() <= prefix.size() + suffix.size()) continue;
    if (name.compare(0, prefix.size(), prefix) != 0) continue;
    if (name.compare(name.size() - suffix.size(), suffix.size(), suffix) != 0) continue;
    pid_t writer = 0;
    const char* end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(name.data() + prefix.size(), end, writer);
    if (error != std::errc() || rest != name.data() + name.size() - suffix.size() || writer <= 0) {
      continue;
    }
    if (HasEnded(writer)) ::unlink(entry->path().c_str());
  }
}

}  // namespace

bool WriteAll(int file, std::string_view content) {
  for (size_t written = 0; written < content.size();) {
    const ssize_t count = ::write(file, content.data() + written, content.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return false;
    written += static_cast<size_t>(count);
  }
  return true;
}

AtomicFile::AtomicFile(fs::path path)
    : path_(std::move(path)),
      temporary_(path_.string() + kPartSuffix + std::to_string(::getpid()) + "-" +
                 FindProcessRealm()) {
  RemoveLeftParts(path_);
  file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file_ < 0) Fail("create");
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
  if (!WriteAll(file_, piece)) Fail("write");
}

void AtomicFile::Commit() {
  Flush();
  if (::fsync(file_) != 0) Fail("sync");
  // A disk over the network may say only now that it could not write.
  if (::close(std::exchange(file_, -1)) != 0) Fail("close");
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) Fail("rename to");
  is_committed_ = true;
  SyncFolder(path_.has_parent_path() ? path_.parent_path() : fs::path("."));
}

void AtomicFile::Flush() {
  if (!WriteAll(file_, gathered_)) Fail("write");
  gathered_.clear();
}

void AtomicFile::Fail(const char* what) const {
  throw Error(ErrorKind::kIo, std::string("cannot ") + what + " \"" + path_.string() +
                                  "\": " + std::strerror(errno));
}

}  // namespace graspbench
