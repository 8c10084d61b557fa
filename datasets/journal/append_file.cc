#include "datasets/journal/append_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/journal/file_lock.h"

namespace graspbench {

struct AppendFile::Impl {
  ~Impl() {
    lock.reset();
    if (file >= 0) ::close(file);
  }

  [[noreturn]] void Fail(const std::string& what) const {
    const int reason = errno;
    throw Error(ErrorKind::kIo, "cannot " + what + " \"" + path.string() +
                                    "\": " + std::strerror(reason) +
                                    (reason == ENOSPC ? "; free some space and resume" : ""));
  }

  std::filesystem::path path;
  int file = -1;
  std::optional<FileLock> lock;
  uintmax_t size = 0;
  bool ends_torn = false;  ///< the last line lacks its line break
};

bool EndsInTornLine(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  char last = '\n';
  const off_t end = ::lseek(file, -1, SEEK_END);
  const bool is_read = end >= 0 && ::pread(file, &last, 1, end) == 1;
  ::close(file);
  return is_read && last != '\n';
}

AppendFile::AppendFile(const std::filesystem::path& path)
    : AppendFile(path, "\"" + path.string() +
                           "\" is being written by another process; wait until it is finished or "
                           "stop it") {}

AppendFile::AppendFile(const std::filesystem::path& path, const std::string& in_use)
    : impl_(std::make_unique<Impl>()) {
  impl_->path = path;
  impl_->file = ::open(impl_->path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (impl_->file < 0) impl_->Fail("open");
  impl_->lock.emplace(impl_->file, path);
  if (!impl_->lock->is_held()) throw Error(ErrorKind::kIo, in_use + impl_->lock->holder());
  struct stat status;
  if (::fstat(impl_->file, &status) != 0) impl_->Fail("read");
  char last = '\n';
  if (status.st_size > 0 && ::pread(impl_->file, &last, 1, status.st_size - 1) != 1) {
    impl_->Fail("read");
  }
  impl_->ends_torn = last != '\n';
  impl_->size = static_cast<uintmax_t>(status.st_size);
  SyncFolder(impl_->path.parent_path());
}

AppendFile::~AppendFile() = default;

void AppendFile::Append(const std::string& lines) {
  const std::string text = (impl_->ends_torn ? "\n" : "") + lines;
  for (size_t written = 0; written < text.size();) {  // one write, but on a full disk or a signal
    const ssize_t count = ::write(impl_->file, text.data() + written, text.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) impl_->Fail("write");
    written += static_cast<size_t>(count);
    impl_->size += static_cast<uintmax_t>(count);
    impl_->ends_torn = written < text.size();
  }
  if (::fdatasync(impl_->file) != 0) impl_->Fail("sync");
}

void AppendFile::Truncate(size_t length) {
  if (::ftruncate(impl_->file, static_cast<off_t>(length)) != 0) impl_->Fail("shorten");
  impl_->size = length;
  impl_->ends_torn = false;
}

uintmax_t AppendFile::size() const { return impl_->size; }

}  // namespace graspbench
