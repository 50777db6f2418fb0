// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/cell_painter.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace delos::pictures {

namespace {

constexpr Colour kLand{0.80, 0.79, 0.76, 1.0};
// Part of the land's grey over the colour of the cell; less where the cells of land count too.
constexpr double kLandCover = 0.84;
constexpr double kRegionLandCover = 0.25;
constexpr Colour kOutsideSea{0.93, 0.95, 0.97, 1.0};
constexpr Colour kRingTint{0.89, 0.29, 0.10, 1.0};
// Samples along each side of a pixel: smooths the borders between cells.
constexpr int kSamples = 2;
constexpr Colour kOutline{0.05, 0.06, 0.10, 1.0};
constexpr Colour kLightInk{0.95, 0.95, 1.0, 1.0};
// Perceived brightness (Rec. 601 weights) below which lines are light.
constexpr double kDark = 0.42;

}  // namespace

std::vector<double> cell_sizes_km(const Grid& grid) {
  std::vector<double> sizes(grid.cell_area_m2.size());
  std::transform(grid.cell_area_m2.begin(), grid.cell_area_m2.end(), sizes.begin(),
                 [](double area_m2) { return 1e-3 * std::sqrt(area_m2 * 2.0 / std::sqrt(3.0)); });
  return sizes;
}

CellPainter::CellPainter(const Grid& grid, const LandMask* land)
    : grid_(grid), land_(land), sizes_km_(cell_sizes_km(grid)), scale_(sizes_km_) {
  cell_colours_.reserve(sizes_km_.size());
  for (const double size : sizes_km_) cell_colours_.push_back(scale_.colour(size));
  if (!grid.cell_ring.empty()) {
    n_rings_ = *std::max_element(grid.cell_ring.begin(), grid.cell_ring.end());
    for (std::size_t cell = 0; cell < cell_colours_.size(); ++cell) {
      cell_colours_[cell] = tinted(cell_colours_[cell], grid.cell_ring[cell]);
    }
  }
  if (is_closed(grid)) return;
  parallel::Executor alone(1);
  nearest_.emplace(alone, std::vector<Vec3>(grid.cell_position.begin(), grid.cell_position.end()));
}

Colour CellPainter::tinted(const Colour& colour, int ring) const {
  constexpr double kFirst = 0.30, kLast = 0.80;  // shares of the tint
  if (ring <= 0) return colour;
  const double way = n_rings_ > 1 ? (ring - 1.0) / (n_rings_ - 1.0) : 1.0;
  return mix(colour, kRingTint, kFirst + way * (kLast - kFirst));
}

Colour CellPainter::ring_colour(int ring) const {
  std::vector<double> sizes(sizes_km_);
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return tinted(scale_.colour(*middle), ring);
}

void CellPainter::walk(const Vec3& p, Index& hint) const {
  double nearest = (grid_.cell_position[static_cast<std::size_t>(hint)] - p).squaredNorm();
  for (Index at = kNone; at != hint;) {
    at = hint;
    for (const Index neighbour : grid_.cells_on_cell.row(at)) {
      if (neighbour == kNone) continue;
      const double distance =
          (grid_.cell_position[static_cast<std::size_t>(neighbour)] - p).squaredNorm();
      if (distance < nearest) {
        nearest = distance;
        hint = neighbour;
      }
    }
  }
}

bool CellPainter::holds(Index cell, const Vec3& p) const {
  const auto vertices = grid_.vertices_on_cell.row(cell);
  Index before = vertices.back();
  for (const Index vertex : vertices) {
    const Vec3& from = grid_.vertex_position[static_cast<std::size_t>(before)];
    if (from.cross(grid_.vertex_position[static_cast<std::size_t>(vertex)]).dot(p) < 0.0) {
      return false;
    }
    before = vertex;
  }
  return true;
}

bool CellPainter::find(const Vec3& p, Index& hint) const {
  walk(p, hint);
  if (!nearest_ || holds(hint, p)) return true;
  constexpr double kAnywhere = 5.0;  // the longest squared chord is 4
  hint = nearest_->find(p, kAnywhere).point;
  return holds(hint, p);
}

Colour CellPainter::colour(const Vec3& p, Index& hint) const {
  const bool is_in_grid = find(p, hint);
  const Colour& own = is_in_grid ? cell_colours_[static_cast<std::size_t>(hint)] : kLand;
  if (land_ == nullptr) return own;
  const LonLat where = grid_.surface.lon_lat(p, grid_.latitude);
  const double lon = where.lon_rad * kDegPerRad, lat = where.lat_rad * kDegPerRad;
  if (is_in_grid && !land_->is_land(lon, lat)) return own;
  if (!is_in_grid && n_rings_ > 0 && !land_->is_land(lon, lat)) return kOutsideSea;
  const double shade = land_->shade(lon, lat);
  const Colour land{kLand.r * shade, kLand.g * shade, kLand.b * shade, 1.0};
  return is_in_grid ? mix(own, land, land_cover()) : land;
}

