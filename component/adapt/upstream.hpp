// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Eddies grow on the way from where the flow becomes unstable: their signal is spread upstream, so
// that the grid is fine there, too (Sein et al. 2016, doi:10.1002/2016MS000650).
#include "core/parallel.hpp"
#include "sizing/raster.hpp"

namespace delos {

/// How far upstream: one of the two is > 0.
struct UpstreamOptions {
  double length_m = 0.0;  ///< along the mean flow
  double time_s = 0.0;    ///< that the mean flow takes
};

/// Mean velocity, m/s; NaN where there is none.
struct MeanFlow {
  const Raster& east;
  const Raster& north;
};

/// Each place gets the greatest of what it has and what lies downstream of it along the mean flow,
/// times 1 - s / reach, s being the length (or time) of the way. Paths follow the nodes of a table
/// of the signal's resolution by half rows, and end where the flow is missing, slower than 1 mm/s,
/// or within a row of a pole. A missing signal stays missing, but what lies beyond is seen. The
/// result is a table with both poles. The same bits for any number of threads.
Raster spread_upstream(parallel::Executor& exec, const Raster& signal, const MeanFlow& flow,
                       const UpstreamOptions& options, double radius_m);

}  // namespace delos
