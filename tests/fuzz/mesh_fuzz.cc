// Any bytes as a mesh file of one format.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/fuzz_mesh.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  graspbench::FuzzMesh({reinterpret_cast<const char*>(data), size},
                       std::string("mesh.") + GRASPBENCH_FUZZ_FORMAT);
  return 0;
}
