// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The part of the surface that a picture shows close up, and its flat image.
#include <optional>

#include "dual/grid.hpp"
#include "pictures/canvas.hpp"
#include "pictures/picture.hpp"

namespace delos::pictures {

/// A disc of the sphere of directions (longitude and latitude, of the grid's kind, as on a sphere).
struct Zoom {
  LonLat centre;
  double radius_rad = 0.0;
};

/// What was asked for (view_radius_deg); else the cap that holds the cells, where that is less than
/// most of a hemisphere; none for the others.
std::optional<Zoom> zoom_of(const Grid& grid, const PictureOptions& options);

/// Degrees between lines of a graticule so that a handful cross `span_deg`; divides 180.
double graticule_step(double span_deg);

/// The same for meridians across the disc, which crowd near a pole.
double meridian_step(const Zoom& zoom);

/// Lambert's azimuthal equal-area map (Snyder 1987, section 24): north is up at the centre, the
/// date line and the poles are points like any other. Lengths in radii.
class AzimuthalMap {
 public:
  explicit AzimuthalMap(const LonLat& centre);
  Point forward(const LonLat& place) const;
  LonLat inverse(const Point& point) const;
  /// Not near the point opposite to the centre, which is a circle on the map.
  bool shows(const LonLat& place) const;

 private:
  Vec3 axis_, east_, north_;
};

/// Writes a PNG: cells, their edges, rings, coast, graticule with labels at the frame, facts.
void draw_zoomed_map(const Grid& grid, const PictureOptions& options, const Zoom& zoom,
                     const std::string& path);

}  // namespace delos::pictures
