// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/analytic.hpp"

#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "sizing/coast.hpp"
#include "sizing/nodes.hpp"

namespace delos {
namespace {

/// Widths beyond which exp(-d^2 / (2 width^2)) is below 2e-8.
constexpr double kGaussianReach = 6.0;
/// A pole itself belongs to what lies just beside it.
constexpr double kNearPole_deg = 90.0 - 1.0e-6;
/// Places a task; no result depends on it.
constexpr std::int64_t kPlaceGrain = 1024;

void check_edge(const RegionEdge& edge) {
  for (const double h : {edge.spacing_m, edge.outside_m}) {
    DELOS_CHECK(std::isfinite(h) && h > 0.0, ErrorKind::config, "spacing of a region is ", h,
                " m: it must be finite and > 0");
  }
  DELOS_CHECK(std::isfinite(edge.width_rad) && edge.width_rad >= 0.0, ErrorKind::config,
              "width of a region's transition is ", edge.width_rad * kDegPerRad,
              " deg: it must be >= 0");
}

double squared(double x) { return x * x; }

/// Spacing at the distance d (rad) outside the edge; d <= 0 is inside.
double spacing_at(const RegionEdge& edge, double d) {
  if (d <= 0.0) return edge.spacing_m;
  if (edge.width_rad == 0.0) return edge.outside_m;
  const double t = d / edge.width_rad;
  if (edge.transition == Transition::gaussian) {
    return edge.outside_m - (edge.outside_m - edge.spacing_m) * elementary::exp(-0.5 * t * t);
  }
  if (t >= 1.0) return edge.outside_m;
  const double share = edge.transition == Transition::linear ? t : t * t * (3.0 - 2.0 * t);
  return edge.spacing_m + (edge.outside_m - edge.spacing_m) * share;
}

/// The distance beyond which spacing_at() is `outside` to the last bit, and its squared chord: what
/// most nodes of a global table are beyond, so that no angle is needed for them.
struct Reach {
  explicit Reach(const RegionEdge& edge, double radius_rad = 0.0);
  bool is_beyond(double chord2) const { return chord2 > chord2_; }

 private:
  double chord2_ = 5.0;  ///< above the longest: no node is beyond
};

Reach::Reach(const RegionEdge& edge, double radius_rad) {
  double widths = 1.0;
  if (edge.transition == Transition::gaussian) {
    // exp(-t^2 / 2) times the difference must vanish against a quarter of outside's last bit.
    const double share = std::abs(edge.outside_m - edge.spacing_m) / edge.outside_m;
    widths = std::sqrt(2.0 * std::max(elementary::log(0x1p56 * std::max(share, 1e-300)), 0.0));
  }
  // Well above the rounding of chords and angles, and away from the antipode, where a chord says
  // little about the angle.
  constexpr double kMargin = 1.0e-9, kFarthest = 3.0;
  const double angle = radius_rad + widths * edge.width_rad + kMargin;
  if (angle < kFarthest) chord2_ = squared(2.0 * elementary::sin(0.5 * angle)) * (1.0 + kMargin);
}

/// Great-circle distance to a piece of a meridian.
class MeridianPiece {
 public:
  MeridianPiece(double lon_deg, double south_deg, double north_deg)
      : south_deg_(south_deg),
        north_deg_(north_deg),
        lon_(elementary::sincos(lon_deg * kRadPerDeg)),
        south_lat_(elementary::sincos(south_deg * kRadPerDeg)),
        north_lat_(elementary::sincos(north_deg * kRadPerDeg)),
        south_(unit_vector(lon_deg, south_deg)),
        north_(unit_vector(lon_deg, north_deg)) {}

  /// The place of a direction p as to the piece: abreast of it, or nearest to one of its ends.
  struct View {
    bool is_abreast;
    double measure;  ///< |sine| of the angle when abreast, else squared chord
    double angle() const {
      return is_abreast ? elementary::asin(measure) : angle_of_chord2(measure);
    }
    /// Not above the squared chord.
    double least_chord2() const { return is_abreast ? measure * measure : measure; }
  };
  View view(const Vec3& p) const {
    const double forward = p[0] * lon_.cos + p[1] * lon_.sin;  // in the half plane of the meridian
    if (forward > 0.0 && is_between(p[2], forward)) {
      return {true, std::abs(p[1] * lon_.cos - p[0] * lon_.sin)};
    }
    return {false, std::min((p - south_).squaredNorm(), (p - north_).squaredNorm())};
  }

