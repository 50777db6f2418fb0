// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/outline.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "geometry/tangent_frame.hpp"
#include "refine/chains.hpp"
#include "refine/line_network.hpp"

namespace delos {
namespace {

constexpr double kFinestStep = 0.125;   // of the spacing: of the points that an outline begins with
constexpr double kLongestStep = 0.02;   // of the radius: no side of a ring is missed
constexpr double kPointsPerCell = 4.0;  // of the points that are smoothed
/// Rounds of means over neighbours: sqrt(36 / 2) points, about one cell, is their width.
constexpr int kSmoothRounds = 36;
constexpr std::size_t kFewestPoints = 12;
/// Of the spacing. Vertices of the outline that are not neighbours, and every second one: triangles
/// between them can be acute.
constexpr double kApart = 1.6, kSecondApart = 1.3;

using Points = std::vector<Vec3>;
using Curve = std::function<Vec3(double)>;

double spacing_of(const SpacingField& spacing, const Vec3& p) {
  return spacing.at(p.x(), p.y(), p.z());
}

// Points of the curve from t0 on, without that of t1, so near that the spacing sees a line.
void follow(const SpacingField& spacing, const Curve& curve, std::pair<double, double> t,
            Points& out) {
  const double middle = 0.5 * (t.first + t.second);
  const Vec3 a = curve(t.first), b = curve(t.second);
  const double most = std::min(kLongestStep, kFinestStep * spacing_of(spacing, curve(middle)));
  if ((b - a).squaredNorm() > most * most) {
    follow(spacing, curve, {t.first, middle}, out);
    follow(spacing, curve, {middle, t.second}, out);
  } else {
    out.push_back(a);
  }
}

Points ring_of_disc(const Ellipsoid& surface, LatitudeKind latitude, const RegionDisc& disc,
                    const SpacingField& spacing) {
  const Ellipsoid unit = Ellipsoid::sphere(1.0);
  const Vec3 centre = unit.point(disc.centre, LatitudeKind::geocentric);
  const TangentFrame frame(centre);
  const auto radius = elementary::sincos(disc.radius_rad);
  const Curve circle = [&](double turn) {
    const auto angle = elementary::sincos(turn);
    const Vec3 p =
        radius.cos * centre + radius.sin * (angle.cos * frame.right + angle.sin * frame.ahead);
    return surface.point(unit.lon_lat(p, LatitudeKind::geocentric), latitude);
  };
  Points out;
  constexpr int kArcs = 8;  // no chord of one is short by chance
  for (int i = 0; i < kArcs; ++i) {
    follow(spacing, circle, {2.0 * kPi * i / kArcs, 2.0 * kPi * (i + 1) / kArcs}, out);
  }
  return out;
}

Points ring_of_polygon(const Ellipsoid& surface, LatitudeKind latitude, const PolygonRing& ring,
                       const SpacingField& spacing) {
  Points out;
  const std::size_t n = ring.lon_deg.size();
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    const double to_lon = next == 0 ? closing_lon_deg(ring) : ring.lon_deg[next];
    const Curve side = [&](double t) {
      const double lon = ring.lon_deg[i] + t * (to_lon - ring.lon_deg[i]);
      const double lat = ring.lat_deg[i] + t * (ring.lat_deg[next] - ring.lat_deg[i]);
      return surface.point({lon * kRadPerDeg, lat * kRadPerDeg}, latitude);
    };
    constexpr int kPieces = 4;  // a side along a parallel goes round the pole
    for (int k = 0; k < kPieces; ++k) {
      follow(spacing, side, {1.0 * k / kPieces, 1.0 * (k + 1) / kPieces}, out);
    }
  }
  return out;
}

// The closed line again, by points at equal h-mass, so many a cell.
Points even_points(const Ellipsoid& surface, const SpacingField& spacing, const Points& ring,
                   double per_cell) {
  const std::size_t n = ring.size();
  std::vector<double> mass{0.0};
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 &a = ring[i], &b = ring[(i + 1) % n];
    mass.push_back(mass.back() +
                   per_cell * (b - a).norm() / spacing_of(spacing, surface.project(0.5 * (a + b))));
  }
  Points out{ring.front()};
  for (const double cut : equal_mass_cuts(mass)) {
    const auto i = static_cast<std::size_t>(cut);
    const double u = cut - static_cast<double>(i);
    out.push_back(surface.project((1.0 - u) * ring[i] + u * ring[(i + 1) % n]));
  }
  return out;
}

