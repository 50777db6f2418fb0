// SPDX-License-Identifier: BSD-3-Clause
#include "cases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace shallow_water {
namespace {

using std::numbers::pi;

constexpr double kEarth_m = 6.37122e6;  // of all three tests

double nothing(double, double) { return 0.0; }

// Gauss-Legendre with five nodes on equal panels; the profiles are smooth, 32 panels leave 1e-14.
double integral(const std::function<double(double)>& f, double from, double to) {
  constexpr int kPanels = 32;
  constexpr std::array<double, 3> kNode = {0.0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 3> kWeight = {0.5688888888888889, 0.4786286704993665,
                                             0.2369268850561891};
  const double half = 0.5 * (to - from) / kPanels;
  double sum = 0.0;
  for (int panel = 0; panel < kPanels; ++panel) {
    const double middle = from + (2 * panel + 1) * half;
    sum += kWeight[0] * f(middle);
    for (std::size_t i = 1; i < kNode.size(); ++i) {
      sum += kWeight[i] * (f(middle - kNode[i] * half) + f(middle + kNode[i] * half));
    }
  }
  return half * sum;
}

struct LonLat {
  double lon, lat;
};

// [n_cells] of the polygons between the vertices, flat from the cell's point.
std::vector<LonLat> centroids(const delos::Grid& grid) {
  using Vector = std::array<double, 3>;
  const auto point = [](std::span<const double> positions, std::size_t i) {
    return Vector{positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
  };
  const auto offsets = grid.cell_offsets();
  const auto corners = grid.vertices_on_cell();
  std::vector<LonLat> all;
  for (std::size_t cell = 0; cell + 1 < offsets.size(); ++cell) {
    const Vector middle = point(grid.cell_position(), cell);
    const auto begin = static_cast<std::size_t>(offsets[cell]);
    const auto end = static_cast<std::size_t>(offsets[cell + 1]);
    Vector moment = {};
    for (std::size_t j = begin; j < end; ++j) {
      const std::size_t next = j + 1 == end ? begin : j + 1;
      const Vector a = point(grid.vertex_position(), static_cast<std::size_t>(corners[j]));
      const Vector b = point(grid.vertex_position(), static_cast<std::size_t>(corners[next]));
      // Of the pyramid over the triangle, up to a factor that all have.
      const double volume = middle[0] * (a[1] * b[2] - a[2] * b[1]) +
                            middle[1] * (a[2] * b[0] - a[0] * b[2]) +
                            middle[2] * (a[0] * b[1] - a[1] * b[0]);
      for (std::size_t i = 0; i < 3; ++i) moment[i] += volume * (middle[i] + a[i] + b[i]);
    }
    const double lon = std::atan2(moment[1], moment[0]);
    all.push_back({lon < 0.0 ? lon + 2.0 * pi : lon,
                   std::atan2(moment[2], std::hypot(moment[0], moment[1]))});
  }
  return all;
}

}  // namespace

Case Case::steady_flow() {
  Case flow;
  constexpr double kOnce_s = 12.0 * 86400.0;  // around the Earth
  flow.zonal_m_s_ = [](double lat) { return 2.0 * pi * kEarth_m / kOnce_s * std::cos(lat); };
  flow.south_rad_ = -pi / 2.0;
  flow.north_rad_ = pi / 2.0;
  flow.datum_m_ = 2.94e4 / Physics{}.gravity_m_s2;
  flow.ground_m_ = flow.bump_m_ = nothing;
  flow.view_.largest = 2e-5;
  flow.days_ = 5.0;
  flow.is_steady_ = true;
  return flow;
}

Case Case::mountain() {
  Case flow = steady_flow();
  flow.zonal_m_s_ = [](double lat) { return 20.0 * std::cos(lat); };
  flow.datum_m_ = 5960.0;
  flow.ground_m_ = [](double lon, double lat) {
    constexpr double kHeight_m = 2000.0, kRadius = pi / 9.0;
    const double r = std::hypot(lon - 1.5 * pi, lat - pi / 6.0);
    return kHeight_m * (1.0 - std::min(r, kRadius) / kRadius);
  };
  flow.view_.largest = 5e-5;
  flow.days_ = 15.0;
  flow.is_steady_ = false;
  return flow;
}

Case Case::jet() {
  Case flow;
  constexpr double kSouth = pi / 7.0, kNorth = pi / 2.0 - kSouth;
  flow.south_rad_ = kSouth;
  flow.north_rad_ = kNorth;
  flow.zonal_m_s_ = [](double lat) {
    if (lat <= kSouth || lat >= kNorth) return 0.0;
    constexpr double kMost = 80.0, kWidth = kNorth - kSouth;
    return kMost * std::exp(1.0 / ((lat - kSouth) * (lat - kNorth)) + 4.0 / (kWidth * kWidth));
  };
  flow.datum_m_ = 10000.0;
  flow.is_mean_ = true;
  flow.ground_m_ = nothing;
  flow.bump_m_ = [](double lon, double lat) {
    const double east = lon > pi ? lon - 2.0 * pi : lon;
    const double x = east * 3.0, y = (pi / 4.0 - lat) * 15.0;
    return 120.0 * std::cos(lat) * std::exp(-x * x - y * y);
  };
  flow.view_ = {.south_deg = 10.0, .north_deg = 80.0, .largest = 1.5e-4};
  flow.days_ = 6.0;
  return flow;
}

Case Case::named(const std::string& name) {
  if (name == "tc2") return steady_flow();
  if (name == "tc5") return mountain();
  if (name == "galewsky") return jet();
  throw delos::Error(delos::ErrorKind::input,
                     "there is no case \"" + name + "\": take tc2, tc5 or galewsky.");
}

// What the surface's slope must balance: -dgh/dlat, of Coriolis and centrifugal force.
double Case::push_m2_s2(double lat_rad, double radius_m, const Physics& physics) const {
  const double u_m_s = zonal_m_s_(lat_rad);
  const double coriolis_s = 2.0 * physics.rotation_rad_s * std::sin(lat_rad);
  return u_m_s * (radius_m * coriolis_s + u_m_s * std::tan(lat_rad));
}

// The datum may be the mean over the sphere of a surface that falls from the south by the integral
// of the push: by parts, that integral weighted by the area to the north.
double Case::base_m(double radius_m, const Physics& physics) const {
  if (!is_mean_) return datum_m_;
  const auto fall = [&](double lat) {
    return 0.5 * push_m2_s2(lat, radius_m, physics) * (1.0 - std::sin(lat));
  };
  return datum_m_ + integral(fall, south_rad_, north_rad_) / physics.gravity_m_s2;
}

std::vector<double> Case::ground_m(const delos::Grid& grid) const {
  std::vector<double> all_m;
  for (const auto& [lon, lat] : centroids(grid)) all_m.push_back(ground_m_(lon, lat));
  return all_m;
}

Start Case::start(const delos::Grid& grid, const Physics& physics) const {
  const double radius_m = grid.scale_m();
  const double base_m = this->base_m(radius_m, physics);
  const double base_rad = std::max(south_rad_, 0.0);
  const auto since_base = [&](const Profile& profile, double lat) {
    return integral(profile, base_rad, std::clamp(lat, south_rad_, north_rad_));
  };
  const auto push = [&](double lat) { return push_m2_s2(lat, radius_m, physics); };
  Start start;
  for (const auto& [lon, lat] : centroids(grid)) {
    const double fall_m = since_base(push, lat) / physics.gravity_m_s2;
    start.ground_m.push_back(ground_m_(lon, lat));
    start.flow.depth_m.push_back(base_m - fall_m + bump_m_(lon, lat) - ground_m_(lon, lat));
  }
  std::vector<double> stream_m2_s;  // of the grid's vertices; falls to the left of the flow
  const auto vertices = grid.vertex_lon_lat();
  for (std::size_t i = 0; i < vertices.size(); i += 2) {
    stream_m2_s.push_back(-radius_m * since_base(zonal_m_s_, vertices[i + 1]));
  }
  const auto length_m = grid.vertex_distance_m();
  for (std::size_t edge = 0; edge < length_m.size(); ++edge) {
    const auto ends = grid.vertices_on_edge().subspan(2 * edge, 2);
    const double fall_m2_s = stream_m2_s[static_cast<std::size_t>(ends[0])] -
                             stream_m2_s[static_cast<std::size_t>(ends[1])];
    start.flow.normal_m_s.push_back(fall_m2_s / length_m[edge]);
  }
  return start;
}

}  // namespace shallow_water
