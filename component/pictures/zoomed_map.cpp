// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <sstream>

#include "core/error.hpp"
#include "pictures/cell_painter.hpp"
#include "pictures/coastline.hpp"
#include "pictures/zoom.hpp"

namespace delos::pictures {

namespace {

constexpr Colour kZoomGraticule{0.25, 0.27, 0.32, 0.45};
// Where a culled ocean ends, beside the coast of the data.
constexpr Colour kShore{0.86, 0.33, 0.08, 1.0};
constexpr double kMargin = 0.05;    // of the larger side, around the cells
constexpr int kPiecesOfLine = 720;  // so that curves look smooth

/// A map on a box of the sheet.
struct Sheet {
  AzimuthalMap map;
  Point low, high;  // corners of what is shown, on the map
  Box box;

  double scale() const { return box.width / (high.x - low.x); }
  Point pixel(const LonLat& place) const {
    const Point p = map.forward(place);
    return {box.x + (p.x - low.x) * scale(), box.y + (high.y - p.y) * scale()};
  }
  LonLat place(const Point& pixel) const {
    return map.inverse({low.x + (pixel.x - box.x) / scale(), high.y - (pixel.y - box.y) / scale()});
  }
  bool holds(const Point& p) const {
    return p.x >= box.x && p.x <= box.x + box.width && p.y >= box.y && p.y <= box.y + box.height;
  }
};

/// The cells and a margin, or the whole disc that was asked for; fitted into the room.
Sheet sheet_of(const Grid& grid, const PictureOptions& options, const Zoom& zoom, const Box& room) {
  Sheet out{AzimuthalMap(zoom.centre), {0.0, 0.0}, {0.0, 0.0}, room};
  if (options.view_radius_deg > 0.0) {
    const double reach = 2.0 * std::sin(zoom.radius_rad / 2.0);
    out.low = {-reach, -reach};
    out.high = {reach, reach};
  } else {
    out.low = out.high = out.map.forward(grid.vertex_lon_lat[0]);
    for (const LonLat& corner : grid.vertex_lon_lat) {
      const Point p = out.map.forward(corner);
      out.low = {std::min(out.low.x, p.x), std::min(out.low.y, p.y)};
      out.high = {std::max(out.high.x, p.x), std::max(out.high.y, p.y)};
    }
  }
  const double margin = kMargin * std::max(out.high.x - out.low.x, out.high.y - out.low.y);
  out.low = {out.low.x - margin, out.low.y - margin};
  out.high = {out.high.x + margin, out.high.y + margin};
  const double width = out.high.x - out.low.x, height = out.high.y - out.low.y;
  const double scale = std::min(room.width / width, room.height / height);
  out.box.width = std::floor(scale * width);
  out.box.height = std::floor(scale * height);
  out.box.x = std::floor(room.x + (room.width - out.box.width) / 2.0);
  out.box.y = std::floor(room.y + (room.height - out.box.height) / 2.0);
  out.high.y = out.low.y + out.box.height / out.scale();
  return out;
}

/// Thin between cells, thick where the rings begin and where the grid ends.
void draw_cell_edges(Canvas& canvas, const Grid& grid, const CellPainter& painter,
                     const Sheet& sheet) {
  Outlines outlines;
  std::vector<Segment> ends, shores;
  constexpr double kClear = 1.6;  // edges are what a close-up is for
  const double px_per_km = 1e3 * kClear * sheet.scale() / grid.surface.scale_m();
  for (std::size_t edge = 0; edge < grid.vertices_on_edge.size(); ++edge) {
    const auto [v, w] = grid.vertices_on_edge[edge];
    const LonLat &from = grid.vertex_lon_lat[at(v)], &to = grid.vertex_lon_lat[at(w)];
    if (!sheet.map.shows(from) || !sheet.map.shows(to)) continue;
    const Segment segment{sheet.pixel(from), sheet.pixel(to)};
    if (!sheet.holds(segment.from) && !sheet.holds(segment.to)) continue;
    const auto [a, b] = grid.cells_on_edge[edge];
    const bool begins_rings = b != kNone && !grid.cell_ring.empty() &&
                              (grid.cell_ring[at(a)] == 0) != (grid.cell_ring[at(b)] == 0);
    if (begins_rings || (b == kNone && !grid.cell_ring.empty())) ends.push_back(segment);
    if (b == kNone && grid.cell_ring.empty()) shores.push_back(segment);
    outlines.add(segment, {px_per_km * painter.sizes_km()[at(a)],
                           painter.is_dark(a, grid.vertex_position[at(v)])});
  }
  outlines.draw(canvas);
  canvas.segments(ends, {kInk, 1.6});
  canvas.segments(shores, {kShore, 2.0});
}

void draw_coast(Canvas& canvas, const LandMask& land, const Sheet& sheet) {
  std::vector<Segment> coast;
  for (const Segment& piece : land.coastline()) {
    const LonLat from{piece.from.x * kRadPerDeg, piece.from.y * kRadPerDeg};
    const LonLat to{piece.to.x * kRadPerDeg, piece.to.y * kRadPerDeg};
    if (!sheet.map.shows(from) || !sheet.map.shows(to)) continue;
    coast.push_back({sheet.pixel(from), sheet.pixel(to)});
  }
  canvas.segments(coast, {kCoast, 1.6});
}

std::string angle_text(double degrees, const char* positive, const char* negative) {
  const double rounded = std::round(degrees * 100.0) / 100.0;
  if (rounded == 0.0) return "0°";
  if (std::abs(rounded) == 180.0) return "180°";
  return short_number(std::abs(rounded)) + "°" + (rounded > 0.0 ? positive : negative);
}

/// Where lines leave the map, labels that keep their distance from each other.
class FrameLabels {
 public:
  FrameLabels(Canvas& canvas, const Sheet& sheet, double unit)
      : canvas_(canvas), box_(sheet.box), unit_(unit) {}

