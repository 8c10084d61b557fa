#include "core/vision/picture_tools.h"

#include <dlfcn.h>

#include <filesystem>
#include <string>

#include "core/base/error.h"

namespace graspbench {
namespace {

namespace fs = std::filesystem;

// As installed, beside the program's folder; else where it was built.
const PictureTools& OpenModule() {
  std::error_code status;
  const fs::path program = fs::read_symlink("/proc/self/exe", status).parent_path();
  const fs::path installed = program.parent_path() / "lib/graspbench/graspbench-vision.so";
  const fs::path built = GRASPBENCH_VISION_MODULE;
  const fs::path& path = fs::exists(installed, status) ? installed : built;
  // Never closed: OpenCV's threads and exit handlers live as long as the program.
  void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) {
    throw Error(ErrorKind::kEnvironment,
                "a camera's pictures need OpenCV, which cannot be loaded (" +
                    std::string(dlerror()) +
                    "); install the Debian packages libopencv-core406 and libopencv-imgproc406, or "
                    "build graspbench again");
  }
  void* const tools = dlsym(module, "graspbench_picture_tools");
  GRASPBENCH_DEMAND(tools != nullptr, path.string());
  return *static_cast<const PictureTools*>(tools);
}

}  // namespace

const PictureTools& LoadPictureTools() {
  static const PictureTools& tools = OpenModule();
  return tools;
}

}  // namespace graspbench
