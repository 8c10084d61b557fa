#include "core/base/hash.h"

#include <fmt/core.h>
#include <xxhash.h>

namespace graspbench {

uint64_t CalcHash64(std::string_view bytes, uint64_t seed) {
  return XXH64(bytes.data(), bytes.size(), seed);
}

std::string CalcHashHex(std::string_view bytes) {
  return fmt::format("{:016x}", CalcHash64(bytes));
}

}  // namespace graspbench
