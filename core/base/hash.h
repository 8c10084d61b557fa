#pragma once
/** @file
Content hashes. XXH64 (package libxxhash) is for identification, not for security. SHA-256 (FIPS
180-4, package libssl-dev) is for files whose bytes others must be able to verify. */

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // of libcrypto

namespace graspbench {

uint64_t CalcHash64(std::string_view bytes, uint64_t seed = 0);

/** Returns CalcHash64 as 16 lower-case hexadecimal digits. */
std::string CalcHashHex(std::string_view bytes);

/** SHA-256 of bytes that arrive in pieces. */
class Sha256 {
 public:
  /** @throws Error(kEnvironment) when libcrypto does not provide SHA-256. */
  Sha256();
  void Add(std::string_view bytes);
  /** Returns the digest of all bytes so far as 64 lower-case hexadecimal digits; more may
  follow. */
  std::string CalcDigest() const;

 private:
  std::unique_ptr<evp_md_ctx_st, void (*)(evp_md_ctx_st*)> context_;
};

/** Returns the digest as 64 lower-case hexadecimal digits. @throws Error(kEnvironment). */
std::string CalcSha256(std::string_view bytes);

}  // namespace graspbench
