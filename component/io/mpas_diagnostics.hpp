// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What MPAS files say of the shape of cells and triangles; no model reads it.
#include "dual/grid.hpp"

namespace delos::mpas {

// As the converter of MPAS-Tools defines them, but for the quality by angles, where the converter
// gives different values to congruent triangles: here it is the smallest angle over the largest.

/// Shortest over longest edge of the cell.
double cell_quality(const Grid& grid, std::int64_t cell);
/// To the neighbours; 0 without any.
double mean_distance_m(const Grid& grid, std::int64_t cell);
/// Shortest over longest side of the triangle of a vertex.
double triangle_quality(const Grid& grid, std::int64_t vertex);
/// 0 when a corner is missing; plane angles.
double triangle_angle_quality(const Grid& grid, std::int64_t vertex);
/// An angle above 90 degrees.
bool is_obtuse(const Grid& grid, std::int64_t vertex);

}  // namespace delos::mpas
