// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/combine.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "sizing/nodes.hpp"

namespace delos {

void check(const CombineOptions& options, std::size_t n_sources) {
  DELOS_CHECK(n_sources > 0, ErrorKind::config,
              "the spacing has no source: give at least one, e.g. a constant");
  if (options.rule != CombineRule::blend) return;
  DELOS_CHECK(options.weights.size() == n_sources, ErrorKind::config, "blend has ",
              options.weights.size(), " weights for ", n_sources, " sources: give one each");
  double sum = 0.0;
  for (const double weight : options.weights) {
    DELOS_CHECK(std::isfinite(weight) && weight >= 0.0, ErrorKind::config, "blend weight is ",
                weight, ": it must be >= 0");
    sum += weight;
  }
  DELOS_CHECK(sum > 0.0, ErrorKind::config, "blend weights are all 0: one must be > 0");
}

void check(const ClampOptions& options) {
  DELOS_CHECK(std::isfinite(options.min_m) && std::isfinite(options.max_m) &&
                  options.min_m >= 0.0 && options.max_m > 0.0 && options.min_m <= options.max_m,
              ErrorKind::config, "clamp from ", options.min_m, " to ", options.max_m,
              " m: 0 <= min <= max and max > 0 are needed");
}

void combine_into(parallel::Executor& exec, const CombineOptions& options, std::size_t i_source,
                  const LatLonField& next, LatLonField& total) {
  const CombineRule rule = options.rule;
  double weight = 1.0;
  if (rule == CombineRule::blend) {
    double sum = 0.0;
    for (const double w : options.weights) sum += w;
    weight = options.weights[i_source] / sum;
  }
  for_rows(exec, total, [&](Index row, double* values) {
    const double* other = next.values.data() + next.at(row, 0);
    for (Index i = 0; i < total.n_lon; ++i) {
      if (rule == CombineRule::blend) {
        values[i] = (i_source == 0 ? 0.0 : values[i]) + weight * other[i];
      } else if (i_source == 0) {
        values[i] = other[i];
      } else {
        values[i] = rule == CombineRule::min ? std::min(values[i], other[i])
                                             : std::max(values[i], other[i]);
      }
    }
  });
}

void clamp(parallel::Executor& exec, const ClampOptions& options, LatLonField& field) {
  for_rows(exec, field, [&](Index, double* values) {
    for (Index i = 0; i < field.n_lon; ++i) {
      values[i] = std::min(std::max(values[i], options.min_m), options.max_m);
    }
  });
}

void set_land(parallel::Executor& exec, const LatLonField& elevation_m, double spacing_m,
              LatLonField& field) {
  for_rows(exec, field, [&](Index row, double* values) {
    const double* elevation = elevation_m.values.data() + elevation_m.at(row, 0);
    for (Index i = 0; i < field.n_lon; ++i) {
      if (elevation[i] >= 0.0) values[i] = spacing_m;
    }
  });
}

}  // namespace delos