 private:
  /// Whether the latitude atan2(up, forward) is between the ends; the sines of the differences say
  /// so but for roundings.
  bool is_between(double up, double forward) const {
    constexpr double kSure = 1.0e-13;
    const double above_south = up * south_lat_.cos - forward * south_lat_.sin;
    const double below_north = forward * north_lat_.sin - up * north_lat_.cos;
    if (std::min(above_south, below_north) > kSure) return true;
    if (std::min(above_south, below_north) < -kSure) return false;
    const double lat_deg = elementary::atan2(up, forward) * kDegPerRad;
    return lat_deg >= south_deg_ && lat_deg <= north_deg_;
  }

  double south_deg_, north_deg_;
  elementary::SinCos lon_, south_lat_, north_lat_;
  Vec3 south_, north_;
};

double turn_into(double lon_deg, double west_deg) {
  return lon_deg - 360.0 * std::floor((lon_deg - west_deg) / 360.0);
}

/// The corners of a ring with the detour over a pole that a ring round it needs.
PolygonRing closed_ring(const PolygonRing& ring) {
  PolygonRing closed = ring;
  if (ring.lon_deg.empty()) return closed;
  const double gap = ring.lon_deg.back() - ring.lon_deg.front();
  if (std::abs(gap) > 180.0) {
    double sum = 0.0;
    for (const double lat : ring.lat_deg) sum += lat;
    const double pole = sum < 0.0 ? -90.0 : 90.0;
    const double end = ring.lon_deg.front() + (gap > 0.0 ? 360.0 : -360.0);
    closed.lon_deg.insert(closed.lon_deg.end(), {end, end, ring.lon_deg.front()});
    closed.lat_deg.insert(closed.lat_deg.end(), {ring.lat_deg.front(), pole, pole});
  }
  closed.lon_deg.push_back(ring.lon_deg.front());
  closed.lat_deg.push_back(ring.lat_deg.front());
  return closed;
}

struct ClosedRing {
  PolygonRing ring;
  double south_deg, north_deg;
};

std::vector<ClosedRing> close_rings(parallel::Executor& exec, const PolygonSet& polygons) {
  std::vector<ClosedRing> rings(polygons.rings.size());
  parallel::for_index(exec, static_cast<std::int64_t>(rings.size()), 1, [&](std::int64_t r) {
    ClosedRing& closed = rings[static_cast<std::size_t>(r)];
    closed = {closed_ring(polygons.rings[static_cast<std::size_t>(r)]), 90.0, -90.0};
    for (const double lat : closed.ring.lat_deg) {
      closed.south_deg = std::min(closed.south_deg, lat);
      closed.north_deg = std::max(closed.north_deg, lat);
    }
  });
  return rings;
}

/// Longitudes where the ring crosses a parallel, ascending; always an even number.
std::vector<double> crossings(const ClosedRing& closed, double lat) {
  std::vector<double> lon;
  // A side counts when it begins at or below the parallel and ends above, or the other way.
  if (lat < closed.south_deg || lat >= closed.north_deg) return lon;
  const PolygonRing& ring = closed.ring;
  for (std::size_t k = 1; k < ring.lon_deg.size(); ++k) {
    const double a = ring.lat_deg[k - 1], b = ring.lat_deg[k];
    if ((a <= lat) == (b <= lat)) continue;
    lon.push_back(ring.lon_deg[k - 1] +
                  (lat - a) / (b - a) * (ring.lon_deg[k] - ring.lon_deg[k - 1]));
  }
  std::sort(lon.begin(), lon.end());
  return lon;
}

/// Flips the columns with longitude in [west, east), any number of turns away.
void flip_columns(double west, double east, Index n_lon, char* row) {
  const double per_degree = n_lon / 360.0;
  const auto begin = static_cast<std::int64_t>(std::ceil((west + 180.0) * per_degree));
  const auto end = static_cast<std::int64_t>(std::ceil((east + 180.0) * per_degree));
  for (std::int64_t k = begin; k < end; ++k) {
    row[((k % n_lon) + n_lon) % n_lon] ^= 1;
  }
}

/// Slopes of the monotone cubic at the points (weighted harmonic mean of the neighbours').
std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  std::vector<double> slope(n, 0.0);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double h0 = x[k] - x[k - 1], h1 = x[k + 1] - x[k];
    const double d0 = (y[k] - y[k - 1]) / h0, d1 = (y[k + 1] - y[k]) / h1;
    if (d0 * d1 <= 0.0) continue;
    const double w0 = 2.0 * h1 + h0, w1 = h1 + 2.0 * h0;
    slope[k] = (w0 + w1) / (w0 / d0 + w1 / d1);
  }
  return slope;
}

