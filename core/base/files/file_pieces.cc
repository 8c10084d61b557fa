#include "core/base/files/file_pieces.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.h"

namespace graspbench {
namespace fs = std::filesystem;

namespace {

constexpr size_t kPieceSize = 1 << 18;

struct OpenedFile {
  ~OpenedFile() {
    if (id >= 0) ::close(id);
  }
  const int id;
};

}  // namespace

void ReadPieces(const fs::path& path, const std::function<bool(std::string_view)>& take,
                uintmax_t start) {
  std::error_code status;
  if (!fs::exists(path, status)) {
    throw Error(ErrorKind::kNotFound, "no file \"" + path.string() + "\"");
  }
  if (fs::is_directory(path, status)) {
    throw Error(ErrorKind::kIo, "\"" + path.string() + "\" is a folder; a file was expected");
  }
  const auto fail = [&]() {
    return Error(ErrorKind::kIo, "cannot read \"" + path.string() + "\": " + std::strerror(errno));
  };
  // no wait for a FIFO
  const OpenedFile file{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
  if (file.id < 0) throw fail();
  struct stat properties = {};
  if (::fstat(file.id, &properties) != 0 || !S_ISREG(properties.st_mode)) {
    throw Error(ErrorKind::kIo,
                "\"" + path.string() + "\" is a device, a pipe or a socket; a file was expected");
  }
  if (start > 0 && ::lseek(file.id, static_cast<off_t>(start), SEEK_SET) < 0) throw fail();
  std::string piece(kPieceSize, '\0');
  while (true) {
    const ssize_t count = ::read(file.id, piece.data(), piece.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw fail();
    if (count == 0 || !take(std::string_view(piece).substr(0, static_cast<size_t>(count)))) return;
  }
}

}  // namespace graspbench
