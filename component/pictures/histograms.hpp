// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "metrics/quality.hpp"
#include "pictures/picture.hpp"

namespace delos::pictures {

/// Writes a PNG of four panels: area-length quality, triangle angles, relative edge length and
/// degree, counts on a logarithmic axis so that the worst elements show, extremes and means
/// marked. Of the options only title and size matter. Error(output) when it can't be written.
void draw_histograms(const Quality& quality, const PictureOptions& options,
                     const std::string& path);

}  // namespace delos::pictures
