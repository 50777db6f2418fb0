// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/globe.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "pictures/canvas.hpp"
#include "pictures/cell_painter.hpp"
#include "pictures/coastline.hpp"
#include "pictures/zoom.hpp"

namespace delos::pictures {

namespace {

constexpr Colour kGraticule{1.0, 1.0, 1.0, 0.30};
// The rim is drawn this much darker than the middle, so that the picture reads as a ball.
constexpr double kShadow = 0.16;

/// Orthographic projection onto a disc of the sheet.
struct Projection {
  const Ellipsoid* surface;
  Point centre;
  double radius;  // pixels of one scaled unit
  double disc;    // pixels that are shown around the centre
  Vec3 view, east, north;
  Point origin;  // of the point in the centre, along east and north
  double meridians_deg = 30.0, parallels_deg = 30.0;  // between lines of the graticule

  Projection(const Ellipsoid& body, const Point& middle, double pixels, const LonLat& from)
      : surface(&body), centre(middle), radius(pixels), disc(pixels) {
    const double clat = std::cos(from.lat_rad), slat = std::sin(from.lat_rad);
    const double clon = std::cos(from.lon_rad), slon = std::sin(from.lon_rad);
    view = Vec3(clat * clon, clat * slon, slat);
    east = Vec3(-slon, clon, 0.0);
    north = view.cross(east);
  }
  Point pixel(const Vec3& p) const {
    return {centre.x + radius * (p.dot(east) - origin.x),
            centre.y - radius * (p.dot(north) - origin.y)};
  }
  bool is_visible(const Vec3& p) const { return surface->normal(p).dot(view) > 0.0; }
  /// The point of the surface seen at a pixel, if any.
  std::optional<Vec3> point(const Point& pixel) const {
    const Vec3 q = ((pixel.x - centre.x) / radius + origin.x) * east -
                   ((pixel.y - centre.y) / radius - origin.y) * north;
    const Vec3 weight = surface->inverse_square();
    const double a = view.dot(weight.cwiseProduct(view)), b = view.dot(weight.cwiseProduct(q));
    const double c = q.dot(weight.cwiseProduct(q)) - 1.0;
    const double square = b * b - a * c;
    if (square <= 0.0) return std::nullopt;
    return Vec3(q + (std::sqrt(square) - b) / a * view);
  }
};

void paint_cells(Canvas& canvas, const CellPainter& painter, const Projection& look) {
  const double side = 2 * std::ceil(look.disc) + 2;
  const Box box{std::floor(look.centre.x - look.disc) - 1,
                std::floor(look.centre.y - look.disc) - 1, side, side};
  const auto sample_at = [&](const Point& at) -> std::optional<Sample> {
    if (std::hypot(at.x - look.centre.x, at.y - look.centre.y) > look.disc) return std::nullopt;
    const std::optional<Vec3> p = look.point(at);
    if (!p) return std::nullopt;
    return Sample{*p,
                  1.0 - kShadow * (1.0 - std::max(0.0, look.surface->normal(*p).dot(look.view)))};
  };
  canvas.image(painted(painter, box, sample_at), {box.x, box.y});
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
  const int n_meridians = static_cast<int>(std::lround(360.0 / look.meridians_deg));
  const double piece = std::min(2.0, look.parallels_deg / 4.0);
  const int n_pieces = static_cast<int>(std::lround(180.0 / piece));
  for (int i = 0; i < n_meridians; ++i) {
    const double lon = -180.0 + i * look.meridians_deg;
    for (int k = 0; k < n_pieces; ++k) {
      add_visible(graticule, look, point(lon, k * piece - 90.0),
                  point(lon, (k + 1) * piece - 90.0));
    }
  }
  const int n_parallels = static_cast<int>(std::lround(180.0 / look.parallels_deg)) - 1;
  for (int i = 1; i <= n_parallels; ++i) {
    const double lat = -90.0 + i * look.parallels_deg;
    for (int k = 0; k < 2 * n_pieces; ++k) {
      add_visible(graticule, look, point(k * piece - 180.0, lat),
                  point((k + 1) * piece - 180.0, lat));
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
  const bool is_whole = look.disc == look.radius;
  if (!is_whole) canvas.clip_disc(look.centre, look.disc);
  draw_outlines(canvas, grid, painter, look);
  draw_lines(canvas, grid, land, look);
  if (is_whole) return draw_rim(canvas, grid.surface, look);
  canvas.unclip();
  canvas.circle(look.centre, look.disc, {kInk, 1.6});
}

/// The cap fills the disc.
Projection close_up(const Grid& grid, const Point& middle, double disc, const Zoom& zoom) {
  constexpr double kRoom = 1.08;  // around the cap
  Projection out(grid.surface, middle, disc, zoom.centre);
  out.radius = disc / std::sin(std::min(kRoom * zoom.radius_rad, kPi / 2.0));
  const Vec3 p = grid.surface.point(zoom.centre, grid.latitude);
  out.origin = {p.dot(out.east), p.dot(out.north)};
  out.parallels_deg = graticule_step(2.0 * zoom.radius_rad * kDegPerRad);
  out.meridians_deg = meridian_step(zoom);
  return out;
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
  const bool is_far = options.has_view && options.view_radius_deg == 0.0;
  const std::optional<Zoom> zoom = is_far ? std::nullopt : zoom_of(grid, options);
  const Point middle{480 * unit, 540 * unit};
  draw_side(canvas, grid, painter, land,
            zoom ? close_up(grid, middle, 425 * unit, *zoom)
                 : Projection(grid.surface, middle, 425 * unit, from));
  draw_side(canvas, grid, painter, land,
            {grid.surface, {1330 * unit, 440 * unit}, 215 * unit, zoom ? zoom->centre : behind});
  canvas.text({1330 * unit, 200 * unit}, zoom ? "where it is" : "the far side",
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
