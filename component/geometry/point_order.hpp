// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Hilbert order of points around the origin, for locality.
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "core/types.hpp"

namespace delos {

/// Key along a closed Hilbert curve over the six faces of the cube around the origin, 16 bits an
/// axis (35 bits in all). Near keys are near points.
std::uint64_t hilbert_key(const Vec3& p);

/// The permutation that sorts the points by (hilbert_key, index): order[k] = id of the k-th point.
std::vector<Index> hilbert_order(parallel::Executor& exec, std::span<const Vec3> points);

}  // namespace delos
