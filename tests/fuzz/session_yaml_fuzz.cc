/** @file
libFuzzer target: session.yaml, and the text behind --set. */

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/fuzz_session.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  graspbench::FuzzSessionYaml(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
