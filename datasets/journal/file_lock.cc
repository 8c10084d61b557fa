#include "datasets/journal/file_lock.h"

#include <sys/file.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#include "core/base/error.h"

namespace graspbench {
namespace {

std::atomic<void (*)(const std::string& text)> warn_once{nullptr};

}  // namespace

FileLock LockFile(int file, const std::filesystem::path& path) {
  if (::flock(file, LOCK_EX | LOCK_NB) == 0) return FileLock::kHeld;
  const int reason = errno;
  if (reason == EWOULDBLOCK) return FileLock::kTaken;
  if (reason != ENOLCK && reason != ENOSYS && reason != EOPNOTSUPP) {
    throw Error(ErrorKind::kIo, "cannot lock \"" + path.string() + "\": " + std::strerror(reason));
  }
  if (const auto warn = warn_once.exchange(nullptr)) {
    warn("warning: the file system of \"" + path.parent_path().string() + "\" has no file locks (" +
         std::strerror(reason) +
         "). Two programs could write there at once: run one at a time in a folder");
  }
  return FileLock::kMissing;
}

void WarnOfMissingLocks(void (*warn)(const std::string& text)) { warn_once = warn; }

}  // namespace graspbench
