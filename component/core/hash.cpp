// SPDX-License-Identifier: BSD-3-Clause
#include "core/hash.hpp"

#include <openssl/evp.h>

#include "core/error.hpp"

namespace delos {

struct Digest::Impl {
  EVP_MD_CTX* context = EVP_MD_CTX_new();
  ~Impl() { EVP_MD_CTX_free(context); }
};

Digest::Digest() : impl_(std::make_unique<Impl>()) {
  DELOS_CHECK(
      impl_->context != nullptr && EVP_DigestInit_ex(impl_->context, EVP_sha256(), nullptr) == 1,
      ErrorKind::internal, "libcrypto can't start a SHA-256 digest.");
}

Digest::~Digest() = default;

void Digest::add(const void* bytes, std::size_t n_bytes) {
  DELOS_CHECK(EVP_DigestUpdate(impl_->context, bytes, n_bytes) == 1, ErrorKind::internal,
              "libcrypto can't update a SHA-256 digest.");
}

std::string Digest::hex() {
  unsigned char bytes[EVP_MAX_MD_SIZE];
  unsigned int n_bytes = 0;
  DELOS_CHECK(EVP_DigestFinal_ex(impl_->context, bytes, &n_bytes) == 1, ErrorKind::internal,
              "libcrypto can't finish a SHA-256 digest.");
  constexpr char kDigits[] = "0123456789abcdef";
  std::string out;
  for (unsigned int i = 0; i < n_bytes; ++i) {
    out += kDigits[bytes[i] >> 4];
    out += kDigits[bytes[i] & 15];
  }
  return out;
}

}  // namespace delos