double profile_at(const LatitudeProfileSource& source, const std::vector<double>& slope,
                  double lat) {
  const std::vector<double>&x = source.lat_deg, &y = source.spacing_m;
  if (lat <= x.front()) return y.front();
  if (lat >= x.back()) return y.back();
  const auto k = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), lat) - x.begin());
  const double h = x[k] - x[k - 1], t = (lat - x[k - 1]) / h, r = 1.0 - t;
  if (!source.cubic) return r * y[k - 1] + t * y[k];
  return r * r * (1.0 + 2.0 * t) * y[k - 1] + t * t * (3.0 - 2.0 * t) * y[k] +
         h * t * r * (r * slope[k - 1] - t * slope[k]);
}

void check_profile(const LatitudeProfileSource& source) {
  const std::vector<double>& lat = source.lat_deg;
  DELOS_CHECK(lat.size() == source.spacing_m.size() && lat.size() >= 2, ErrorKind::config,
              "latitude profile has ", lat.size(), " latitudes and ", source.spacing_m.size(),
              " spacings: give the same number, at least 2");
  for (std::size_t k = 0; k < lat.size(); ++k) {
    DELOS_CHECK(std::abs(lat[k]) <= 90.0 && (k == 0 || lat[k] > lat[k - 1]), ErrorKind::config,
                "latitude profile has latitude ", lat[k],
                " deg: they must ascend within [-90, 90] deg");
    DELOS_CHECK(std::isfinite(source.spacing_m[k]) && source.spacing_m[k] > 0.0, ErrorKind::config,
                "latitude profile has spacing ", source.spacing_m[k], " m at ", lat[k],
                " deg: it must be finite and > 0");
  }
}

}  // namespace

void fill_constant(parallel::Executor& exec, const ConstantSource& source, LatLonField& field) {
  DELOS_CHECK(std::isfinite(source.spacing_m) && source.spacing_m > 0.0, ErrorKind::config,
              "constant spacing is ", source.spacing_m, " m: it must be finite and > 0");
  for_rows(exec, field,
           [&](Index, double* values) { std::fill_n(values, field.n_lon, source.spacing_m); });
}

void fill_latitude_profile(parallel::Executor& exec, const LatitudeProfileSource& source,
                           LatLonField& field) {
  check_profile(source);
  const std::vector<double> slope = monotone_slopes(source.lat_deg, source.spacing_m);
  for_rows(exec, field, [&](Index row, double* values) {
    std::fill_n(values, field.n_lon,
                profile_at(source, slope, 180.0 * row / field.n_lat_cells - 90.0));
  });
}

void fill_disc(parallel::Executor& exec, const DiscSource& source, LatLonField& field) {
  check_edge(source.edge);
  DELOS_CHECK(std::isfinite(source.radius_rad) && source.radius_rad >= 0.0 &&
                  std::abs(source.lat_deg) <= 90.0,
              ErrorKind::config, "disc of radius ", source.radius_rad * kDegPerRad,
              " deg at latitude ", source.lat_deg,
              " deg: the radius must be >= 0, the latitude within [-90, 90] deg");
  const NodeDirections nodes(field);
  const Vec3 centre = unit_vector(source.lon_deg, source.lat_deg);
  const Reach reach(source.edge, source.radius_rad);
  for_rows(exec, field, [&](Index row, double* values) {
    for (Index i = 0; i < field.n_lon; ++i) {
      const double chord2 = (nodes.direction(row, i) - centre).squaredNorm();
      values[i] = reach.is_beyond(chord2)
                      ? source.edge.outside_m
                      : spacing_at(source.edge, angle_of_chord2(chord2) - source.radius_rad);
    }
  });
}

void fill_box(parallel::Executor& exec, const BoxSource& source, LatLonField& field) {
  check_edge(source.edge);
  DELOS_CHECK(
      source.south_deg < source.north_deg && source.south_deg >= -90.0 && source.north_deg <= 90.0,
      ErrorKind::config, "box from latitude ", source.south_deg, " to ", source.north_deg,
      " deg: south must be below north, both within [-90, 90] deg");
  const bool is_ring = source.east_deg - source.west_deg >= 360.0;
  const double width = is_ring ? 360.0 : turn_into(source.east_deg - source.west_deg, 0.0);
  const NodeDirections nodes(field);
  const MeridianPiece west(source.west_deg, source.south_deg, source.north_deg);
  const MeridianPiece east(source.east_deg, source.south_deg, source.north_deg);
  const Reach reach(source.edge);
  for_rows(exec, field, [&](Index row, double* values) {
    const double lat = 180.0 * row / field.n_lat_cells - 90.0;
    const double off = std::max(std::max(source.south_deg - lat, lat - source.north_deg), 0.0);
    for (Index i = 0; i < field.n_lon; ++i) {
      const double lon = turn_into(360.0 * i / field.n_lon - 180.0, source.west_deg);
      if (lon - source.west_deg <= width) {
        values[i] = spacing_at(source.edge, off * kRadPerDeg);
        continue;
      }
      const Vec3 p = nodes.direction(row, i);
      const MeridianPiece::View to_west = west.view(p), to_east = east.view(p);
      values[i] = reach.is_beyond(std::min(to_west.least_chord2(), to_east.least_chord2()))
                      ? source.edge.outside_m
                      : spacing_at(source.edge, std::min(to_west.angle(), to_east.angle()));
    }
  });
}

