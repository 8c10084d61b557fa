#pragma once
#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

#include "core/base/error.h"
#include "core/base/files/files.h"

namespace graspbench {

/** A temporary folder, removed by the destructor. */
class ScratchFolder {
 public:
  /** Creates the folder beside `beside`; empty: in the system's folder for temporary files. */
  explicit ScratchFolder(const std::filesystem::path& beside) {
    const std::filesystem::path above = beside.empty() ? std::filesystem::temp_directory_path()
                                        : beside.has_parent_path() ? beside.parent_path()
                                                                   : std::filesystem::path(".");
    MakeFolder(above);
    std::string name = (above / ".graspbench-pack-XXXXXX").string();
    if (!::mkdtemp(name.data())) {
      throw Error(ErrorKind::kIo,
                  "cannot make a folder in \"" + above.string() + "\": " + std::strerror(errno));
    }
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code status;
    std::filesystem::remove_all(path_, status);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace graspbench
