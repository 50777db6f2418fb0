// SPDX-License-Identifier: BSD-3-Clause
// Velocities between grids with a border.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "remap/coasts.hpp"
#include "remap/stream.hpp"
#include "remap/vectors.hpp"
#include "remap/velocities.hpp"
#include "support/culled_grids.hpp"
#include "support/sample_fields.hpp"

using namespace delos;
using remap::VelocityRoute;

namespace {

struct Basin {
  parallel::Executor exec;
  Monitor monitor;
  Context context{exec, monitor};
  explicit Basin(int threads = 2) : exec(threads) {}
};

constexpr double kShore = 0.62;  // of |z|
constexpr double kIsland = 0.25;
const Vec3 kIslandAt(0.8, 0.6, 0.0);

bool is_sea(const Vec3& p) { return std::abs(p.z()) < kShore && (p - kIslandAt).norm() > kIsland; }

Grid sea_of(const Grid& grid) { return samples::culled(grid, is_sea).grid; }

Grid shaken_grid(int levels, std::uint64_t seed) {
  const Ellipsoid sphere = Ellipsoid::sphere(6371220.0);
  return samples::grid_of(sphere, samples::shaken(sphere, levels, 0.1, seed));
}

/// Over the radius: a jet between the shores, around the island, which ends before both: 1 on one
/// shore, -1 on the other, 0.3 on the island.
double stream(const Vec3& p) {
  const double t = std::clamp(p.z() / 0.5, -1.0, 1.0);
  const double jet = t * (15.0 + t * t * (3.0 * t * t - 10.0)) / 8.0;
  const double d = std::clamp(((p - kIslandAt).norm() / kIsland - 1.4) / 1.0, 0.0, 1.0);
  const double far = d * d * d * (10.0 + d * (6.0 * d - 15.0));
  return far * jet + (1.0 - far) * 0.3;
}

Array<double> jet(parallel::Executor& exec, const Grid& grid) {
  std::vector<double> psi(at(grid.n_vertices()));
  for (std::size_t v = 0; v < psi.size(); ++v) {
    psi[v] = grid.surface.scale_m() * stream(grid.vertex_position[v]);
  }
  Array<double> normal = remap::flow_of(exec, grid, psi);
  for (std::size_t e = 0; e < normal.size(); ++e) {
    if (grid.cells_on_edge[e][1] == kNone) normal[e] = 0.0;  // of rounding
  }
  return normal;
}

remap::Transfer transfer_of(Context& context, const Grid& from, const Grid& to) {
  return {context, remap::Tiling::cells(context.exec, from),
          remap::Tiling::cells(context.exec, to)};
}

/// Root of the mean of squares of the error against that of the flow, of the edges that count.
template <class Counts>
double error_of(const Grid& grid, std::span<const double> found, std::span<const double> exact,
                Counts&& counts) {
  double error = 0.0, size = 0.0;
  for (std::size_t e = 0; e < found.size(); ++e) {
    if (!counts(grid.edge_position[e])) continue;
    error += (found[e] - exact[e]) * (found[e] - exact[e]);
    size += exact[e] * exact[e];
  }
  return std::sqrt(error / size);
}

bool is_far_from_coasts(const Vec3& p) {
  return std::abs(p.z()) < kShore - 0.12 && (p - kIslandAt).norm() > kIsland + 0.12;
}

/// Largest divergence over velocity by spacing.
double divergence_of(parallel::Executor& exec, const Grid& grid, std::span<const double> normal) {
  const Array<double> found = remap::divergence(exec, grid, normal);
  double worst = 0.0, fastest = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(std::isfinite(found[i]));
    worst = std::max(worst, std::abs(found[i]) * std::sqrt(grid.cell_area_m2[i]));
  }
  for (const double value : normal) fastest = std::max(fastest, std::abs(value));
  return worst / fastest;
}

