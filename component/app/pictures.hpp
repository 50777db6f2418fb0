// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The pictures layer, when the build has it.
#include <memory>
#include <string>

#include "dual/grid.hpp"
#include "lifecycle/settings.hpp"
#include "metrics/quality.hpp"
#include "sizing/raster.hpp"

namespace delos::app {

struct PictureSubject {
  std::string title;
  const Grid& grid;
  const Quality& quality;
  const Raster* elevation_m;  ///< for land; may be null
  /// Where the user wants to look; null: nowhere in particular.
  const OutputSettings* wishes = nullptr;
};

/// Draws "globe", "map" or "histograms" into a PNG file. Error(output) when this build has no
/// pictures or the file can't be written.
void draw_picture(const PictureSubject& subject, const std::string& picture,
                  const std::string& path);

}  // namespace delos::app
