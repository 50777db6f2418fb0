// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/canvas.hpp"

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/error.hpp"
#include "core/types.hpp"

namespace delos::pictures {

namespace {

// One path of very many segments is slow to stroke: cairo sorts all its outlines together.
constexpr std::size_t kSegmentsPerStroke = 512;

void set_colour(cairo_t* cairo, const Colour& colour) {
  cairo_set_source_rgba(cairo, colour.r, colour.g, colour.b, colour.a);
}

void set_line(cairo_t* cairo, const LineStyle& style) {
  set_colour(cairo, style.colour);
  cairo_set_line_width(cairo, style.width);
}

/// cairo's pixel: premultiplied alpha, 8 bits a channel, native byte order.
std::uint32_t packed(const Colour& colour) {
  const auto byte = [](double x) {
    return static_cast<std::uint32_t>(std::lround(255.0 * std::clamp(x, 0.0, 1.0)));
  };
  return byte(colour.a) << 24 | byte(colour.r * colour.a) << 16 | byte(colour.g * colour.a) << 8 |
         byte(colour.b * colour.a);
}

}  // namespace

struct Canvas::Impl {
  cairo_surface_t* surface = nullptr;
  cairo_t* cairo = nullptr;
  ~Impl() {
    if (cairo != nullptr) cairo_destroy(cairo);
    if (surface != nullptr) cairo_surface_destroy(surface);
  }
};

Colour mix(const Colour& from, const Colour& to, double t) {
  return {from.r + t * (to.r - from.r), from.g + t * (to.g - from.g), from.b + t * (to.b - from.b),
          from.a + t * (to.a - from.a)};
}

Canvas::Canvas(int width, int height, const Colour& background) : impl_(std::make_unique<Impl>()) {
  impl_->surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
  const cairo_status_t status = cairo_surface_status(impl_->surface);
  DELOS_CHECK(status == CAIRO_STATUS_SUCCESS, ErrorKind::resource, "picture of ", width, " x ",
              height, " pixels: ", cairo_status_to_string(status), ". Ask for a smaller one.");
  impl_->cairo = cairo_create(impl_->surface);
  cairo_set_line_cap(impl_->cairo, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(impl_->cairo, CAIRO_LINE_JOIN_ROUND);
  set_colour(impl_->cairo, background);
  cairo_paint(impl_->cairo);
}

Canvas::~Canvas() = default;

int Canvas::width() const { return cairo_image_surface_get_width(impl_->surface); }
int Canvas::height() const { return cairo_image_surface_get_height(impl_->surface); }

Colour Canvas::pixel(int column, int row) const {
  cairo_surface_flush(impl_->surface);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(impl_->surface));
  std::uint32_t word = 0;
  std::memcpy(&word,
              cairo_image_surface_get_data(impl_->surface) +
                  static_cast<std::size_t>(row) * stride + 4 * static_cast<std::size_t>(column),
              sizeof word);
  const auto channel = [&](int shift) { return (word >> shift & 0xffU) / 255.0; };
  const double alpha = channel(24);
  if (alpha == 0.0) return {0.0, 0.0, 0.0, 0.0};
  return {channel(16) / alpha, channel(8) / alpha, channel(0) / alpha, alpha};
}

void Canvas::image(const Image& image, const Point& top_left) {
  cairo_surface_t* source =
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height);
  unsigned char* bytes = cairo_image_surface_get_data(source);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(source));
  cairo_surface_flush(source);
  for (std::size_t row = 0; bytes != nullptr && row < static_cast<std::size_t>(image.height);
       ++row) {
    for (std::size_t column = 0; column < static_cast<std::size_t>(image.width); ++column) {
      const std::uint32_t pixel =
          packed(image.pixels[row * static_cast<std::size_t>(image.width) + column]);
      std::memcpy(bytes + row * stride + 4 * column, &pixel, sizeof pixel);
    }
  }
  cairo_surface_mark_dirty(source);
  cairo_set_source_surface(impl_->cairo, source, top_left.x, top_left.y);
  cairo_paint(impl_->cairo);
  cairo_surface_destroy(source);
}

void Canvas::segments(std::span<const Segment> segments, const LineStyle& style) {
  set_line(impl_->cairo, style);
  for (std::size_t begin = 0; begin < segments.size(); begin += kSegmentsPerStroke) {
    const std::size_t end = std::min(segments.size(), begin + kSegmentsPerStroke);
    for (std::size_t i = begin; i < end; ++i) {
      cairo_move_to(impl_->cairo, segments[i].from.x, segments[i].from.y);
      cairo_line_to(impl_->cairo, segments[i].to.x, segments[i].to.y);
    }
    cairo_stroke(impl_->cairo);
  }
}

void Canvas::line(std::span<const Point> points, const LineStyle& style) {
  set_line(impl_->cairo, style);
  cairo_new_path(impl_->cairo);
  for (const Point& point : points) cairo_line_to(impl_->cairo, point.x, point.y);
  cairo_stroke(impl_->cairo);
}

void Canvas::circle(const Point& centre, double radius, const LineStyle& style) {
  set_line(impl_->cairo, style);
  cairo_new_path(impl_->cairo);
  cairo_arc(impl_->cairo, centre.x, centre.y, radius, 0.0, 2.0 * kPi);
  cairo_stroke(impl_->cairo);
}

void Canvas::fill_box(const Box& box, const Colour& colour) {
  set_colour(impl_->cairo, colour);
  cairo_rectangle(impl_->cairo, box.x, box.y, box.width, box.height);
  cairo_fill(impl_->cairo);
}

void Canvas::frame(const Box& box, const LineStyle& style) {
  set_line(impl_->cairo, style);
  cairo_rectangle(impl_->cairo, box.x, box.y, box.width, box.height);
  cairo_stroke(impl_->cairo);
}

void Canvas::text(const Point& at, const std::string& text, const TextStyle& style) {
  cairo_t* cairo = impl_->cairo;
  cairo_select_font_face(cairo, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, style.size);
  set_colour(cairo, style.colour);
  cairo_text_extents_t extents;
  cairo_text_extents(cairo, text.c_str(), &extents);
  const double cap_height = 0.73 * style.size;  // of DejaVu Sans
  cairo_save(cairo);
  cairo_translate(cairo, at.x, at.y);
  if (style.upright) cairo_rotate(cairo, -0.5 * kPi);
  cairo_move_to(cairo, -style.anchor_x * extents.x_advance, (1.0 - style.anchor_y) * cap_height);
  cairo_show_text(cairo, text.c_str());
  cairo_restore(cairo);
}

void Canvas::clip_box(const Box& box) {
  cairo_save(impl_->cairo);
  cairo_rectangle(impl_->cairo, box.x, box.y, box.width, box.height);
  cairo_clip(impl_->cairo);
}

void Canvas::clip_disc(const Point& centre, double radius) {
  cairo_save(impl_->cairo);
  cairo_new_path(impl_->cairo);
  cairo_arc(impl_->cairo, centre.x, centre.y, radius, 0.0, 2.0 * kPi);
  cairo_clip(impl_->cairo);
}

void Canvas::unclip() { cairo_restore(impl_->cairo); }

void Canvas::write_png(const std::string& path) const {
  cairo_surface_flush(impl_->surface);
  const cairo_status_t status = cairo_surface_write_to_png(impl_->surface, path.c_str());
  DELOS_CHECK(status == CAIRO_STATUS_SUCCESS, ErrorKind::output, path,
              ": the picture can't be written (", cairo_status_to_string(status),
              "). Check the folder, its permissions and the free space.");
}

}  // namespace delos::pictures
