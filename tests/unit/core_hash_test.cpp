// SPDX-License-Identifier: BSD-3-Clause
#include "core/hash.hpp"

#include <doctest/doctest.h>

#include <array>
#include <set>

using namespace delos;

TEST_CASE("the digest is SHA-256 and does not depend on how the bytes are cut") {
  Digest whole;
  whole.add("abc", 3);
  CHECK(whole.hex() == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  Digest parts;
  parts.add("a", 1);
  parts.add("bc", 2);
  CHECK(parts.hex() == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST_CASE("hash64 tells seeds, ids and rounds apart") {
  std::set<std::uint64_t> seen;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (std::uint64_t id = 0; id < 100; ++id) {
      for (std::uint64_t round = 0; round < 20; ++round) seen.insert(hash64(seed, id, round));
    }
  }
  CHECK(seen.size() == 20 * 100 * 20);
}

TEST_CASE("uniform01 fills the unit interval evenly") {
  std::array<int, 10> counts{};
  for (std::uint64_t id = 0; id < 100000; ++id) {
    const double u = uniform01(3, id);
    REQUIRE(u >= 0);
    REQUIRE(u < 1);
    ++counts[static_cast<std::size_t>(u * 10)];
  }
  for (const int count : counts) CHECK(std::abs(count - 10000) < 500);
}
