// SPDX-License-Identifier: BSD-3-Clause
#include "norms.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "model.hpp"

namespace shallow_water {

Norms error_norms(const delos::Grid& grid, const std::vector<double>& found,
                  const std::vector<double>& truth) {
  const auto area_m2 = grid.cell_area_m2();
  CompensatedSum error, size;
  double largest_error = 0.0, largest = 0.0;
  for (std::size_t cell = 0; cell < truth.size(); ++cell) {
    const double difference = found[cell] - truth[cell];
    error.add(area_m2[cell] * difference * difference);
    size.add(area_m2[cell] * truth[cell] * truth[cell]);
    largest_error = std::max(largest_error, std::fabs(difference));
    largest = std::max(largest, std::fabs(truth[cell]));
  }
  return {std::sqrt(error.value() / size.value()), largest_error / largest};
}

}  // namespace shallow_water
