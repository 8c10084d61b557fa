#include "datasets/records/record_lines.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/base/error.h"

namespace graspbench {

std::string NameOfLine(const RecordLines& lines, const LinePlace& place) {
  return lines.files.at(static_cast<size_t>(place.file)) + ":" + std::to_string(place.number);
}

std::string ReadLine(const RecordLines& lines, const LinePlace& place) {
  const std::filesystem::path path = lines.folder / lines.files.at(static_cast<size_t>(place.file));
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  std::string text(place.length, '\0');
  size_t length = 0;
  ssize_t count = file < 0 ? -1 : 1;
  while (count > 0 && length < text.size()) {
    count = ::pread(file, text.data() + length, text.size() - length,
                    static_cast<off_t>(place.start + length));
    if (count > 0) length += static_cast<size_t>(count);
    if (count < 0 && errno == EINTR) count = 1;
  }
  const std::string reason = count < 0 ? std::strerror(errno) : "it has become shorter";
  if (file >= 0) ::close(file);
  if (length < text.size()) {
    throw Error(ErrorKind::kIo, "cannot read \"" + path.string() +
                                    "\":" + std::to_string(place.number) + " again: " + reason);
  }
  return text;
}

}  // namespace graspbench
