// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "dual/grid.hpp"
#include "pictures/picture.hpp"

namespace delos::pictures {

/// Writes a PNG: plate carree map (longitude -180 to 180, latitude of the grid's kind), every
/// Voronoi cell coloured by its size, outlines where cells are large enough to see, land in grey,
/// colour bar. Error(output) when it can't be written.
void draw_map(const Grid& grid, const PictureOptions& options, const std::string& path);

}  // namespace delos::pictures