bool CellPainter::is_dark(Index cell, const Vec3& p) const {
  const Colour& own = cell_colours_[static_cast<std::size_t>(cell)];
  if (0.299 * own.r + 0.587 * own.g + 0.114 * own.b >= kDark) return false;
  if (land_ == nullptr || land_cover() < 0.5) return true;
  const LonLat where = grid_.surface.lon_lat(p, grid_.latitude);
  return !land_->is_land(where.lon_rad * kDegPerRad, where.lat_rad * kDegPerRad);
}

double CellPainter::land_cover() const { return n_rings_ > 0 ? kRegionLandCover : kLandCover; }

Image painted(const CellPainter& painter, const Box& box,
              const std::function<std::optional<Sample>(const Point&)>& sample_at) {
  Image image{static_cast<int>(box.width), static_cast<int>(box.height), {}};
  image.pixels.assign(at(image.width) * at(image.height), Colour{0.0, 0.0, 0.0, 0.0});
  Index row_start = 0;
  for (int row = 0; row < image.height; ++row) {
    Index cell = row_start;
    bool is_first = true;
    for (int column = 0; column < image.width; ++column) {
      Colour sum{0.0, 0.0, 0.0, 0.0};
      for (int sample = 0; sample < kSamples * kSamples; ++sample) {
        const int over = sample % kSamples, down = sample / kSamples;
        const std::optional<Sample> seen = sample_at(
            {box.x + column + (over + 0.5) / kSamples, box.y + row + (down + 0.5) / kSamples});
        if (!seen) continue;
        const Colour colour = painter.colour(seen->point, cell);
        if (is_first) row_start = cell;
        is_first = false;
        sum = {sum.r + seen->light * colour.r, sum.g + seen->light * colour.g,
               sum.b + seen->light * colour.b, sum.a + 1.0};
      }
      if (sum.a == 0.0) continue;
      image.at(column, row) = {sum.r / sum.a, sum.g / sum.a, sum.b / sum.a,
                               sum.a / (kSamples * kSamples)};
    }
  }
  return image;
}

void Outlines::add(const Segment& segment, const Cell& cell) {
  if (!is_visible(cell.size_px)) return;
  const double strength = (cell.size_px - kOutlineFrom_px) / (kOutlineFull_px - kOutlineFrom_px);
  const auto level =
      std::min(static_cast<std::size_t>(strength * static_cast<double>(kLevels)), kLevels - 1);
  (cell.is_dark ? light_ : dark_)[level].push_back(segment);
}

void Outlines::draw(Canvas& canvas) const {
  for (std::size_t level = 0; level < kLevels; ++level) {
    const double strength = static_cast<double>(level + 1) / static_cast<double>(kLevels);
    const double opacity = 0.06 + 0.40 * strength, width = 0.55 + 0.35 * strength;
    canvas.segments(dark_[level], {{kOutline.r, kOutline.g, kOutline.b, opacity}, width});
    canvas.segments(light_[level], {{kLightInk.r, kLightInk.g, kLightInk.b, 0.8 * opacity}, width});
  }
}

std::vector<std::string> facts(const Grid& grid, const std::vector<double>& sizes_km) {
  const auto [low, high] = std::minmax_element(sizes_km.begin(), sizes_km.end());
  std::vector<double> sorted(sizes_km);
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const Vec3 radii_km = 1e-3 * grid.surface.scale_m() * grid.surface.radii();
  std::string body = grid.surface.is_sphere() ? text("sphere of radius ", radii_km.x(), " km")
                                              : text("ellipsoid ", short_number(radii_km.x()),
                                                     " / ", short_number(radii_km.y()), " / ",
                                                     short_number(radii_km.z()), " km");
  return {text(grouped(grid.n_cells()), " cells, ", grouped(grid.n_edges()), " edges"),
          text("cell size ", short_number(*low), " to ", short_number(*high), " km, median ",
               short_number(*middle), " km"),
          body};
}

std::string summary(const Grid& grid, const std::vector<double>& sizes_km) {
  std::string joined;
  for (const std::string& fact : facts(grid, sizes_km)) {
    joined += (joined.empty() ? "" : "   \u00b7   ") + fact;
  }
  return joined;
}

}  // namespace delos::pictures
