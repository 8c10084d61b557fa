#pragma once
/** @file
SHA-256 (FIPS 180-4; package libssl-dev), for files whose bytes others must be able to check. */

#include <string>
#include <string_view>

namespace graspbench {

/** 64 lower-case hexadecimal digits. */
std::string CalcSha256(std::string_view bytes);

}  // namespace graspbench
