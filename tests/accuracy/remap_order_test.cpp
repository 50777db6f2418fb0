// SPDX-License-Identifier: BSD-3-Clause
// Order of convergence of the transfer, for the smooth fields that the remapping literature uses
// (Lauritzen & Nair 2008, doi:10.1175/2007MWR2181.1; Ullrich et al. 2009,
// doi:10.1175/2008MWR2771.1).
#include <doctest/doctest.h>

#include <cmath>

#include "remap/transfer.hpp"
#include "support/sample_fields.hpp"
#include "triangulation/delaunay.hpp"
#include "triangulation/seeds.hpp"

using namespace delos;

namespace {

double harmonic_2_2(const Vec3& p) { return 2.0 + (p.x() * p.x() - p.y() * p.y()); }

double harmonic_32_16(const Vec3& p) {
  const double lon = std::atan2(p.y(), p.x()), lat = std::asin(p.z());
  return 2.0 + std::pow(std::sin(2.0 * lat), 16) * std::cos(16.0 * lon);
}

// Two vortices wound up around opposite points (Nair & Machenhauer 2002).
double vortex(const Vec3& p) {
  const Vec3 pole(std::cos(0.6), 0.0, std::sin(0.6)), east(0.0, 1.0, 0.0);
  const Vec3 north = pole.cross(east);
  const double angle = std::atan2(p.dot(north), p.dot(east));
  const double z = p.dot(pole), rho = 3.0 * std::sqrt(std::max(0.0, 1.0 - z * z));
  const double speed = 1.5 * std::sqrt(3.0) * std::tanh(rho) / std::pow(std::cosh(rho), 2);
  const double turn = rho > 0.0 ? speed / rho : 1.5 * std::sqrt(3.0);
  return 1.0 - std::tanh(rho / 5.0 * std::sin(angle - 6.0 * turn));
}

using Field = double (*)(const Vec3&);

// Mean over every cell: a fan of triangles, each by the middles of its sides.
std::vector<double> means(const Grid& grid, Field field) {
  std::vector<double> result(at(grid.n_cells()));
  const auto value = [&](const Vec3& p, const Vec3& q) { return field((p + q).normalized()); };
  for (std::int64_t i = 0; i < grid.n_cells(); ++i) {
    const auto corners = grid.vertices_on_cell.row(i);
    const Vec3& a = grid.cell_position[at(i)];
    double sum = 0.0, area = 0.0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Vec3& b = grid.vertex_position[at(corners[k])];
      const Vec3& c = grid.vertex_position[at(corners[(k + 1) % corners.size()])];
      const double part = grid.surface.triangle_area(a, b, c);
      sum += part * (value(a, b) + value(b, c) + value(c, a)) / 3.0;
      area += part;
    }
    result[at(i)] = sum / area;
  }
  return result;
}

double error_l2(const Grid& grid, const std::vector<double>& a, const std::vector<double>& b) {
  double error = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    error += grid.cell_area_m2[i] * (a[i] - b[i]) * (a[i] - b[i]);
    size += grid.cell_area_m2[i] * b[i] * b[i];
  }
  return std::sqrt(error / size);
}

struct Pair {
  Grid source, target;
};

Pair grids(Context& context, const Ellipsoid& surface, std::int64_t n) {
  const auto build = [&](const std::vector<Vec3>& points) {
    return build_grid(context, surface, LatitudeKind::geodetic, delaunay(context.exec, points));
  };
  return {build(icosahedral_points(n, surface)), build(fibonacci_points(9 * n * n, surface))};
}

struct Case {
  const char* name;
  Field field;
};
constexpr std::array<Case, 3> kCases{
    {{"Y_2^2", harmonic_2_2}, {"Y_32^16", harmonic_32_16}, {"vortex", vortex}}};

}  // namespace

TEST_CASE("transfer converges with the order that it has, over three levels") {
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  const Ellipsoid sphere;
  struct Scheme {
    const char* name;
    remap::TransferOptions options;
    double order;
  };
  using remap::Limiter;
  using remap::Order;
  const std::array<Scheme, 4> schemes{
      {{"first", {Order::first, Limiter::none}, 0.8},
       {"second", {Order::second, Limiter::none}, 1.9},
       {"gradient", {Order::second, Limiter::gradient}, 1.9},
       {"assured sum", {Order::second, Limiter::assured_sum}, 1.9}}};
  std::array<std::array<double, 4>, 3> before{};
  for (const std::int64_t n : {32, 64, 128}) {
    const Pair pair = grids(context, sphere, n);
    const remap::Transfer transfer(context, remap::Tiling::cells(exec, pair.source),
                                   remap::Tiling::cells(exec, pair.target));
    for (std::size_t c = 0; c < kCases.size(); ++c) {
      const auto source = means(pair.source, kCases[c].field);
      const auto exact = means(pair.target, kCases[c].field);
      std::vector<double> result(exact.size());
      for (std::size_t s = 0; s < schemes.size(); ++s) {
        transfer.apply(exec, source, result, schemes[s].options);
        const double error = error_l2(pair.target, result, exact);
        CAPTURE(n);
        CAPTURE(std::string(kCases[c].name));
        CAPTURE(std::string(schemes[s].name));
        CAPTURE(error);
        if (n > 32) CHECK(std::log2(before[c][s] / error) >= schemes[s].order);
        before[c][s] = error;
      }
    }
  }
}
