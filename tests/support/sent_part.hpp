// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A part of a grid as another process gets it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <delos/delos.hpp>
#include <span>

namespace delos::testing {

/// The part as it comes out at another process.
inline LocalGrid sent(const LocalGrid& part) {
  const auto buffers = part.buffers();
  auto next = buffers.begin();
  return LocalGrid::received(part.layout(), [&](std::span<std::byte> bytes) {
    REQUIRE(bytes.size() == next->size());
    if (!bytes.empty()) std::memcpy(bytes.data(), next->data(), bytes.size());
    ++next;
  });
}

template <class Values>
bool same(const Values& a, const Values& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace delos::testing
