#pragma once
/** @file
Stable names for content: XXH64 (package libxxhash), not for security; SHA-256 (FIPS 180-4; package
libssl-dev) for files whose bytes others must be able to check. */

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // of libcrypto

namespace graspbench {

uint64_t CalcHash64(std::string_view bytes, uint64_t seed = 0);

/** 16 lower-case hexadecimal digits of CalcHash64. */
std::string CalcHashHex(std::string_view bytes);

/** SHA-256 of bytes that come piece by piece. */
class Sha256 {
 public:
  /** @throws Error(kEnvironment) when libcrypto does not offer it. */
  Sha256();
  void Add(std::string_view bytes);
  /** 64 lower-case hexadecimal digits, of all bytes so far; more may follow. */
  std::string CalcDigest() const;

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

/** 64 lower-case hexadecimal digits. @throws Error(kEnvironment). */
std::string CalcSha256(std::string_view bytes);

}  // namespace graspbench
