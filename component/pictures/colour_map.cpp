// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/colour_map.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/types.hpp"

namespace delos::pictures {

namespace {

// The path through Oklab: lightness, hue in degrees from violet to yellow, and a chroma that is
// least where sRGB has least to offer (blue-green), so that nothing is clipped.
constexpr double kLightnessLow = 0.30;
constexpr double kLightnessHigh = 0.92;
constexpr double kHueLow = 300.0;
constexpr double kHueHigh = 100.0;
constexpr double kChromaMiddle = 0.095;
constexpr double kChromaEnds = 0.15;

constexpr double kUniformHalfWidth = 0.10;
constexpr double kLogarithmicFrom = 3.0;

double gamma_encoded(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

struct LinearRgb {
  double r, g, b;
};

/// Ottosson 2020, https://bottosson.github.io/posts/oklab/.
LinearRgb from_oklab(double lightness, double chroma, double hue_rad) {
  const double a = chroma * std::cos(hue_rad), b = chroma * std::sin(hue_rad);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

double quantile(std::vector<double>& values, double q) {
  const auto rank = static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

double round_step(double span, int wanted) {
  const double raw = span / std::max(wanted, 1);
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
    if (factor * power >= raw * 0.999) return factor * power;
  }
  return 10.0 * power;
}

}  // namespace

ColourMap::ColourMap() {
  for (std::size_t i = 0; i < kSteps; ++i) {
    const double t = static_cast<double>(i) / static_cast<double>(kSteps - 1);
    const double lightness = kLightnessLow + t * (kLightnessHigh - kLightnessLow);
    const double hue = (kHueLow + t * (kHueHigh - kHueLow)) * kRadPerDeg;
    const double off_middle = 2.0 * t - 1.0;
    const double chroma = kChromaMiddle + (kChromaEnds - kChromaMiddle) * off_middle * off_middle;
    const LinearRgb rgb = from_oklab(lightness, chroma, hue);
    table_[i] = {gamma_encoded(std::clamp(rgb.r, 0.0, 1.0)),
                 gamma_encoded(std::clamp(rgb.g, 0.0, 1.0)),
                 gamma_encoded(std::clamp(rgb.b, 0.0, 1.0)), 1.0};
  }
}

Colour ColourMap::operator()(double t) const {
  const double position = std::clamp(t, 0.0, 1.0) * static_cast<double>(kSteps - 1);
  const auto below = std::min(static_cast<std::size_t>(position), kSteps - 2);
  return mix(table_[below], table_[below + 1], position - static_cast<double>(below));
}

SizeScale::SizeScale(std::span<const double> sizes_km) {
  std::vector<double> values(sizes_km.begin(), sizes_km.end());
  const double median = quantile(values, 0.5);
  const double low = std::min(quantile(values, 0.002), median * (1.0 - kUniformHalfWidth));
  const double high = std::max(quantile(values, 0.998), median * (1.0 + kUniformHalfWidth));
  is_logarithmic_ = high > kLogarithmicFrom * low;
  const double step = is_logarithmic_ ? round_step(low, 10) : round_step(high - low, 10);
  low_km_ = std::max(std::floor(low / step) * step, 0.5 * low);
  high_km_ = std::ceil(high / step) * step;
}

double SizeScale::fraction(double size_km) const {
  const double t = is_logarithmic_ ? std::log(size_km / low_km_) / std::log(high_km_ / low_km_)
                                   : (size_km - low_km_) / (high_km_ - low_km_);
  return std::clamp(t, 0.0, 1.0);
}

std::vector<double> SizeScale::ticks_km() const {
  if (!is_logarithmic_) return round_ticks(low_km_, high_km_, 6);
  std::vector<double> ticks;
  const double first = std::pow(10.0, std::floor(std::log10(low_km_)));
  for (double power = first; power <= high_km_; power *= 10.0) {
    for (const double factor : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0}) {
      const double tick = factor * power;
      if (tick >= low_km_ * 0.999 && tick <= high_km_ * 1.001) ticks.push_back(tick);
    }
  }
  return ticks;
}

std::vector<double> round_ticks(double low, double high, int wanted) {
  std::vector<double> ticks;
  const double step = round_step(high - low, wanted);
  const auto first = static_cast<long long>(std::ceil(low / step - 1e-9));
  const auto last = static_cast<long long>(std::floor(high / step + 1e-9));
  for (long long i = first; i <= last; ++i) ticks.push_back(static_cast<double>(i) * step);
  return ticks;
}

std::string short_number(double value) {
  std::ostringstream out;
  out.precision(4);
  out << value;
  return out.str();
}

std::string grouped(long long value) {
  const std::string digits = std::to_string(value);
  std::string spaced;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) spaced += ' ';
    spaced += digits[i];
  }
  return spaced;
}

void draw_colour_bar(Canvas& canvas, const SizeScale& scale, const Box& box) {
  const bool level = box.width > box.height;
  const double unit = std::min(box.width, box.height) / 25.0;
  Image image{static_cast<int>(box.width), static_cast<int>(box.height), {}};
  image.pixels.resize(static_cast<std::size_t>(image.width) *
                      static_cast<std::size_t>(image.height));
  const double length = level ? box.width : box.height;
  const double ratio = scale.high_km() / scale.low_km();
  for (int row = 0; row < image.height; ++row) {
    for (int column = 0; column < image.width; ++column) {
      const double t = (level ? column + 0.5 : length - row - 0.5) / length;
      const double size = scale.is_logarithmic()
                              ? scale.low_km() * std::pow(ratio, t)
                              : scale.low_km() + t * (scale.high_km() - scale.low_km());
      image.at(column, row) = scale.colour(size);
    }
  }
  canvas.image(image, {box.x, box.y});
  const LineStyle ink{{0.12, 0.13, 0.16, 1.0}, 1.2};
  canvas.frame(box, ink);
  for (const double tick : scale.ticks_km()) {
    const double t = scale.fraction(tick) * length;
    if (level) {
      const double x = box.x + t, y = box.y + box.height;
      canvas.line(std::vector<Point>{{x, y}, {x, y + 7 * unit}}, ink);
      canvas.text({x, y + 12 * unit}, short_number(tick),
                  {.size = 19 * unit, .anchor_x = 0.5, .anchor_y = 0.0});
    } else {
      const double x = box.x + box.width, y = box.y + box.height - t;
      canvas.line(std::vector<Point>{{x, y}, {x + 7 * unit, y}}, ink);
      canvas.text({x + 12 * unit, y}, short_number(tick), {.size = 19 * unit});
    }
  }
  const std::string caption = "cell size (km)";
  if (level) {
    canvas.text({box.x + box.width / 2, box.y + box.height + 42 * unit}, caption,
                {.size = 20 * unit, .anchor_x = 0.5, .anchor_y = 0.0});
  } else {
    canvas.text({box.x, box.y - 22 * unit}, caption, {.size = 20 * unit, .anchor_y = 1.0});
  }
}

}  // namespace delos::pictures
