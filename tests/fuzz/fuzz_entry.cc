// Where libFuzzer and the replay of cases enter a target.

#include <cstdint>

#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  graspbench::FuzzInput(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
