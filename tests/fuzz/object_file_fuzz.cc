// Any bytes as object.yaml: refused with an Error, or understood with values that a simulation can
// use.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/base/error.h"
#include "objects/object_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace graspbench;
  try {
    const ObjectFile file =
        ParseObjectFile({reinterpret_cast<const char*>(data), size}, "object.yaml");
    GRASPBENCH_DEMAND(file.mass > 0.0 || file.density > 0.0, file.name);
    GRASPBENCH_DEMAND(file.surface.friction_dynamic > 0.0 &&
                          file.surface.friction_static >= file.surface.friction_dynamic,
                      file.name);
  } catch (const Error&) {
  }
  return 0;
}
