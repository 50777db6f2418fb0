// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/coast.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "sizing/nearest.hpp"
#include "sizing/nodes.hpp"

namespace delos {
namespace {

/// Sides of a ring per block.
constexpr std::int64_t kSideGrain = 256;

/// Whether a coast lies between two elevations; a missing one bounds nothing.
bool is_coast(double a, double b) { return (a >= 0.0 && b < 0.0) || (b >= 0.0 && a < 0.0); }

/// Coast between row `row` and the next, and along row `row`.
void add_row(const Raster& raster, std::size_t row, std::vector<Vec3>& points) {
  const std::size_t n = raster.n_lon();
  const double* here = raster.values.data() + row * n;
  const bool has_next = row + 1 < raster.n_lat();
  for (std::size_t i = 0; i < n; ++i) {
    const bool is_last = i + 1 == n;
    if (has_next && is_coast(here[i], here[i + n])) {
      const double t = here[i] / (here[i] - here[i + n]);
      const double lat = raster.lat_deg[row] + t * (raster.lat_deg[row + 1] - raster.lat_deg[row]);
      points.push_back(unit_vector(raster.lon_deg[i], lat));
    }
    if (is_last && !raster.periodic) continue;
    const double east = here[is_last ? 0 : i + 1];
    if (!is_coast(here[i], east)) continue;
    const double east_lon = is_last ? raster.lon_deg[0] + 360.0 : raster.lon_deg[i + 1];
    const double t = here[i] / (here[i] - east);
    points.push_back(
        unit_vector(raster.lon_deg[i] + t * (east_lon - raster.lon_deg[i]), raster.lat_deg[row]));
  }
}

/// Points on the side from a to b, b left out, at most `step_deg` apart.
void add_side(const PolygonRing& ring, std::size_t a, std::size_t b, double step_deg,
              std::vector<Vec3>& points) {
  double d_lon = ring.lon_deg[b] - ring.lon_deg[a];
  d_lon -= 360.0 * std::floor((d_lon + 180.0) / 360.0);
  const double d_lat = ring.lat_deg[b] - ring.lat_deg[a];
  // A rough length is enough: cos(lat) <= 1 makes the points denser, never sparser.
  const double length = std::sqrt(d_lon * d_lon + d_lat * d_lat);
  const int n = std::max(1, static_cast<int>(std::ceil(length / step_deg)));
  for (int k = 0; k < n; ++k) {
    const double t = static_cast<double>(k) / n;
    points.push_back(unit_vector(ring.lon_deg[a] + t * d_lon, ring.lat_deg[a] + t * d_lat));
  }
}

}  // namespace

std::vector<Vec3> coast_points(parallel::Executor& exec, const Raster& elevation_m) {
  return parallel::collect<Vec3>(
      exec, static_cast<std::int64_t>(elevation_m.n_lat()), kRowGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<Vec3>& found) {
        for (std::int64_t row = begin; row < end; ++row) {
          add_row(elevation_m, static_cast<std::size_t>(row), found);
        }
      });
}

std::vector<Vec3> coast_points(parallel::Executor& exec, const PolygonSet& polygons,
                               double step_rad) {
  DELOS_ASSERT(step_rad > 0.0);
  std::vector<Vec3> points;
  for (const PolygonRing& ring : polygons.rings) {
    const std::size_t n = ring.lon_deg.size();
    const std::vector<Vec3> of_ring = parallel::collect<Vec3>(
        exec, static_cast<std::int64_t>(n), kSideGrain,
        [&](std::int64_t begin, std::int64_t end, std::vector<Vec3>& found) {
          for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
            add_side(ring, k, k + 1 == n ? 0 : k + 1, step_rad * kDegPerRad, found);
          }
        });
    points.insert(points.end(), of_ring.begin(), of_ring.end());
  }
  return points;
}

void distance_to_points(parallel::Executor& exec, const std::vector<Vec3>& points,
                        double cutoff_rad, LatLonField& distance_rad) {
  const NearestPoint tree(exec, points);
  const double chord = 2.0 * elementary::sin(0.5 * std::clamp(cutoff_rad, 0.0, kPi));
  NodeSearch search;
  search.below_chord2 = chord * chord;
  search.take = [&](Index row, Index column, std::span<const NearestPoint::Hit> hits) {
    double* values = distance_rad.values.data() + distance_rad.at(row, column);
    for (const NearestPoint::Hit& hit : hits) {
      *values++ = hit.point == kNone ? cutoff_rad : angle_of_chord2(hit.chord2);
    }
  };
  find_nearest(exec, tree, distance_rad, search);
}

void fill_coast(parallel::Executor& exec, const Ellipsoid& surface, const CoastSource& source,
                const Raster* elevation_m, LatLonField& field) {
  DELOS_CHECK(source.spacing_m > 0.0 && source.max_m >= source.spacing_m && source.rate > 0.0,
              ErrorKind::config, "coast criterion has spacing ", source.spacing_m, " m, max ",
              source.max_m, " m, rate ", source.rate,
              ": 0 < spacing <= max and rate > 0 are needed");
  DELOS_CHECK(source.land || elevation_m, ErrorKind::config,
              "coast criterion has neither land polygons nor a bathymetry: give one");
  // Side points twice as dense as the table: distances true to a quarter of a cell.
  const std::vector<Vec3> points =
      source.land ? coast_points(exec, *source.land, 0.5 * kPi / field.n_lat_cells)
                  : coast_points(exec, *elevation_m);
  DELOS_CHECK(!points.empty(), ErrorKind::input,
              source.land ? source.land->source : elevation_m->source,
              " has no coast: no elevation changes sign, or there is no polygon");
  const double cutoff = (source.max_m - source.spacing_m) / (source.rate * surface.scale_m());
  distance_to_points(exec, points, cutoff, field);
  for_rows(exec, field, [&](Index, double* values) {
    for (Index i = 0; i < field.n_lon; ++i) {
      values[i] =
          std::min(source.spacing_m + source.rate * surface.scale_m() * values[i], source.max_m);
    }
  });
}

}  // namespace delos
