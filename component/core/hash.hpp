// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Counter-based random numbers and the digest that says "the same grid".
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace delos {

/// Mixes the counters into 64 well-spread bits (the finaliser of splitmix64, Steele et al. 2014).
constexpr std::uint64_t hash64(std::uint64_t seed, std::uint64_t id, std::uint64_t round = 0) {
  std::uint64_t x = seed + 0x9E3779B97F4A7C15ULL * (id + 1) + 0xD1B54A32D192ED03ULL * (round + 1);
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

/// Uniform in [0, 1), from the counters alone.
constexpr double uniform01(std::uint64_t seed, std::uint64_t id, std::uint64_t round = 0) {
  return static_cast<double>(hash64(seed, id, round) >> 11) * 0x1p-53;
}

/// SHA-256 over bytes given in order.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(const Digest&) = delete;
  Digest& operator=(const Digest&) = delete;
  void add(const void* bytes, std::size_t n_bytes);
  template <class T>
  void add(std::span<const T> values) {
    add(values.data(), values.size_bytes());
  }
  /// 64 lower-case hexadecimal digits; the digest can't be added to afterwards.
  std::string hex();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace delos
