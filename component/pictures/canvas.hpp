// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A sheet of pixels to draw on; canvas.cpp is the only file that names cairo. Coordinates are
// pixels, x to the right, y down, origin in the top left corner.
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace delos::pictures {

struct Point {
  double x = 0.0, y = 0.0;
};

/// sRGB, each in [0, 1], with opacity.
struct Colour {
  double r = 0.0, g = 0.0, b = 0.0, a = 1.0;
};

// What all pictures share.
inline constexpr Colour kPaper{1.0, 1.0, 1.0, 1.0};
inline constexpr Colour kInk{0.12, 0.13, 0.16, 1.0};
inline constexpr Colour kCoast{0.10, 0.10, 0.12, 0.85};

/// The colour at `t` of the way from one to the other.
Colour mix(const Colour& from, const Colour& to, double t);

struct Box {
  double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
};

struct TextStyle {
  double size = 20.0;  ///< pixels
  Colour colour{0.12, 0.13, 0.16, 1.0};
  double anchor_x = 0.0;  ///< 0: the point is the text's left end, 0.5: middle, 1: right end
  double anchor_y = 0.5;  ///< 0: the point is at the top of the capitals, 1: at the base line
  bool bold = false;
  bool upright = false;  ///< turned by 90 degrees, read from below upward
};

struct LineStyle {
  Colour colour{0.0, 0.0, 0.0, 1.0};
  double width = 1.0;  ///< pixels
};

/// A rectangle of opaque or transparent pixels, row-major from the top left.
struct Image {
  int width = 0, height = 0;
  std::vector<Colour> pixels;
  Colour& at(int column, int row) {
    return pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                  static_cast<std::size_t>(column)];
  }
};

/// Two ends of each segment.
struct Segment {
  Point from, to;
};

class Canvas {
 public:
  /// Error(resource) when cairo can't make a sheet of that size.
  Canvas(int width, int height, const Colour& background);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  int width() const;
  int height() const;
  /// What is on the sheet now.
  Colour pixel(int column, int row) const;

  void image(const Image& image, const Point& top_left);
  void segments(std::span<const Segment> segments, const LineStyle& style);
  void line(std::span<const Point> points, const LineStyle& style);
  void circle(const Point& centre, double radius, const LineStyle& style);
  void fill_box(const Box& box, const Colour& colour);
  void frame(const Box& box, const LineStyle& style);
  void text(const Point& at, const std::string& text, const TextStyle& style);
  /// Nothing is drawn outside the box (or disc) until unclip().
  void clip_box(const Box& box);
  void clip_disc(const Point& centre, double radius);
  void unclip();

  /// Error(output) with the reason when the file can't be written.
  void write_png(const std::string& path) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace delos::pictures
