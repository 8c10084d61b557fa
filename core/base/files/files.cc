#include "core/base/files/files.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/base/error.h"
#include "core/base/files/atomic_file.h"
#include "core/base/files/file_pieces.h"

namespace graspbench {
namespace fs = std::filesystem;

fs::path FindDataRoot() {
  const char* home = std::getenv("GRASPBENCH_HOME");
  if (home && *home) return fs::path(home);
  // As installed, wherever that was moved to; else where it was built.
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
  // A relative one is to be ignored, by the XDG Base Directory Specification.
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
    return "/dev/null/graspbench";  // of somebody else, or no place at all: nothing is kept
  }
  return folder;
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
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (file < 0) fail("create");
  if (!WriteAll(file, content)) {
    const int reason = errno;
    ::close(file);
    errno = reason;
    fail("write");
  }
  // A disk over the network may say only now that it could not write.
  if (::close(file) != 0) fail("close");
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
  AtomicFile file(path);
  file.Write(content);
  file.Commit();
}

}  // namespace graspbench
