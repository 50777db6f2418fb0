// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The layers that a grid, or a part of one, hands out.
#include <cstdint>
#include <span>
#include <vector>

namespace delos::api {

/// The arrays of Grid of these names; all empty without layers, those of the other kind too.
struct VerticalView {
  std::span<const double> level_interface_m;
  std::span<const std::int32_t> max_level_cell;
  std::span<const double> bottom_depth_m;
  std::span<const double> ground_height_m;
  std::span<const double> ground_influence;

  bool is_ocean() const { return !max_level_cell.empty(); }
  std::size_t n_cells() const {
    return is_ocean() ? bottom_depth_m.size() : ground_height_m.size();
  }
  std::size_t n_levels() const {
    return level_interface_m.empty() ? 0 : level_interface_m.size() - 1;
  }
};

template <class AnyGrid>
VerticalView vertical_of(const AnyGrid& grid) {
  return {grid.level_interface_m(), grid.max_level_cell(), grid.bottom_depth_m(),
          grid.ground_height_m(), grid.ground_influence()};
}

/// Grid::layer_thickness_m() and Grid::interface_height_m().
std::vector<double> layer_thickness_m(const VerticalView& vertical);
std::vector<double> interface_height_m(const VerticalView& vertical);

}  // namespace delos::api
