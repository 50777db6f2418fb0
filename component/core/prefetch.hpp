// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A hint to the processor, for loops that follow ids to records in no order of memory: the fetch of
// a record that a later round needs overlaps with the arithmetic of this one. No effect on results.
#include <cstdint>

namespace delos {

/// Rounds ahead: far enough for the next cache but one, near enough to be still there.
inline constexpr std::int64_t kPrefetchRounds = 12;

template <class T>
void prefetch(const T& record) {
  __builtin_prefetch(&record);
}

}  // namespace delos
