// Any bytes as object.yaml: refused with an Error, or understood with values that a simulation can
// use.
#include <cmath>
#include <string>

#include "objects/object_file.h"
#include "tests/fuzz/fuzz_target.h"

namespace graspbench {

void FuzzInput(const std::string& bytes) {
  try {
    const ObjectFile file = ParseObjectFile(bytes, "object.yaml");
    GRASPBENCH_DEMAND(file.mass > 0.0 || file.density > 0.0, file.name);
    GRASPBENCH_DEMAND(file.surface.friction_dynamic > 0.0 &&
                          file.surface.friction_static >= file.surface.friction_dynamic,
                      file.name);
  } catch (const Error&) {
  }
}

}  // namespace graspbench