  void add(const Point& p, const std::string& label) {
    const double to_left = p.x - box_.x, to_right = box_.x + box_.width - p.x;
    const double to_top = p.y - box_.y, to_bottom = box_.y + box_.height - p.y;
    const double least = std::min({to_left, to_right, to_top, to_bottom});
    if (least == to_bottom) {
      place({p.x, box_.y + box_.height + 10 * unit_}, label, {0.5, 0.0});
    } else if (least == to_top) {
      place({p.x, box_.y - 10 * unit_}, label, {0.5, 1.0});
    } else if (least == to_left) {
      place({box_.x - 10 * unit_, p.y}, label, {1.0, 0.5});
    } else {
      place({box_.x + box_.width + 10 * unit_, p.y}, label, {0.0, 0.5});
    }
  }

 private:
  void place(const Point& p, const std::string& label, const Point& anchor) {
    constexpr double kClear_x = 66.0, kClear_y = 26.0;
    for (const Point& other : placed_) {
      if (std::abs(p.x - other.x) < kClear_x * unit_ &&
          std::abs(p.y - other.y) < kClear_y * unit_) {
        return;
      }
    }
    placed_.push_back(p);
    canvas_.text(p, label, {.size = 17 * unit_, .anchor_x = anchor.x, .anchor_y = anchor.y});
  }

