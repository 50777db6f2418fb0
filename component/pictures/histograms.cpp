// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/histograms.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "pictures/canvas.hpp"
#include "pictures/colour_map.hpp"

namespace delos::pictures {

namespace {

constexpr Colour kGridLine{0.12, 0.13, 0.16, 0.13};
constexpr Colour kBar{0.24, 0.47, 0.62, 1.0};
constexpr Colour kMean{0.13, 0.55, 0.33, 1.0};
constexpr Colour kExtreme{0.80, 0.25, 0.16, 1.0};

struct Mark {
  double value;
  std::string label;
  Colour colour;
};

struct Panel {
  std::string title, unit;
  const Histogram* histogram;
  std::vector<Mark> marks;
  double low, high;  // of the axis
  bool is_discrete = false;
};

/// A panel's box on the sheet and its two axes; counts are logarithmic from 0.5 up, so that a
/// single element shows.
struct Axes {
  Box box;
  double low, high, decades;
  double unit;
  double x(double value) const { return box.x + (value - low) / (high - low) * box.width; }
  double y(double count) const {
    const double t = (std::log10(std::max(count, 0.5)) - std::log10(0.5)) / decades;
    return box.y + box.height * (1.0 - t);
  }
};

double bin_width(const Histogram& histogram) {
  return (histogram.upper - histogram.lower) / static_cast<double>(histogram.counts.size());
}

/// The part of the axis that holds something, with a margin, inside the histogram's own range.
void crop(Panel& panel, double margin) {
  const Histogram& histogram = *panel.histogram;
  const double width = bin_width(histogram);
  double low = histogram.upper, high = histogram.lower;
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
    if (histogram.counts[bin] == 0) continue;
    low = std::min(low, histogram.lower + static_cast<double>(bin) * width);
    high = std::max(high, histogram.lower + static_cast<double>(bin + 1) * width);
  }
  panel.low = std::max(histogram.lower, std::min(panel.low, low - margin));
  panel.high = std::min(histogram.upper, std::max(panel.high, high + margin));
}

void draw_axes(Canvas& canvas, const Panel& panel, const Axes& axes) {
  const Box& box = axes.box;
  const double u = axes.unit;
  for (double power = 1.0; std::log10(power / 0.5) <= axes.decades; power *= 10.0) {
    const double y = axes.y(power);
    canvas.line(std::vector<Point>{{box.x, y}, {box.x + box.width, y}}, {kGridLine, 1.0});
    canvas.text({box.x - 8 * u, y}, grouped(static_cast<long long>(power)),
                {.size = 15 * u, .anchor_x = 1.0});
  }
  const int wanted = panel.is_discrete ? static_cast<int>(axes.high - axes.low) : 8;
  for (double tick : round_ticks(axes.low, axes.high, wanted)) {
    const double at = panel.is_discrete ? tick + 0.5 : tick;
    if (at > axes.high) continue;
    const double x = axes.x(at), y = box.y + box.height;
    canvas.line(std::vector<Point>{{x, y}, {x, y + 5 * u}}, {kInk, 1.2});
    canvas.text({x, y + 10 * u}, short_number(tick) + panel.unit,
                {.size = 16 * u, .anchor_x = 0.5, .anchor_y = 0.0});
  }
  canvas.line(
      std::vector<Point>{
          {box.x, box.y}, {box.x, box.y + box.height}, {box.x + box.width, box.y + box.height}},
      {kInk, 1.4});
}

void draw_bars(Canvas& canvas, const Panel& panel, const Axes& axes) {
  const Histogram& histogram = *panel.histogram;
  const double width = bin_width(histogram);
  const double gap = panel.is_discrete ? 0.12 : 0.0;
  const double total = static_cast<double>(
      std::accumulate(histogram.counts.begin(), histogram.counts.end(), std::int64_t{0}));
  for (std::size_t bin = 0; bin < histogram.counts.size(); ++bin) {
    if (histogram.counts[bin] == 0) continue;
    const double from = histogram.lower + (static_cast<double>(bin) + gap) * width;
    const double to = histogram.lower + (static_cast<double>(bin + 1) - gap) * width;
    if (to <= axes.low || from >= axes.high) continue;
    const auto count = static_cast<double>(histogram.counts[bin]);
    const double x = axes.x(from), top = axes.y(count);
    canvas.fill_box(
        {x, top, axes.x(to) - x + (gap > 0.0 ? 0.0 : 0.4), axes.box.y + axes.box.height - top},
        kBar);
    if (panel.is_discrete) {
      const double percent = 100.0 * count / total;
      canvas.text({0.5 * (x + axes.x(to)), top - 8 * axes.unit},
                  percent < 0.01 ? grouped(histogram.counts[bin]) : short_number(percent) + " %",
                  {.size = 15 * axes.unit, .anchor_x = 0.5, .anchor_y = 1.0});
    }
  }
}

void draw_marks(Canvas& canvas, const Panel& panel, const Axes& axes) {
  const Box& box = axes.box;
  double legend_x = box.x + box.width;
  for (auto mark = panel.marks.rbegin(); mark != panel.marks.rend(); ++mark) {
    const double x = std::clamp(axes.x(mark->value), box.x, box.x + box.width);
    canvas.line(std::vector<Point>{{x, box.y}, {x, box.y + box.height}}, {mark->colour, 1.8});
    canvas.text({legend_x, box.y - 20 * axes.unit}, mark->label,
                {.size = 17 * axes.unit, .colour = mark->colour, .anchor_x = 1.0});
    legend_x -= (0.62 * 17 * static_cast<double>(mark->label.size()) + 14) * axes.unit;
  }
}

void draw_panel(Canvas& canvas, const Panel& panel, const Box& box, double unit) {
  const auto most =
      *std::max_element(panel.histogram->counts.begin(), panel.histogram->counts.end());
  const double top = 2.5 * std::max(1.0, static_cast<double>(most));
  const Axes axes{box, panel.low, panel.high, std::log10(top / 0.5), unit};
  draw_bars(canvas, panel, axes);
  draw_axes(canvas, panel, axes);
  draw_marks(canvas, panel, axes);
  canvas.text({box.x, box.y - 20 * unit}, panel.title, {.size = 20 * unit, .bold = true});
}

std::vector<Panel> panels(const Quality& quality) {
  const auto label = [](const char* name, double value, const char* suffix) {
    return std::string(name) + " " + short_number(value) + suffix;
  };
  std::vector<Panel> all;
  all.push_back(
      {"Area-length quality",
       "",
       &quality.area_length,
       {{quality.area_length_min.value, label("min", quality.area_length_min.value, ""), kExtreme},
        {quality.area_length_mean, label("mean", quality.area_length_mean, ""), kMean}},
       0.9,
       1.0});
  all.push_back(
      {"Triangle angles",
       "°",
       &quality.angle_deg,
       {{quality.angle_min_deg.value, label("min", quality.angle_min_deg.value, "°"), kExtreme},
        {quality.angle_max_deg.value, label("max", quality.angle_max_deg.value, "°"), kExtreme}},
       30.0,
       90.0});
  all.push_back(
      {"Edge length / spacing",
       "",
       &quality.relative_edge,
       {{quality.relative_edge_min.value, label("min", quality.relative_edge_min.value, ""),
         kExtreme},
        {quality.relative_edge_mean, label("mean", quality.relative_edge_mean, ""), kMean},
        {quality.relative_edge_max.value, label("max", quality.relative_edge_max.value, ""),
         kExtreme}},
       0.8,
       1.2});
  if (!quality.knows_spacing) {
    all.back().title += ": spacing not known";
    all.back().marks.clear();
  }
  all.push_back({"Neighbours of a cell", "", &quality.degree, {}, 4.0, 9.0, true});
  crop(all[0], 0.02);
  crop(all[1], 3.0);
  crop(all[2], 0.05);
  crop(all[3], 0.0);
  return all;
}

}  // namespace

void draw_histograms(const Quality& quality, const PictureOptions& options,
                     const std::string& path) {
  const double unit = std::min(options.width / 1600.0, options.height / 1000.0);
  Canvas canvas(options.width, options.height, kPaper);
  canvas.text({70 * unit, 48 * unit}, options.title, {.size = 34 * unit, .bold = true});
  canvas.text({70 * unit, 88 * unit},
              text(grouped(quality.n_vertices), " cells   \u00b7   ", grouped(quality.n_triangles),
                   " triangles, ", grouped(quality.n_obtuse),
                   " obtuse   \u00b7   counts on a logarithmic axis"),
              {.size = 19 * unit});
  const std::vector<Panel> all = panels(quality);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double x = i % 2 == 0 ? 130 : 920, y = i < 2 ? 180 : 620;
    draw_panel(canvas, all[i], {x * unit, y * unit, 620 * unit, 310 * unit}, unit);
  }
  canvas.write_png(path);
}

}  // namespace delos::pictures
