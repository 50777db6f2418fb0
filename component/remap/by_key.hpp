// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Entries of a sparse table seen from its other side: sorted by their keys.
#include <span>

#include "core/array.hpp"
#include "core/parallel.hpp"

namespace delos::remap {

struct ByKey {
  Array<std::int64_t> offsets;  ///< [n_keys + 1] those of key i: offsets[i] .. offsets[i + 1]
  Array<std::int64_t> entry;    ///< [n] positions in `keys`, ascending for one key
};

/// A counting sort in two steps, ranges of keys and then keys, O(n + n_keys). Keys are in [0,
/// n_keys). The same bits for any number of threads.
ByKey sort_by_key(parallel::Executor& exec, std::span<const Index> keys, std::int64_t n_keys);

}  // namespace delos::remap