  Canvas& canvas_;
  Box box_;
  double unit_;
  std::vector<Point> placed_;
};

/// One line of the graticule, and its label where it crosses the frame.
template <class PlaceAt>
void draw_line(Canvas& canvas, const Sheet& sheet, const PlaceAt& place_at,
               const std::function<void(const Point&)>& at_frame) {
  std::vector<Segment> pieces;
  for (int i = 0; i < kPiecesOfLine; ++i) {
    const LonLat from = place_at(static_cast<double>(i) / kPiecesOfLine);
    const LonLat to = place_at(static_cast<double>(i + 1) / kPiecesOfLine);
    if (!sheet.map.shows(from) || !sheet.map.shows(to)) continue;
    const Segment piece{sheet.pixel(from), sheet.pixel(to)};
    const bool starts_in = sheet.holds(piece.from), ends_in = sheet.holds(piece.to);
    if (starts_in || ends_in) pieces.push_back(piece);
    if (starts_in != ends_in) at_frame(starts_in ? piece.from : piece.to);
  }
  canvas.segments(pieces, {kZoomGraticule, 1.0});
}

void draw_graticule(Canvas& canvas, const Sheet& sheet, const Zoom& zoom,
                    const std::function<void(const Point&, const std::string&)>& label) {
  const double lat_step = graticule_step(2.0 * zoom.radius_rad * kDegPerRad);
  const double lon_step = meridian_step(zoom);
  for (double lon = -180.0; lon < 180.0 - 1e-9; lon += lon_step) {
    draw_line(
        canvas, sheet,
        [&](double t) {
          return LonLat{lon * kRadPerDeg, (t - 0.5) * kPi};
        },
        [&](const Point& p) { label(p, angle_text(lon, "E", "W")); });
  }
  for (double lat = -90.0 + lat_step; lat < 90.0 - 1e-9; lat += lat_step) {
    draw_line(
        canvas, sheet,
        [&](double t) {
          return LonLat{(2.0 * t - 1.0) * kPi, lat * kRadPerDeg};
        },
        [&](const Point& p) { label(p, angle_text(lat, "N", "S")); });
  }
}

void draw_ring_legend(Canvas& canvas, const CellPainter& painter, const Point& corner,
                      double unit) {
  if (painter.n_rings() == 0) return;
  const double side = 30 * unit;
  canvas.text({corner.x, corner.y - 16 * unit}, "rings (bdyMaskCell), 1 inside",
              {.size = 19 * unit, .anchor_y = 1.0});
  for (int ring = 1; ring <= painter.n_rings(); ++ring) {
    const Box box{corner.x + (ring - 1) * side, corner.y, side, side};
    if (box.x + side > canvas.width()) return;
    canvas.fill_box(box, painter.ring_colour(ring));
    canvas.frame(box, {kInk, 1.0});
    canvas.text({box.x + side / 2.0, box.y + side + 10 * unit}, text(ring),
                {.size = 15 * unit, .anchor_x = 0.5, .anchor_y = 0.0});
  }
}

/// Sheets grow until the middle cell measures some pixels, up to twice.
double enlargement(const CellPainter& painter, double px_per_km) {
  constexpr double kWanted_px = 7.0, kMost = 2.0;
  std::vector<double> sizes(painter.sizes_km());
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return std::clamp(kWanted_px / (px_per_km * *middle), 1.0, kMost);
}

Box room_for_map(double unit) { return {95 * unit, 120 * unit, 1050 * unit, 810 * unit}; }

}  // namespace

void draw_zoomed_map(const Grid& grid, const PictureOptions& options, const Zoom& zoom,
                     const std::string& path) {
  std::optional<LandMask> mask;
  if (options.land != nullptr) mask.emplace(*options.land);
  const CellPainter painter(grid, mask ? &*mask : nullptr);
  const double plain = std::min(options.width / 1600.0, options.height / 1000.0);
  const double px_per_km =
      1e3 * sheet_of(grid, options, zoom, room_for_map(plain)).scale() / grid.surface.scale_m();
  const double larger = enlargement(painter, px_per_km), unit = larger * plain;
  Canvas canvas(static_cast<int>(larger * options.width), static_cast<int>(larger * options.height),
                kPaper);
  const Sheet sheet = sheet_of(grid, options, zoom, room_for_map(unit));

  canvas.image(painted(painter, sheet.box,
                       [&](const Point& p) -> std::optional<Sample> {
                         return Sample{grid.surface.point(sheet.place(p), grid.latitude)};
                       }),
               {sheet.box.x, sheet.box.y});
  canvas.clip_box(sheet.box);
  draw_cell_edges(canvas, grid, painter, sheet);
  std::vector<std::pair<Point, std::string>> labels;
  draw_graticule(canvas, sheet, zoom,
                 [&](const Point& p, const std::string& label) { labels.emplace_back(p, label); });
  if (mask) draw_coast(canvas, *mask, sheet);
  canvas.unclip();
  canvas.frame(sheet.box, {kInk, 1.4});
  FrameLabels at_frame(canvas, sheet, unit);
  for (const auto& [p, label] : labels) at_frame.add(p, label);

  canvas.text({48 * unit, 52 * unit}, options.title, {.size = 34 * unit, .bold = true});
  double y = 165 * unit;
  for (const std::string& fact : facts(grid, painter.sizes_km())) {
    std::istringstream parts(fact);
    for (std::string part; std::getline(parts, part, ','); y += 30 * unit) {
      canvas.text({1230 * unit, y}, part.substr(part.find_first_not_of(' ')), {.size = 19 * unit});
    }
  }
  draw_ring_legend(canvas, painter, {1230 * unit, 385 * unit}, unit);
  draw_colour_bar(canvas, painter.scale(),
                  {1230 * unit, 500 * unit, std::floor(26 * unit), std::floor(420 * unit)});
  canvas.write_png(path);
}

}  // namespace delos::pictures
