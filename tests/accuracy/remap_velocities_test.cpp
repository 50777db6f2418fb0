// SPDX-License-Identifier: BSD-3-Clause
// Order of convergence of transferred flows: a Rossby-Haurwitz wave (Williamson et al. 1992, case
// 6), which has no divergence, a gradient, which has no vorticity, and both together.
#include "remap/velocities.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "remap/potential.hpp"
#include "remap/stream.hpp"
#include "remap/vectors.hpp"
#include "support/sample_fields.hpp"
#include "triangulation/delaunay.hpp"
#include "triangulation/seeds.hpp"

using namespace delos;

namespace {

constexpr double kRadius_m = 6371220.0;

// Stream function of the wave with four waves around, over the radius: 80 m/s at most or so.
double wave(const Vec3& p) {
  const double x = p.x(), y = p.y();
  const double cos_4 = x * x * x * x - 6.0 * x * x * y * y + y * y * y * y;  // cos^4 lat cos 4 lon
  return 50.0 * (-p.z() + p.z() * cos_4);
}

// Gradient on the unit sphere's tangent planes of 20 times z (x^2 - y^2), which is Y_3^2.
Vec3 gradient(const Vec3& p) {
  const Vec3 g =
      20.0 * Vec3(2.0 * p.x() * p.z(), -2.0 * p.y() * p.z(), p.x() * p.x() - p.y() * p.y());
  return g - p * p.dot(g);
}

struct Amounts {
  double rotating, diverging;
};

// Means along the edges: the wave's exact, the gradient's by Simpson's rule.
Array<double> flow(parallel::Executor& exec, const Grid& grid, const Amounts& amounts) {
  std::vector<double> psi(at(grid.n_vertices()));
  for (std::size_t v = 0; v < psi.size(); ++v) {
    psi[v] = amounts.rotating * kRadius_m * wave(grid.vertex_position[v]);
  }
  Array<double> normal = remap::flow_of(exec, grid, psi);
  for (std::size_t e = 0; e < normal.size(); ++e) {
    const auto [v, w] = grid.vertices_on_edge[e];
    const Vec3 &a = grid.vertex_position[at(v)], &b = grid.vertex_position[at(w)];
    const Vec3 sum = gradient(a) + 4.0 * gradient((a + b).normalized()) + gradient(b);
    const Vec3 across = remap::edge_normal(grid, static_cast<std::int64_t>(e));
    normal[e] += amounts.diverging * sum.dot(across) / 6.0;
  }
  return normal;
}

// Root of the mean of squares weighted with dc dv.
double size_of(const Grid& grid, std::span<const double> normal) {
  double sum = 0.0, weights = 0.0;
  for (std::size_t e = 0; e < normal.size(); ++e) {
    const double weight = grid.cell_distance_m[e] * grid.vertex_distance_m[e];
    sum += weight * normal[e] * normal[e];
    weights += weight;
  }
  return std::sqrt(sum / weights);
}

double error_of(parallel::Executor& exec, const Grid& grid, Array<double> normal,
                const Amounts& amounts) {
  const auto exact = flow(exec, grid, amounts);
  for (std::size_t e = 0; e < normal.size(); ++e) normal[e] -= exact[e];
  return size_of(grid, normal) / size_of(grid, exact);
}

}  // namespace

TEST_CASE("flows converge by their potentials, rotating, diverging or both") {
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  const Ellipsoid sphere = Ellipsoid::sphere(kRadius_m);
  const auto build = [&](const std::vector<Vec3>& points) {
    return build_grid(context, sphere, LatitudeKind::geodetic, delaunay(exec, points));
  };
  // Differences of neighbouring cells are gradients half way between these, which is not where the
  // grid's edges have their middles: hence the second one's order.
  struct Kind {
    Amounts amounts;
    double order, against_vectors;
  };
  const std::array<Kind, 3> kinds{
      {{{1.0, 0.0}, 1.9, 1.2}, {{0.0, 1.0}, 1.6, 0.25}, {{1.0, 1.0}, 1.9, 1.2}}};
  std::array<double, 3> before{};
  for (const std::int64_t n : {12, 24, 48}) {
    const Grid source = build(icosahedral_points(n, sphere));
    const Grid target = build(fibonacci_points(9 * n * n, sphere));
    const remap::Transfer transfer(context, remap::Tiling::cells(exec, source),
                                   remap::Tiling::cells(exec, target));
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const auto old = flow(exec, source, kinds[k].amounts);
      const auto error = [&](remap::VelocityRoute route) {
        return error_of(
            exec, target,
            remap::transfer_velocities(context, transfer, {source, target}, old,
                                       {route, {remap::Order::second, remap::Limiter::none}}),
            kinds[k].amounts);
      };
      const double by_potentials = error(remap::VelocityRoute::helmholtz);
      const double by_vectors = error(remap::VelocityRoute::vectors);
      CAPTURE(n);
      CAPTURE(k);
      CAPTURE(by_potentials);
      CAPTURE(by_vectors);
      CHECK(by_potentials < kinds[k].against_vectors * by_vectors);
      if (n > 12) CHECK(std::log2(before[k] / by_potentials) >= kinds[k].order);
      before[k] = by_potentials;
    }
  }
}
