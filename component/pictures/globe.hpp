// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "dual/grid.hpp"
#include "pictures/picture.hpp"

namespace delos::pictures {

/// Writes a PNG: the body seen from far above the view point, every Voronoi cell coloured by its
/// size, outlines where cells are large enough to see, land in grey, the far side in small, colour
/// bar. Error(output) when it can't be written.
void draw_globe(const Grid& grid, const PictureOptions& options, const std::string& path);

}  // namespace delos::pictures
