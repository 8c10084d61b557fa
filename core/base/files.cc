#include "core/base/files.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>

#include "core/base/error.h"
#include "core/base/file_pieces.h"
#include "core/base/hash.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

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
    if (::kill(writer, 0) != 0 && errno == ESRCH) ::unlink(entry->path().c_str());
  }
}

/** Creates or replaces the file. @param fail  throws; errno says why. */
template <class Fail>
void WriteContent(const fs::path& path, std::string_view content, bool is_synced,
                  const Fail& fail) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) fail("create");
  for (size_t written = 0; written < content.size();) {
    const ssize_t count = ::write(file, content.data() + written, content.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      ::close(file);
      fail("write");
    }
    written += static_cast<size_t>(count);
  }
  if (is_synced && ::fsync(file) != 0) {
    ::close(file);
    fail("sync");
  }
  // A disk over the network may say only now that it could not write.
  if (::close(file) != 0) fail("close");
}

}  // namespace

fs::path FindDataRoot() {
  const char* home = std::getenv("GRASPBENCH_HOME");
  return home && *home ? fs::path(home) : fs::path(GRASPBENCH_SOURCE_DIR);
}

fs::path FindCacheRoot() {
  if (const char* cache = std::getenv("XDG_CACHE_HOME"); cache && *cache) {
    return fs::path(cache) / "graspbench";
  }
  if (const char* home = std::getenv("HOME"); home && *home) {
    return fs::path(home) / ".cache" / "graspbench";
  }
  return fs::temp_directory_path() / ("graspbench-" + std::to_string(::geteuid()));
}

std::string ReadFile(const fs::path& path) {
  std::string content;
  ReadPieces(path, [&](std::string_view piece) {
    content += piece;
    return true;
  });
  return content;
}

void MakeFolder(const fs::path& folder) {
  std::error_code status;
  fs::create_directories(folder, status);
  if (status) {
    throw Error(ErrorKind::kIo,
                "cannot create folder \"" + folder.string() + "\": " + status.message());
  }
}

void MakePrivateFolder(const fs::path& folder) {
  if (folder.has_parent_path()) MakeFolder(folder.parent_path());
  const bool is_made = ::mkdir(folder.c_str(), 0700) == 0;
  if (!is_made && errno != EEXIST) {
    throw Error(ErrorKind::kIo,
                "cannot create folder \"" + folder.string() + "\": " + std::strerror(errno));
  }
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  const bool is_private = file >= 0 && ::fchmod(file, 0700) == 0;
  if (file >= 0) ::close(file);
  if (!is_private || !IsPrivateFolder(folder)) {
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
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  // EINVAL: a file system that has nothing to sync here.
  const bool synced = file >= 0 && (::fsync(file) == 0 || errno == EINVAL);
  const std::string reason = std::strerror(errno);
  if (file >= 0) ::close(file);
  if (!synced) {
    throw Error(ErrorKind::kIo, "cannot sync folder \"" + folder.string() + "\": " + reason);
  }
}

void WriteFile(const fs::path& path, std::string_view content) {
  const auto fail = [&](const char* what) {
    throw Error(ErrorKind::kIo, std::string("cannot ") + what + " \"" + path.string() +
                                    "\": " + std::strerror(errno));
  };
  WriteContent(path, content, /*is_synced=*/false, fail);
}

void SyncFileSystem(const fs::path& folder) {
  const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  const bool synced = file >= 0 && ::syncfs(file) == 0;
  const std::string reason = std::strerror(errno);
  if (file >= 0) ::close(file);
  if (!synced) {
    throw Error(ErrorKind::kIo, "cannot sync the disk of \"" + folder.string() + "\": " + reason);
  }
}

void WriteFileAtomically(const fs::path& path, std::string_view content) {
  RemoveLeftParts(path);
  const std::string temporary =
      path.string() + kPartSuffix + std::to_string(::getpid()) + "-" + FindProcessRealm();
  const auto fail = [&](const char* what) {
    const std::string reason = std::strerror(errno);
    ::unlink(temporary.c_str());
    throw Error(ErrorKind::kIo,
                std::string("cannot ") + what + " \"" + path.string() + "\": " + reason);
  };
  WriteContent(temporary, content, /*is_synced=*/true, fail);
  if (::rename(temporary.c_str(), path.c_str()) != 0) fail("rename to");
  SyncFolder(path.has_parent_path() ? path.parent_path() : fs::path("."));
}

}  // namespace graspbench
