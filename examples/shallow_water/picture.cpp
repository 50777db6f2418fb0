// SPDX-License-Identifier: BSD-3-Clause
#include "picture.hpp"

#include <cairo/cairo.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace shallow_water {
namespace {

constexpr int kWidth_px = 1440;  // four pixels a degree
constexpr int kHeader_px = 32;   // for the title
constexpr double kPerPixel_rad = 2.0 * std::numbers::pi / kWidth_px;
constexpr double kPerDegree_rad = std::numbers::pi / 180.0;

struct Colour {
  double red, green, blue;
};

Colour mix(const Colour& from, const Colour& to, double t) {
  return {from.red + t * (to.red - from.red), from.green + t * (to.green - from.green),
          from.blue + t * (to.blue - from.blue)};
}

// White at 0, over red or blue to dark at 1 and -1.
Colour of_sign(double value) {
  const double size = std::min(std::fabs(value), 1.0);
  const Colour full = value < 0.0 ? Colour{0.13, 0.40, 0.75} : Colour{0.80, 0.20, 0.15};
  const Colour dark = value < 0.0 ? Colour{0.02, 0.10, 0.35} : Colour{0.35, 0.02, 0.05};
  return size < 0.6 ? mix({1.0, 1.0, 1.0}, full, size / 0.6) : mix(full, dark, size / 0.4 - 1.5);
}

std::uint32_t packed(const Colour& colour) {
  const auto byte = [](double part) {
    return static_cast<std::uint32_t>(std::lround(255.0 * part));
  };
  return byte(colour.red) << 16U | byte(colour.green) << 8U | byte(colour.blue);
}

// The nearest cell, by walking to ever nearer neighbours.
class Walk {
 public:
  explicit Walk(const delos::Grid& grid)
      : position_(grid.cell_position()),
        offsets_(grid.cell_offsets()),
        neighbours_(grid.cells_on_cell()) {}
  std::size_t to(const std::array<double, 3>& point) {
    double best = closeness(cell_, point);
    for (bool moved = true; moved;) {
      moved = false;
      const auto begin = static_cast<std::size_t>(offsets_[cell_]);
      const auto end = static_cast<std::size_t>(offsets_[cell_ + 1]);
      for (std::size_t j = begin; j < end; ++j) {
        const auto other = static_cast<std::size_t>(neighbours_[j]);
        const double close = closeness(other, point);
        if (close <= best) continue;
        best = close;
        cell_ = other;
        moved = true;
      }
    }
    return cell_;
  }

 private:
  double closeness(std::size_t cell, const std::array<double, 3>& point) const {
    return position_[3 * cell] * point[0] + position_[3 * cell + 1] * point[1] +
           position_[3 * cell + 2] * point[2];
  }
  std::span<const double> position_;
  std::span<const std::int64_t> offsets_;
  std::span<const std::int32_t> neighbours_;
  std::size_t cell_ = 0;
};

// [rows, kWidth_px] the cell under each pixel.
std::vector<std::size_t> cells_of_pixels(const delos::Grid& grid, const View& view, int rows) {
  Walk walk(grid);
  std::vector<std::size_t> cells;
  for (int row = 0; row < rows; ++row) {
    const double lat = view.north_deg * kPerDegree_rad - (row + 0.5) * kPerPixel_rad;
    for (int column = 0; column < kWidth_px; ++column) {
      const double lon = (column + 0.5) * kPerPixel_rad - std::numbers::pi;
      cells.push_back(
          walk.to({std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)}));
    }
  }
  return cells;
}

// Colours of the cells on the map of the grid: by size, up to twice and down to half the mean.
std::vector<std::uint32_t> colours_of_sizes(const delos::Grid& grid) {
  const auto area_m2 = grid.cell_area_m2();
  double sum_m2 = 0.0;
  for (const double each_m2 : area_m2) sum_m2 += each_m2;
  const double mean_m2 = sum_m2 / static_cast<double>(area_m2.size());
  std::vector<std::uint32_t> colours;
  for (const double each_m2 : area_m2) {
    const double octaves = std::clamp(0.5 * std::log2(each_m2 / mean_m2), -1.0, 1.0);
    colours.push_back(packed(mix({0.35, 0.55, 0.45}, {1.0, 0.98, 0.90}, 0.5 * (octaves + 1.0))));
  }
  return colours;
}

cairo_status_t append(void* text, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

using Sheet = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

void write_title(const Sheet& sheet, const std::string& title) {
  const std::unique_ptr<cairo_t, decltype(&cairo_destroy)> pen(cairo_create(sheet.get()),
                                                               &cairo_destroy);
  cairo_select_font_face(pen.get(), "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(pen.get(), 18.0);
  cairo_set_source_rgb(pen.get(), 1.0, 1.0, 1.0);
  cairo_move_to(pen.get(), 10.0, 22.0);
  cairo_show_text(pen.get(), title.c_str());
}

std::string png_of(const Sheet& sheet) {
  std::string png;
  if (cairo_surface_write_to_png_stream(sheet.get(), append, &png) != CAIRO_STATUS_SUCCESS) {
    throw std::runtime_error("cairo can't make a picture of this size.");
  }
  return png;
}

}  // namespace

std::string draw(const delos::Grid& grid, const std::vector<double>& field, const View& view,
                 const std::string& title) {
  const int rows = static_cast<int>((view.north_deg - view.south_deg) * kWidth_px / 360.0);
  const Sheet sheet(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, kWidth_px, kHeader_px + 2 * rows + 2),
      &cairo_surface_destroy);
  write_title(sheet, title);
  cairo_surface_flush(sheet.get());
  const auto cells = cells_of_pixels(grid, view, rows);
  const auto sizes = colours_of_sizes(grid);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(sheet.get()));
  unsigned char* const pixels = cairo_image_surface_get_data(sheet.get());
  const auto row_at = [&](int row) {
    return reinterpret_cast<std::uint32_t*>(pixels + static_cast<std::size_t>(row) * stride);
  };
  constexpr std::uint32_t kOutline = 0x303840;
  for (int row = 0; row < rows; ++row) {
    std::uint32_t* const above = row_at(kHeader_px + row);
    std::uint32_t* const below = row_at(kHeader_px + rows + 2 + row);
    const std::size_t* const here = cells.data() + static_cast<std::size_t>(row) * kWidth_px;
    for (int column = 0; column < kWidth_px; ++column) {
      const std::size_t cell = here[column];
      above[column] = packed(of_sign(field[cell] / view.largest));
      const bool is_border = (column + 1 < kWidth_px && here[column + 1] != cell) ||
                             (row + 1 < rows && here[column + kWidth_px] != cell);
      below[column] = is_border ? kOutline : sizes[cell];
    }
  }
  cairo_surface_mark_dirty(sheet.get());
  return png_of(sheet);
}

}  // namespace shallow_water