void smooth_ring(const Ellipsoid& surface, Points& ring) {
  const std::size_t n = ring.size();
  for (int round = 0; round < kSmoothRounds; ++round) {
    const Points before = ring;
    for (std::size_t i = 0; i < n; ++i) {
      const Vec3 sum = before[(i + n - 1) % n] + 2.0 * before[i] + before[(i + 1) % n];
      ring[i] = surface.project(0.25 * sum);
    }
  }
}

struct OutlinePoint {
  Vec3 place;
  double spacing;
  std::size_t ring, i, n;
};

// How near two points may be.
double wanted_distance(const OutlinePoint& a, const OutlinePoint& b) {
  const std::size_t step = a.i > b.i ? a.i - b.i : b.i - a.i;
  const std::size_t apart = std::min(step, a.n - step);
  const double least = a.ring != b.ring || apart > 2 ? kApart : apart == 2 ? kSecondApart : 0.0;
  return least * std::min(a.spacing, b.spacing);
}

// A place where the rings come too near to themselves or each other; none when nowhere.
const OutlinePoint* narrow_place(std::vector<OutlinePoint>& points) {
  std::stable_sort(points.begin(), points.end(), [](const OutlinePoint& a, const OutlinePoint& b) {
    return a.place.x() < b.place.x();
  });
  for (std::size_t k = 0; k < points.size(); ++k) {
    const OutlinePoint& a = points[k];
    for (std::size_t m = k + 1; m < points.size(); ++m) {
      const OutlinePoint& b = points[m];
      if (b.place.x() - a.place.x() > kApart * a.spacing) break;
      const double least = wanted_distance(a, b);
      if ((a.place - b.place).squaredNorm() < least * least) return &a;
    }
  }
  return nullptr;
}

std::vector<Points> rings_of(const Ellipsoid& surface, LatitudeKind latitude,
                             const RegionShape& region, const SpacingField& spacing) {
  if (const auto* const disc = std::get_if<RegionDisc>(&region)) {
    return {ring_of_disc(surface, latitude, *disc, spacing)};
  }
  std::vector<Points> out;
  for (const PolygonRing& ring : std::get<std::shared_ptr<const PolygonSet>>(region)->rings) {
    out.push_back(ring_of_polygon(surface, latitude, ring, spacing));
  }
  return out;
}

}  // namespace

Outline outline_of(const Ellipsoid& surface, LatitudeKind latitude, const RegionShape& region,
                   const SpacingField& spacing) {
  Outline out;
  std::vector<OutlinePoint> all;
  for (const Points& raw : rings_of(surface, latitude, region, spacing)) {
    Points ring = even_points(surface, spacing, raw, kPointsPerCell);
    smooth_ring(surface, ring);
    ring = even_points(surface, spacing, ring, 1.0);
    if (ring.size() < kFewestPoints) {
      return {{}, text("it is ", ring.size(), " cells long at ", place_text(surface, raw.front()))};
    }
    for (std::size_t i = 0; i < ring.size(); ++i) {
      all.push_back({ring[i], spacing_of(spacing, ring[i]), out.rings.size(), i, ring.size()});
    }
    out.rings.push_back({"region", GivenLine::Kind::ring, std::move(ring)});
  }
  if (const OutlinePoint* const narrow = narrow_place(all)) {
    return {{}, text("it comes near to itself at ", place_text(surface, narrow->place))};
  }
  return out;
}

}  // namespace delos
