// Any bytes as a packed pipeline: refused in words, or files below the folder and nowhere else.

#include <stdlib.h>

#include <filesystem>
#include <string>

#include "core/base/files/files.h"
#include "datasets/pipeline/pipeline_pack.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
  namespace fs = std::filesystem;
  static const fs::path top = [] {
    std::string name = (fs::temp_directory_path() / "graspbench_fuzz_XXXXXX").string();
    GRASPBENCH_DEMAND(::mkdtemp(name.data()) != nullptr, name);
    return fs::path(name);
  }();
  WriteFile(top / "pack.tar", bytes);
  try {
    FindPackedFile(top / "out", Unpack(top / "pack.tar", top / "out"));
  } catch (const Error&) {
  }
  for (const auto& entry : fs::directory_iterator(top)) {
    const std::string name = entry.path().filename();
    GRASPBENCH_DEMAND(name == "out" || name == "pack.tar", name);
  }
  fs::remove_all(top / "out");
}

}  // namespace graspbench
