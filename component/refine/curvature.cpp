// SPDX-License-Identifier: BSD-3-Clause
#include "refine/curvature.hpp"

#include <cmath>

#include "core/error.hpp"
#include "geometry/tangent_frame.hpp"
#include "refine/work_mesh.hpp"

namespace delos {
namespace {

// Points looked at, one every two degrees of parametric latitude and longitude: they gather where a
// flat body bends, as its parametric lines do.
constexpr Index kRows = 90, kColumns = 180;
constexpr std::int64_t kRowGrain = 8;  // rows a task: about a third of a millisecond

struct Tightest {
  double turn = 0.0;  ///< spacing over radius of curvature: radians along an edge
  Vec3 place{0, 0, 0};
};

Tightest tightest_of_row(const Ellipsoid& surface, const SpacingField& spacing, std::int64_t row) {
  Tightest worst;
  for (Index column = 0; column < kColumns; ++column) {
    const LonLat at{kPi * (2.0 * column / kColumns - 1.0),
                    kPi * ((static_cast<double>(row) + 0.5) / kRows - 0.5)};
    const Vec3 p = surface.point(at, LatitudeKind::parametric);
    const double turn = spacing.at(p.x(), p.y(), p.z()) / least_radius_of_curvature(surface, p);
    if (turn > worst.turn) worst = {turn, p};
  }
  return worst;
}

}  // namespace

// The normal curvature along the unit tangent t is t.Wt / |Wp|, W = diag(1 / r_i^2); over the
// tangent plane with the basis (t, s) its greatest value is the larger root of a quadratic.
double least_radius_of_curvature(const Ellipsoid& surface, const Vec3& p) {
  const Vec3& w = surface.inverse_square();
  const Vec3 gradient = p.cwiseProduct(w);
  const TangentFrame plane(gradient.normalized());
  const Vec3 &t = plane.right, &s = plane.ahead;
  const double tt = t.cwiseProduct(w).dot(t), ts = t.cwiseProduct(w).dot(s);
  const double ss = s.cwiseProduct(w).dot(s), half = 0.5 * (tt - ss);
  return gradient.norm() / (0.5 * (tt + ss) + std::sqrt(half * half + ts * ts));
}

void check_curvature(parallel::Executor& exec, const Ellipsoid& surface,
                     const SpacingField& spacing) {
  if (surface.radii().minCoeff() >= kFlattestForPlanes) return;
  const Tightest worst = parallel::reduce(
      exec, kRows, kRowGrain, Tightest{},
      [&](std::int64_t begin, std::int64_t end) {
        Tightest found;
        for (std::int64_t row = begin; row < end; ++row) {
          const Tightest here = tightest_of_row(surface, spacing, row);
          if (here.turn > found.turn) found = here;
        }
        return found;
      },
      [](const Tightest& a, const Tightest& b) { return b.turn > a.turn ? b : a; });
  if (worst.turn <= 1.0) return;
  const Vec3& p = worst.place;
  const LonLat at = surface.lon_lat(p, LatitudeKind::geodetic);
  const double km = 1e-3 * surface.scale_m();
  throw Error(ErrorKind::input,
              text("the spacing is ", km * spacing.at(p.x(), p.y(), p.z()), " km at lon ",
                   at.lon_rad * kDegPerRad, ", lat ", at.lat_rad * kDegPerRad,
                   " deg, where the surface bends with a radius of ",
                   km * least_radius_of_curvature(surface, p),
                   " km: on so flat a body it must not be larger than that. Use a finer spacing "
                   "there or a rounder surface."));
}

}  // namespace delos
