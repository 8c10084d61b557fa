#include "core/base/hash.h"

#include <fmt/core.h>
#include <openssl/evp.h>
#include <xxhash.h>

#include <array>

#include "core/base/error.h"

namespace graspbench {
namespace {

void Check(bool is_done) {
  if (is_done) return;
  throw Error(ErrorKind::kEnvironment, "OpenSSL's libcrypto does not offer SHA-256 here");
}

}  // namespace

uint64_t CalcHash64(std::string_view bytes, uint64_t seed) {
  return XXH64(bytes.data(), bytes.size(), seed);
}

std::string CalcHashHex(std::string_view bytes) {
  return fmt::format("{:016x}", CalcHash64(bytes));
}

Sha256::Sha256() : context_(EVP_MD_CTX_new(), &EVP_MD_CTX_free) {
  Check(EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1);
}

void Sha256::Add(std::string_view bytes) {
  Check(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1);
}

std::string Sha256::CalcDigest() const {
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> copy(
      EVP_MD_CTX_new(), &EVP_MD_CTX_free);  // finalising a context makes it unusable
  std::array<unsigned char, 32> digest{};
  unsigned int length = 0;
  Check(EVP_MD_CTX_copy_ex(copy.get(), context_.get()) == 1 &&
        EVP_DigestFinal_ex(copy.get(), digest.data(), &length) == 1 && length == digest.size());
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const unsigned char byte : digest) {
    text += kDigits[byte >> 4];
    text += kDigits[byte & 15];
  }
  return text;
}

std::string CalcSha256(std::string_view bytes) {
  Sha256 sum;
  sum.Add(bytes);
  return sum.CalcDigest();
}

}  // namespace graspbench
