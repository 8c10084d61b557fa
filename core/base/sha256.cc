#include "core/base/sha256.h"

#include <openssl/evp.h>

#include <array>

#include "core/base/error.h"

namespace graspbench {
namespace {

using Context = std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)>;

Context MakeContext() { return {EVP_MD_CTX_new(), &EVP_MD_CTX_free}; }

void Check(bool is_done) {
  if (is_done) return;
  throw Error(ErrorKind::kEnvironment, "OpenSSL's libcrypto does not offer SHA-256 here");
}

}  // namespace

struct Sha256::Impl {
  Context context = MakeContext();
};

Sha256::Sha256() : impl_(std::make_unique<Impl>()) {
  Check(EVP_DigestInit_ex(impl_->context.get(), EVP_sha256(), nullptr) == 1);
}

Sha256::~Sha256() = default;

void Sha256::Add(std::string_view bytes) {
  Check(EVP_DigestUpdate(impl_->context.get(), bytes.data(), bytes.size()) == 1);
}

std::string Sha256::CalcDigest() const {
  const Context copy = MakeContext();  // finishing ends a context
  std::array<unsigned char, 32> digest{};
  unsigned int length = 0;
  Check(EVP_MD_CTX_copy_ex(copy.get(), impl_->context.get()) == 1 &&
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
