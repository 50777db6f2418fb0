// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/map.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "pictures/canvas.hpp"
#include "pictures/cell_painter.hpp"
#include "pictures/coastline.hpp"
#include "pictures/zoom.hpp"

namespace delos::pictures {

namespace {

constexpr Colour kMapGraticule{1.0, 1.0, 1.0, 0.28};
// An edge near a pole bends on this map; it is drawn in pieces no wider than this.
constexpr double kPiece_deg = 2.0;
constexpr int kMostPieces = 64;

/// Longitude -180..180 and latitude -90..90 on a box of the sheet.
struct Frame {
  Box box;
  Point pixel(double lon_deg, double lat_deg) const {
    return {box.x + (lon_deg + 180.0) / 360.0 * box.width,
            box.y + (90.0 - lat_deg) / 180.0 * box.height};
  }
  double lon_deg(double x) const { return (x - box.x) / box.width * 360.0 - 180.0; }
  double lat_deg(double y) const { return 90.0 - (y - box.y) / box.height * 180.0; }
};

void paint_cells(Canvas& canvas, const Grid& grid, const CellPainter& painter, const Frame& frame) {
  const auto sample_at = [&](const Point& p) -> std::optional<Sample> {
    const LonLat place{frame.lon_deg(p.x) * kRadPerDeg, frame.lat_deg(p.y) * kRadPerDeg};
    return Sample{grid.surface.point(place, grid.latitude)};
  };
  canvas.image(painted(painter, frame.box, sample_at), {frame.box.x, frame.box.y});
}

/// The longitude that differs from `near_deg` by at most half a turn.
double unwrapped(double lon_deg, double near_deg) {
  return lon_deg - 360.0 * std::round((lon_deg - near_deg) / 360.0);
}

/// Adds one edge in pieces; where it leaves the map over the date line it enters on the other side.
void add_edge(Outlines& outlines, const Frame& frame, const Segment& edge,
              const Outlines::Cell& look) {
  for (const double turn : {-360.0, 0.0, 360.0}) {
    const double from = edge.from.x + turn, to = edge.to.x + turn;
    if (std::max(from, to) < -180.0 || std::min(from, to) > 180.0) continue;
    outlines.add({frame.pixel(from, edge.from.y), frame.pixel(to, edge.to.y)}, look);
  }
}

void draw_outlines(Canvas& canvas, const Grid& grid, const CellPainter& painter,
                   const Frame& frame) {
  Outlines outlines;
  const double px_per_km = 1e3 * frame.box.height / (kPi * grid.surface.scale_m());
  for (std::size_t edge = 0; edge < grid.vertices_on_edge.size(); ++edge) {
    const Index cell = grid.cells_on_edge[edge][0];
    const double size_px = px_per_km * painter.sizes_km()[static_cast<std::size_t>(cell)];
    if (!Outlines::is_visible(size_px)) continue;
    const auto [first, second] = grid.vertices_on_edge[edge];
    const Vec3& a = grid.vertex_position[static_cast<std::size_t>(first)];
    const Vec3& b = grid.vertex_position[static_cast<std::size_t>(second)];
    const auto degrees = [&](const Vec3& p, double near_deg) {
      const LonLat at = grid.surface.lon_lat(grid.surface.project(p), grid.latitude);
      return Point{unwrapped(at.lon_rad * kDegPerRad, near_deg), at.lat_rad * kDegPerRad};
    };
    const Outlines::Cell look{size_px, painter.is_dark(cell, a)};
    Point from = degrees(a, 0.0);
    const double width_deg = std::abs(degrees(b, from.x).x - from.x);
    const int n_pieces = std::clamp(static_cast<int>(width_deg / kPiece_deg) + 1, 1, kMostPieces);
    for (int piece = 1; piece <= n_pieces; ++piece) {
      const double t = static_cast<double>(piece) / n_pieces;
      const Point to = degrees(a + t * (b - a), from.x);
      add_edge(outlines, frame, {from, to}, look);
      from = to;
    }
  }
  outlines.draw(canvas);
}

void draw_lines(Canvas& canvas, const LandMask* land, const Frame& frame) {
  std::vector<Segment> graticule;
  for (int lon = -150; lon < 180; lon += 30) {
    graticule.push_back({frame.pixel(lon, -90), frame.pixel(lon, 90)});
  }
  for (int lat = -60; lat <= 60; lat += 30) {
    graticule.push_back({frame.pixel(-180, lat), frame.pixel(180, lat)});
  }
  canvas.segments(graticule, {kMapGraticule, 1.0});
  if (land == nullptr) return;
  std::vector<Segment> coast;
  for (const Segment& piece : land->coastline()) {
    coast.push_back({frame.pixel(piece.from.x, piece.from.y), frame.pixel(piece.to.x, piece.to.y)});
  }
  canvas.segments(coast, {kCoast, 0.8});
}

std::string degrees_label(int degrees, const char* positive, const char* negative) {
  if (degrees == 0) return "0°";
  return text(std::abs(degrees), "°", degrees > 0 ? positive : negative);
}

void draw_axes(Canvas& canvas, const Frame& frame, double unit) {
  canvas.frame(frame.box, {kInk, 1.4});
  for (int lon = -180; lon <= 180; lon += 60) {
    const std::string label = std::abs(lon) == 180 ? "180°" : degrees_label(lon, "E", "W");
    canvas.text({frame.pixel(lon, -90).x, frame.box.y + frame.box.height + 10 * unit}, label,
                {.size = 17 * unit, .anchor_x = 0.5, .anchor_y = 0.0});
  }
  for (int lat = -60; lat <= 60; lat += 30) {
    canvas.text({frame.box.x - 8 * unit, frame.pixel(-180, lat).y}, degrees_label(lat, "N", "S"),
                {.size = 17 * unit, .anchor_x = 1.0});
  }
}

}  // namespace

void draw_map(const Grid& grid, const PictureOptions& options, const std::string& path) {
  if (const auto zoom = zoom_of(grid, options)) return draw_zoomed_map(grid, options, *zoom, path);
  std::optional<LandMask> mask;
  if (options.land != nullptr) mask.emplace(*options.land);
  const LandMask* land = mask ? &*mask : nullptr;
  const CellPainter painter(grid, land);
  const double unit = std::min(options.width / 1600.0, options.height / 1000.0);
  Canvas canvas(options.width, options.height, kPaper);
  const Frame frame{{std::floor(70 * unit), std::floor(100 * unit), std::floor(1480 * unit),
                     std::floor(740 * unit)}};

  paint_cells(canvas, grid, painter, frame);
  canvas.clip_box(frame.box);
  draw_outlines(canvas, grid, painter, frame);
  draw_lines(canvas, land, frame);
  canvas.unclip();
  draw_axes(canvas, frame, unit);

  canvas.text({70 * unit, 42 * unit}, options.title, {.size = 34 * unit, .bold = true});
  canvas.text({70 * unit, 78 * unit}, summary(grid, painter.sizes_km()), {.size = 19 * unit});
  draw_colour_bar(canvas, painter.scale(),
                  {400 * unit, 900 * unit, std::floor(800 * unit), std::floor(24 * unit)});
  canvas.write_png(path);
}

}  // namespace delos::pictures
