#pragma once
/** @file
Stable names for content: XXH64 (package libxxhash). Not for security. */

#include <cstdint>
#include <string>
#include <string_view>

namespace graspbench {

uint64_t CalcHash64(std::string_view bytes, uint64_t seed = 0);

/** 16 lower-case hexadecimal digits of CalcHash64. */
std::string CalcHashHex(std::string_view bytes);

}  // namespace graspbench
