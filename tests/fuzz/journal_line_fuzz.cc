/** @file
libFuzzer target: a line of a journal: of trials, judgements, evaluations, developments, workers. */

#include <cstddef>
#include <cstdint>

#include "tests/fuzz/fuzz_session.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  graspbench::FuzzJournalLine(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
