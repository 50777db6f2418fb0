// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From several spacings to one: min, max, blend, clamp, land.
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "sizing/spacing.hpp"

namespace delos {

enum class CombineRule { min, max, blend };

struct CombineOptions {
  CombineRule rule = CombineRule::min;
  std::vector<double> weights;  ///< blend only: one a source, >= 0, sum > 0 (they are normalised)
};

struct ClampOptions {
  double min_m = 0.0;
  double max_m = 1.0e7;
};

/// Takes source number i_source in: `total` becomes the min / max of both, or total + weight *
/// next; the sources must come in order, and number 0 replaces what `total` held.
void combine_into(parallel::Executor& exec, const CombineOptions& options, std::size_t i_source,
                  const LatLonField& next, LatLonField& total);

/// Error(config) unless the weights fit the number of sources and 0 < min <= max.
void check(const CombineOptions& options, std::size_t n_sources);
void check(const ClampOptions& options);

void clamp(parallel::Executor& exec, const ClampOptions& options, LatLonField& field);

/// Sets `spacing_m` where the elevation is >= 0 (missing elevation is sea).
void set_land(parallel::Executor& exec, const LatLonField& elevation_m, double spacing_m,
              LatLonField& field);

}  // namespace delos
