/** @file
libFuzzer target for one importer, named by GRASPBENCH_FUZZ_IMPORTER at compile time. */

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/fuzz_import.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  graspbench::FuzzImport(GRASPBENCH_FUZZ_IMPORTER,
                         std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
