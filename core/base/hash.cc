#include "core/base/hash.h"

#include <xxhash.h>

#include <cstdio>

namespace graspbench {

uint64_t CalcHash64(std::string_view bytes, uint64_t seed) {
  return XXH64(bytes.data(), bytes.size(), seed);
}

std::string CalcHashHex(std::string_view bytes) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(CalcHash64(bytes)));
  return text;
}

}  // namespace graspbench
