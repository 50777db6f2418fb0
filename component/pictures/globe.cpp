// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/globe.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "pictures/canvas.hpp"
#include "pictures/cell_painter.hpp"
#include "pictures/coastline.hpp"

namespace delos::pictures {

namespace {

constexpr Colour kGraticule{1.0, 1.0, 1.0, 0.30};
// Samples along each side of a pixel: smooths the borders between cells and the rim.
constexpr int kSamples = 2;
// The rim is drawn this much darker than the middle, so that the picture reads as a ball.
constexpr double kShadow = 0.16;

/// Orthographic projection onto a disc of the sheet.
struct Projection {
  const Ellipsoid* surface;
  Point centre;
  double radius;  // pixels of one scaled unit
  Vec3 view, east, north;

  Projection(const Ellipsoid& body, const Point& middle, double pixels, const LonLat& from)
      : surface(&body), centre(middle), radius(pixels) {
    const double clat = std::cos(from.lat_rad), slat = std::sin(from.lat_rad);
    const double clon = std::cos(from.lon_rad), slon = std::sin(from.lon_rad);
    view = Vec3(clat * clon, clat * slon, slat);
    east = Vec3(-slon, clon, 0.0);
    north = view.cross(east);
  }
  Point pixel(const Vec3& p) const {
    return {centre.x + radius * p.dot(east), centre.y - radius * p.dot(north)};
  }
  bool is_visible(const Vec3& p) const { return surface->normal(p).dot(view) > 0.0; }
  /// The point of the surface seen at a pixel, if any.
  std::optional<Vec3> point(const Point& pixel) const {
    const Vec3 q = ((pixel.x - centre.x) * east - (pixel.y - centre.y) * north) / radius;
    const Vec3 weight = surface->inverse_square();
    const double a = view.dot(weight.cwiseProduct(view)), b = view.dot(weight.cwiseProduct(q));
    const double c = q.dot(weight.cwiseProduct(q)) - 1.0;
    const double square = b * b - a * c;
    if (square <= 0.0) return std::nullopt;
    return Vec3(q + (std::sqrt(square) - b) / a * view);
  }
};

void paint_cells(Canvas& canvas, const CellPainter& painter, const Projection& look) {
  const int side = 2 * static_cast<int>(std::ceil(look.radius)) + 2;
  const Point corner{std::floor(look.centre.x - look.radius) - 1,
                     std::floor(look.centre.y - look.radius) - 1};
  Image image{side, side, std::vector<Colour>(static_cast<std::size_t>(side) * side)};
  Index row_start = 0;
  for (int row = 0; row < side; ++row) {
    Index cell = row_start;
    bool is_first = true;
    for (int column = 0; column < side; ++column) {
      Colour sum{0.0, 0.0, 0.0, 0.0};
      for (int sample = 0; sample < kSamples * kSamples; ++sample) {
        const int over = sample % kSamples, down = sample / kSamples;
        const Point at{corner.x + column + (over + 0.5) / kSamples,
                       corner.y + row + (down + 0.5) / kSamples};
        const std::optional<Vec3> p = look.point(at);
        if (!p) continue;
        const Colour colour = painter.colour(*p, cell);
        if (is_first) row_start = cell;
        is_first = false;
        const double light =
            1.0 - kShadow * (1.0 - std::max(0.0, look.surface->normal(*p).dot(look.view)));
        sum = {sum.r + light * colour.r, sum.g + light * colour.g, sum.b + light * colour.b,
               sum.a + 1.0};
      }
      if (sum.a > 0.0) {
        image.at(column, row) = {sum.r / sum.a, sum.g / sum.a, sum.b / sum.a,
                                 sum.a / (kSamples * kSamples)};
      } else {
        image.at(column, row) = {0.0, 0.0, 0.0, 0.0};
      }
    }
  }
  canvas.image(image, corner);
}

void draw_outlines(Canvas& canvas, const Grid& grid, const CellPainter& painter,
                   const Projection& look) {
  Outlines outlines;
  const double px_per_km = 1e3 * look.radius / grid.surface.scale_m();
  for (std::size_t edge = 0; edge < grid.vertices_on_edge.size(); ++edge) {
    const Index cell = grid.cells_on_edge[edge][0];
    const double size_px = px_per_km * painter.sizes_km()[static_cast<std::size_t>(cell)];
    if (!Outlines::is_visible(size_px)) continue;
    const auto [first, second] = grid.vertices_on_edge[edge];
    const Vec3& a = grid.vertex_position[static_cast<std::size_t>(first)];
    const Vec3& b = grid.vertex_position[static_cast<std::size_t>(second)];
    if (!look.is_visible(a) || !look.is_visible(b)) continue;
    outlines.add({look.pixel(a), look.pixel(b)}, {size_px, painter.is_dark(cell, a)});
  }
  outlines.draw(canvas);
}

void add_visible(std::vector<Segment>& segments, const Projection& look, const Vec3& a,
                 const Vec3& b) {
  if (look.is_visible(a) && look.is_visible(b)) segments.push_back({look.pixel(a), look.pixel(b)});
}

void draw_lines(Canvas& canvas, const Grid& grid, const LandMask* land, const Projection& look) {
  const auto point = [&](double lon_deg, double lat_deg) {
    return grid.surface.point({lon_deg * kRadPerDeg, lat_deg * kRadPerDeg}, grid.latitude);
  };
  std::vector<Segment> graticule;
  for (int lon = -180; lon < 180; lon += 30) {
    for (int lat = -90; lat < 90; lat += 2) {
      add_visible(graticule, look, point(lon, lat), point(lon, lat + 2));
    }
  }
  for (int lat = -60; lat <= 60; lat += 30) {
    for (int lon = -180; lon < 180; lon += 2) {
      add_visible(graticule, look, point(lon, lat), point(lon + 2, lat));
    }
  }
  canvas.segments(graticule, {kGraticule, 1.0});
  if (land != nullptr) {
    std::vector<Segment> coast;
    for (const Segment& piece : land->coastline()) {
      add_visible(coast, look, point(piece.from.x, piece.from.y), point(piece.to.x, piece.to.y));
    }
    canvas.segments(coast, {kCoast, 0.9});
  }
}

/// Where the line of sight grazes the surface: the image of a great circle of the unit sphere.
void draw_rim(Canvas& canvas, const Ellipsoid& surface, const Projection& look) {
  const Vec3 axis = look.view.cwiseQuotient(surface.radii()).normalized();
  const Vec3 first = axis.unitOrthogonal(), second = axis.cross(first);
  std::vector<Point> rim;
  constexpr int kPieces = 720;
  for (int i = 0; i <= kPieces; ++i) {
    const double angle = 2.0 * kPi * i / kPieces;
    const Vec3 on_sphere = std::cos(angle) * first + std::sin(angle) * second;
    rim.push_back(look.pixel(surface.radii().cwiseProduct(on_sphere)));
  }
  canvas.line(rim, {kInk, 1.6});
}

void draw_side(Canvas& canvas, const Grid& grid, const CellPainter& painter, const LandMask* land,
               const Projection& look) {
  paint_cells(canvas, painter, look);
  draw_outlines(canvas, grid, painter, look);
  draw_lines(canvas, grid, land, look);
  draw_rim(canvas, grid.surface, look);
}

}  // namespace

void draw_globe(const Grid& grid, const PictureOptions& options, const std::string& path) {
  std::optional<LandMask> mask;
  if (options.land != nullptr) mask.emplace(*options.land);
  const LandMask* land = mask ? &*mask : nullptr;
  const CellPainter painter(grid, land);
  const double unit = std::min(options.width / 1600.0, options.height / 1000.0);
  Canvas canvas(options.width, options.height, kPaper);

  const LonLat from{options.view_lon_deg * kRadPerDeg, options.view_lat_deg * kRadPerDeg};
  const LonLat behind{from.lon_rad + kPi, -from.lat_rad};
  draw_side(canvas, grid, painter, land,
            {grid.surface, {480 * unit, 540 * unit}, 425 * unit, from});
  draw_side(canvas, grid, painter, land,
            {grid.surface, {1330 * unit, 440 * unit}, 215 * unit, behind});
  canvas.text({1330 * unit, 200 * unit}, "the far side",
              {.size = 20 * unit, .anchor_x = 0.5, .anchor_y = 1.0});

  canvas.text({48 * unit, 52 * unit}, options.title, {.size = 34 * unit, .bold = true});
  double y = 740 * unit;
  for (const std::string& fact : facts(grid, painter.sizes_km())) {
    canvas.text({1330 * unit, y}, fact, {.size = 21 * unit, .anchor_x = 0.5});
    y += 36 * unit;
  }
  draw_colour_bar(canvas, painter.scale(),
                  {985 * unit, 270 * unit, std::floor(26 * unit), std::floor(560 * unit)});
  canvas.write_png(path);
}

}  // namespace delos::pictures
