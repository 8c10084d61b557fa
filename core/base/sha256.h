#pragma once
/** @file
SHA-256 (FIPS 180-4; package libssl-dev), for files whose bytes others must be able to check. */

#include <memory>
#include <string>
#include <string_view>

namespace graspbench {

/** Of bytes that come piece by piece. */
class Sha256 {
 public:
  /** @throws Error(kEnvironment) when libcrypto does not offer it. */
  Sha256();
  ~Sha256();

  void Add(std::string_view bytes);
  /** 64 lower-case hexadecimal digits, of all bytes so far; more may follow. */
  std::string CalcDigest() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/** 64 lower-case hexadecimal digits. @throws Error(kEnvironment). */
std::string CalcSha256(std::string_view bytes);

}  // namespace graspbench