/// Of a grid's sea to another's.
double sea_error(int levels, VelocityRoute route) {
  Basin basin;
  const Grid a = sea_of(shaken_grid(levels, 1)), b = sea_of(shaken_grid(levels, 2));
  const auto moved = remap::transfer_velocities(basin.context, transfer_of(basin.context, a, b),
                                                {a, b}, jet(basin.exec, a), {route, {}});
  for (std::size_t e = 0; e < moved.size(); ++e) {
    if (b.cells_on_edge[e][1] == kNone) CHECK(moved[e] == 0.0);
  }
  return error_of(b, moved, jet(basin.exec, b), is_far_from_coasts);
}

}  // namespace

TEST_CASE("velocities of a sea converge by vectors away from its coasts, none flow through them") {
  const double coarse = sea_error(4, VelocityRoute::vectors);
  const double fine = sea_error(5, VelocityRoute::vectors);
  CAPTURE(coarse);
  CAPTURE(fine);
  CHECK(fine < 0.03);
  CHECK(std::log2(coarse / fine) > 1.6);
}

TEST_CASE("by its stream function a sea's flow converges and gets no divergence") {
  const double coarse = sea_error(4, VelocityRoute::stream_function);
  const double fine = sea_error(5, VelocityRoute::stream_function);
  CAPTURE(coarse);
  CAPTURE(fine);
  CHECK(fine < 0.02);
  CHECK(std::log2(coarse / fine) > 1.6);
  Basin basin;
  const Grid whole = shaken_grid(4, 2), a = sea_of(shaken_grid(4, 1)), b = sea_of(whole);
  const auto old = jet(basin.exec, a);
  CHECK(divergence_of(basin.exec, a, old) < 1e-12);
  for (const Grid* const to : {&b, &whole}) {
    const auto moved =
        remap::transfer_velocities(basin.context, transfer_of(basin.context, a, *to), {a, *to}, old,
                                   {VelocityRoute::stream_function, {}});
    CHECK(divergence_of(basin.exec, *to, moved) < 1e-11);
  }
}

TEST_CASE("what flows between a sea's coasts is kept") {
  Basin basin;
  const Grid a = sea_of(shaken_grid(4, 1)), b = sea_of(shaken_grid(4, 2));
  const auto moved =
      remap::transfer_velocities(basin.context, transfer_of(basin.context, a, b), {a, b},
                                 jet(basin.exec, a), {VelocityRoute::stream_function, {}});
  const auto before = remap::stream_function(basin.context, a, jet(basin.exec, a));
  const auto after = remap::stream_function(basin.context, b, moved);
  CHECK(before.remainder < 1e-12);
  CHECK(after.remainder < 1e-12);
  const auto of_coasts = [](const Grid& grid, const remap::StreamFunction& flow) {
    const remap::StreamNodes nodes = remap::stream_nodes(grid);
    std::vector<double> found;
    for (std::int64_t node = nodes.n_single; node < nodes.size(); ++node) {
      found.push_back(flow.psi[at(nodes.row(node)[0])]);
      for (const Index v : nodes.row(node)) CHECK(flow.psi[at(v)] == found.back());
    }
    std::sort(found.begin(), found.end());
    for (double& value : found) value = (value - found[0]) / grid.surface.scale_m();
    return found;
  };
  const auto old = of_coasts(a, before), now = of_coasts(b, after);
  REQUIRE(old.size() == 3);
  REQUIRE(now.size() == 3);
  // Between the shores 2, from one of them to the island 1.3.
  CHECK(std::abs(old[1] - 1.3) < 1e-12);
  CHECK(std::abs(old[2] - 2.0) < 1e-12);
  CHECK(std::abs(now[1] - old[1]) < 1e-12);
  CHECK(std::abs(now[2] - old[2]) < 1e-12);
}

