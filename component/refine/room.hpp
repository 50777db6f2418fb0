// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Room for arrays of which some megabytes are about to be filled at once.
#include <algorithm>
#include <cstddef>

#include "core/array.hpp"

namespace delos {

/// Reserves `n` elements, or so many that the array gets large pages where those pay: the first
/// touch of one costs what 130 small ones do (half a megabyte). What is not touched costs nothing.
template <class T>
void reserve_pages(Array<T>& array, std::size_t n) {
  constexpr std::size_t kWorthAPage = detail::kLargePage / 2;
  constexpr std::size_t kLarge = detail::kLargeBytes / sizeof(T) + 1;
  array.reserve(n * sizeof(T) >= kWorthAPage ? std::max(n, kLarge) : n);
}

}  // namespace delos
