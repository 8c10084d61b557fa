// Any bytes as a packed pipeline: refused in words, or files below the folder and nowhere else.

#include <stdlib.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/base/error.h"
#include "core/base/files/files.h"
#include "datasets/pipeline/pipeline_pack.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace graspbench;
  namespace fs = std::filesystem;
  static const fs::path top = [] {
    std::string name = (fs::temp_directory_path() / "graspbench_fuzz_XXXXXX").string();
    GRASPBENCH_DEMAND(::mkdtemp(name.data()) != nullptr, name);
    return fs::path(name);
  }();
  WriteFile(top / "pack.tar", {reinterpret_cast<const char*>(data), size});
  try {
    FindPackedFile(top / "out", Unpack(top / "pack.tar", top / "out"));
  } catch (const Error&) {
  }
  for (const auto& entry : fs::directory_iterator(top)) {
    const std::string name = entry.path().filename();
    GRASPBENCH_DEMAND(name == "out" || name == "pack.tar", name);
  }
  fs::remove_all(top / "out");
  return 0;
}