TEST_CASE("beside a new coast the flow gives way, elsewhere shared edges keep it to the bit") {
  Basin basin;
  const Grid whole = shaken_grid(4, 1), a = sea_of(whole);
  const Vec3 rock(-1.0, 0.0, 0.0);
  const Grid b = samples::culled(whole, [&](const Vec3& p) {
                   return is_sea(p) && (p - rock).norm() > 0.2;
                 }).grid;
  const auto old = jet(basin.exec, a), exact = jet(basin.exec, b);
  const auto moved = remap::transfer_velocities(basin.context, transfer_of(basin.context, a, b),
                                                {a, b}, old, {VelocityRoute::stream_function, {}});
  CHECK(divergence_of(basin.exec, b, moved) < 1e-11);
  std::size_t n_other = 0;
  for (std::size_t e = 0; e < moved.size(); ++e) {
    if (b.cells_on_edge[e][1] == kNone) {
      CHECK(moved[e] == 0.0);
    } else if ((b.edge_position[e] - rock).norm() > 0.35) {
      CHECK(moved[e] == exact[e]);
    } else {
      n_other += moved[e] == exact[e] ? 0 : 1;
    }
  }
  CHECK(n_other > 10);
}

TEST_CASE("what flows through a border is no part of a stream function") {
  Basin basin;
  const Grid a = sea_of(shaken_grid(4, 1));
  auto normal = jet(basin.exec, a);
  const auto closed = remap::stream_function(basin.context, a, normal);
  for (std::size_t e = 0; e < normal.size(); ++e) {
    if (a.cells_on_edge[e][1] == kNone) normal[e] = 3.0;
  }
  CHECK(remap::stream_function(basin.context, a, normal).psi == closed.psi);
  const auto transfer = transfer_of(basin.context, a, a);
  CHECK_THROWS_AS(remap::transfer_velocities(basin.context, transfer, {a, a}, normal,
                                             {VelocityRoute::helmholtz, {}}),
                  Error);
}

TEST_CASE("by vectors edges between bare cells get NaN, those beside one the other cell's") {
  Basin basin;
  const Grid whole = shaken_grid(4, 2), a = sea_of(shaken_grid(4, 1));
  const auto transfer = transfer_of(basin.context, a, whole);
  CHECK(transfer.overlaps().n_unmapped > 0);
  const auto moved =
      remap::transfer_velocities(basin.context, transfer, {a, whole}, jet(basin.exec, a), {});
  const auto is_bare = [&](Index cell) {
    return transfer.overlaps().offsets[at(cell)] == transfer.overlaps().offsets[at(cell) + 1];
  };
  for (std::size_t e = 0; e < moved.size(); ++e) {
    const auto [c, d] = whole.cells_on_edge[e];
    CHECK(std::isnan(moved[e]) == (is_bare(c) && is_bare(d)));
  }
}

TEST_CASE("two seas of one grid share their velocities to the bit") {
  Basin basin;
  const Grid whole = shaken_grid(4, 1);
  const Grid a = sea_of(whole);
  const domain::Culled smaller =
      samples::culled(whole, [](const Vec3& p) { return is_sea(p) && p.y() < 0.9; });
  const Grid& b = smaller.grid;
  const auto transfer = transfer_of(basin.context, a, b);
  const auto old = jet(basin.exec, a), exact = jet(basin.exec, b);
  const auto moved = remap::transfer_velocities(basin.context, transfer, {a, b}, old, {});
  for (std::size_t e = 0; e < moved.size(); ++e) {
    CHECK(moved[e] == (b.cells_on_edge[e][1] == kNone ? 0.0 : exact[e]));
  }
}

TEST_CASE("velocities between seas have the same bits for any number of threads") {
  Basin one(1), five(5);
  const Grid a = sea_of(shaken_grid(4, 1)), b = sea_of(shaken_grid(4, 2));
  const auto old = jet(one.exec, a);
  const auto moved = [&](Basin& basin, VelocityRoute route) {
    return remap::transfer_velocities(basin.context, transfer_of(basin.context, a, b), {a, b}, old,
                                      {route, {}});
  };
  for (const VelocityRoute route : {VelocityRoute::vectors, VelocityRoute::stream_function}) {
    CHECK(moved(one, route) == moved(five, route));
  }
}