std::vector<char> inside_polygons(parallel::Executor& exec, const PolygonSet& polygons,
                                  const LatLonField& like) {
  std::vector<char> inside(like.values.size(), 0);
  const std::vector<ClosedRing> rings = close_rings(exec, polygons);
  parallel::for_index(exec, like.n_rows(), kRowGrain, [&](std::int64_t j) {
    const auto row = static_cast<Index>(j);
    const double lat = 180.0 * row / like.n_lat_cells - 90.0;
    char* const row_inside = inside.data() + like.at(row, 0);
    std::vector<char> of_one(static_cast<std::size_t>(like.n_lon), 0);
    bool is_crossed = false;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const std::vector<double> lon =
          crossings(rings[r], std::clamp(lat, -kNearPole_deg, kNearPole_deg));
      for (std::size_t k = 0; k + 1 < lon.size(); k += 2) {
        flip_columns(lon[k], lon[k + 1], like.n_lon, of_one.data());
      }
      is_crossed = is_crossed || !lon.empty();
      const bool is_last =
          r + 1 == rings.size() || rings[r + 1].ring.polygon != rings[r].ring.polygon;
      if (!is_crossed || !is_last) continue;
      for (std::size_t i = 0; i < of_one.size(); ++i) row_inside[i] |= of_one[i];
      std::fill(of_one.begin(), of_one.end(), 0);
      is_crossed = false;
    }
  });
  return inside;
}

std::vector<char> inside_polygons(parallel::Executor& exec, const PolygonSet& polygons,
                                  std::span<const LonLat> places) {
  std::vector<char> inside(places.size(), 0);
  const std::vector<ClosedRing> rings = close_rings(exec, polygons);
  const auto is_inside = [&](const LonLat& place) {
    const double lat_deg = std::clamp(place.lat_rad * kDegPerRad, -kNearPole_deg, kNearPole_deg);
    const double lon_deg = place.lon_rad * kDegPerRad;
    bool is_in_one = false;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      const std::vector<double> lon = crossings(rings[r], lat_deg);
      for (std::size_t k = 0; k + 1 < lon.size(); k += 2) {
        // Stretches are at most a turn long.
        if (turn_into(lon_deg, lon[k]) < lon[k + 1]) is_in_one = !is_in_one;
      }
      const bool is_last =
          r + 1 == rings.size() || rings[r + 1].ring.polygon != rings[r].ring.polygon;
      if (is_last && is_in_one) return true;
    }
    return false;
  };
  parallel::for_index(exec, static_cast<std::int64_t>(places.size()), kPlaceGrain,
                      [&](std::int64_t i) {
                        const auto k = static_cast<std::size_t>(i);
                        inside[k] = is_inside(places[k]) ? 1 : 0;
                      });
  return inside;
}

void fill_polygon(parallel::Executor& exec, const PolygonSource& source, LatLonField& field) {
  check_edge(source.edge);
  DELOS_CHECK(source.polygons && !source.polygons->rings.empty(), ErrorKind::input,
              source.polygons ? source.polygons->source : "polygon source",
              " holds no polygon: check the file and the feature's name");
  const std::vector<char> inside = inside_polygons(exec, *source.polygons, field);
  const double reach = source.edge.width_rad *
                       (source.edge.transition == Transition::gaussian ? kGaussianReach : 1.0);
  // Side points twice as dense as the table: distances true to a quarter of a cell.
  const double step = 0.5 * kPi / field.n_lat_cells;
  distance_to_points(exec, coast_points(exec, *source.polygons, step), reach, field);
  for_rows(exec, field, [&](Index row, double* values) {
    for (Index i = 0; i < field.n_lon; ++i) {
      const bool is_inside = inside[field.at(row, i)] != 0;
      const bool is_beyond = values[i] >= reach;
      values[i] = is_inside   ? source.edge.spacing_m
                  : is_beyond ? source.edge.outside_m
                              : spacing_at(source.edge, values[i]);
    }
  });
}

}  // namespace delos
