// SPDX-License-Identifier: BSD-3-Clause
#include "vertical.hpp"

#include <algorithm>

namespace delos::api {
namespace {

/// Height of an interface above sea level; those below the bottom lie on it.
double height_of(const VerticalView& v, std::size_t cell, std::size_t k) {
  return v.is_ocean() ? -std::min(v.level_interface_m[k], v.bottom_depth_m[cell])
                      : v.level_interface_m[k] + v.ground_influence[k] * v.ground_height_m[cell];
}

}  // namespace

std::vector<double> layer_thickness_m(const VerticalView& vertical) {
  const std::size_t n_levels = vertical.n_levels();
  std::vector<double> out(vertical.n_cells() * n_levels);
  for (std::size_t cell = 0; cell < vertical.n_cells(); ++cell) {
    const bool is_ocean = vertical.is_ocean();
    for (std::size_t k = 0; k < n_levels; ++k) {
      const double below = height_of(vertical, cell, is_ocean ? k + 1 : k);
      const double above = height_of(vertical, cell, is_ocean ? k : k + 1);
      out[cell * n_levels + k] = above - below;
    }
  }
  return out;
}

std::vector<double> interface_height_m(const VerticalView& vertical) {
  const std::size_t n_levels = vertical.n_levels();
  std::vector<double> out(vertical.n_cells() * (n_levels + 1));
  for (std::size_t cell = 0; cell < vertical.n_cells(); ++cell) {
    for (std::size_t k = 0; k <= n_levels; ++k) {
      out[cell * (n_levels + 1) + k] = height_of(vertical, cell, k);
    }
  }
  return out;
}

}  // namespace delos::api
