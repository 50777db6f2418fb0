// SPDX-License-Identifier: BSD-3-Clause
#include "remap/transfer.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/sample_fields.hpp"

using namespace delos;
using remap::Limiter;
using remap::Order;

namespace {

const std::vector<Ellipsoid> kSurfaces{Ellipsoid::sphere(6371220.0), Ellipsoid::wgs84(),
                                       Ellipsoid(Vec3(1.2, 1.0, 0.8) * 6e6, Vec3(10, 20, 30))};
const std::vector<remap::TransferOptions> kSchemes{{Order::first, Limiter::none},
                                                   {Order::second, Limiter::none},
                                                   {Order::second, Limiter::gradient},
                                                   {Order::second, Limiter::assured_sum}};

remap::Transfer transfer_between(const Grid& a, const Grid& b, int threads = 1) {
  parallel::Executor exec(threads);
  Monitor monitor;
  Context context{exec, monitor};
  return {context, remap::Tiling::cells(exec, a), remap::Tiling::cells(exec, b)};
}

/// Nothing but 0 and 1: every step between cells is an overshoot waiting to happen.
std::vector<double> steps(std::int64_t n, std::uint64_t seed) {
  std::vector<double> field = samples::rough_field(n, seed);
  for (double& value : field) value = value < 0.5 ? 0.0 : 1.0;
  return field;
}

}  // namespace

TEST_CASE("transfer of every order keeps mass and, to the last bit, constants") {
  parallel::Executor exec(2);
  for (const Ellipsoid& surface : kSurfaces) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const Grid a = samples::grid_of(surface, samples::shaken(surface, 4, 0.2, seed));
      const Grid b = samples::grid_of(surface, samples::shaken(surface, 3, 0.2, seed + 10));
      const remap::Transfer transfer = transfer_between(a, b);
      const auto field = samples::rough_field(a.n_cells(), seed);
      std::vector<double> result(at(b.n_cells()));
      for (std::size_t scheme = 0; scheme < kSchemes.size(); ++scheme) {
        CAPTURE(surface.radii().transpose());
        CAPTURE(seed);
        CAPTURE(scheme);
        transfer.apply(exec, field, result, kSchemes[scheme]);
        const double kept = samples::mass(result, b.cell_area_m2);
        CHECK(std::abs(kept / samples::mass(field, a.cell_area_m2) - 1.0) < 1e-14);
        transfer.apply(exec, std::vector<double>(field.size(), 0.1), result, kSchemes[scheme]);
        CHECK(std::all_of(result.begin(), result.end(), [](double v) { return v == 0.1; }));
      }
    }
  }
}

TEST_CASE("limited transfer makes no new extremes, unlimited transfer does") {
  parallel::Executor exec(1);
  const Ellipsoid surface = Ellipsoid::wgs84();
  const Grid a = samples::grid_of(surface, samples::shaken(surface, 3, 0.2, 1));
  const Grid b = samples::grid_of(surface, samples::shaken(surface, 4, 0.2, 2));
  const remap::Transfer transfer = transfer_between(a, b);
  std::vector<double> result(at(b.n_cells()));
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto field = steps(a.n_cells(), seed);
    for (std::size_t scheme = 0; scheme < kSchemes.size(); ++scheme) {
      CAPTURE(seed);
      CAPTURE(scheme);
      transfer.apply(exec, field, result, kSchemes[scheme]);
      const auto [low, high] = std::minmax_element(result.begin(), result.end());
      const bool is_free =
          kSchemes[scheme].order == Order::second && kSchemes[scheme].limiter == Limiter::none;
      CHECK((*low < 0.0 && *high > 1.0) == is_free);
      CHECK((*low >= 0.0 && *high <= 1.0) != is_free);
      const double kept = samples::mass(result, b.cell_area_m2);
      CHECK(std::abs(kept / samples::mass(field, a.cell_area_m2) - 1.0) < 1e-14);
    }
  }
}

TEST_CASE("unchanged cells keep their values to the bit, whatever the order and limiter") {
  parallel::Executor exec(1);
  const Ellipsoid sphere;
  Mesh mesh = samples::shaken(sphere, 4, 0.1, 9);
  const Grid a = samples::grid_of(sphere, mesh);
  for (Vertex& v : mesh.vertices) {
    if (v.x < 0.8) continue;
    const Vec3 p = sphere.project(v.position() + 0.2 * v.spacing * Vec3(0, 1, 0.3));
    v = {p.x(), p.y(), p.z(), v.spacing};
  }
  const Grid b = samples::grid_of(sphere, samples::make_delaunay(mesh));
  const remap::Transfer transfer = transfer_between(a, b);
  CHECK(transfer.overlaps().n_unchanged > a.n_cells() / 2);
  const auto field = steps(a.n_cells(), 5);
  std::vector<double> result(field.size());
  for (const auto& scheme : kSchemes) {
    transfer.apply(exec, field, result, scheme);
    for (std::size_t i = 0; i < field.size(); ++i) {
      if (b.cell_position[i].x() < 0.6) CHECK(result[i] == field[i]);
    }
  }
}

TEST_CASE("the matrix of an order does what its transfer does, and its adjoint fits") {
  parallel::Executor exec(2);
  const Ellipsoid surface = Ellipsoid::wgs84();
  const Grid a = samples::grid_of(surface, samples::shaken(surface, 3, 0.1, 1));
  const Grid b = samples::grid_of(surface, samples::shaken(surface, 4, 0.1, 2));
  const remap::Transfer transfer = transfer_between(a, b);
  const auto field = samples::rough_field(a.n_cells(), 1);
  const auto other = samples::rough_field(b.n_cells(), 2);
  for (const Order order : {Order::first, Order::second}) {
    std::vector<double> by_matrix(other.size()), direct(other.size());
    const remap::Weights weights = transfer.weights(exec, order);
    remap::apply(exec, weights, field, by_matrix);
    transfer.apply(exec, field, direct, {order, Limiter::none});
    double worst = 0.0;
    for (std::size_t i = 0; i < direct.size(); ++i) {
      worst = std::max(worst, std::abs(by_matrix[i] - direct[i]));
    }
    CHECK(worst < 1e-13);
    // <other, W field> = <W^T other, field>
    const remap::Weights turned = remap::transpose(exec, weights);
    double left = 0.0, right = 0.0;
    for (std::size_t i = 0; i < direct.size(); ++i) left += other[i] * by_matrix[i];
    for (std::int64_t j = 0; j < turned.n_rows(); ++j) {
      for (auto k = turned.offsets[at(j)]; k < turned.offsets[at(j) + 1]; ++k) {
        right += field[at(j)] * turned.value[at(k)] * other[at(turned.column[at(k)])];
      }
    }
    CHECK(left == doctest::Approx(right).epsilon(1e-13));
  }
}

TEST_CASE("transferred fields and matrices have the same bits for any number of threads") {
  const Ellipsoid surface = Ellipsoid::sphere(6371220.0);
  const Grid a = samples::grid_of(surface, samples::bisected_icosahedron(surface, 5));
  const Grid b = samples::grid_of(surface, samples::shaken(surface, 5, 0.2, 1));
  const auto field = steps(a.n_cells(), 3);
  parallel::Executor alone(1);
  const remap::Transfer one = transfer_between(a, b, 1);
  const remap::Weights matrix = one.weights(alone, Order::second);
  for (const int threads : {2, 5, 8}) {
    CAPTURE(threads);
    parallel::Executor exec(threads);
    const remap::Transfer many = transfer_between(a, b, threads);
    for (const auto& scheme : kSchemes) {
      std::vector<double> expected(at(b.n_cells())), result(at(b.n_cells()));
      one.apply(alone, field, expected, scheme);
      many.apply(exec, field, result, scheme);
      CHECK(result == expected);
    }
    const remap::Weights other = many.weights(exec, Order::second);
    CHECK(other.column == matrix.column);
    CHECK(other.value == matrix.value);
  }
}

TEST_CASE("what is missing stays out: constants, bounds and the mass of the valid areas") {
  parallel::Executor exec(2);
  const Ellipsoid surface = Ellipsoid::sphere(6371220.0);
  const Grid a = samples::grid_of(surface, samples::shaken(surface, 4, 0.2, 1));
  const Grid b = samples::grid_of(surface, samples::shaken(surface, 4, 0.2, 2));
  const remap::Transfer transfer = transfer_between(a, b);
  const double missing = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> field = samples::rough_field(a.n_cells(), 1), valid(field.size());
  std::vector<double> constant(field.size(), 0.1);
  for (std::size_t j = 0; j < field.size(); ++j) {
    valid[j] = a.cell_position[j].x() < 0.3 ? 1.0 : 0.0;
    if (valid[j] == 0.0) field[j] = constant[j] = missing;
  }
  const double least = 0.01, most = 1.01;  // of the field
  std::vector<double> share(at(b.n_cells())), result(share.size());
  transfer.apply(exec, valid, share, {Order::first, Limiter::none});
  double mass = 0.0;
  for (std::size_t j = 0; j < field.size(); ++j) {
    if (valid[j] > 0.0) mass += a.cell_area_m2[j] * field[j];
  }
  for (const remap::TransferOptions& scheme : {kSchemes[0], kSchemes[1], kSchemes[2]}) {
    // Any part is enough: nothing is lost.
    transfer.apply_valid(exec, field, result, scheme, 0.0);
    double kept = 0.0;
    for (std::size_t i = 0; i < result.size(); ++i) {
      CHECK(std::isnan(result[i]) == (share[i] == 0.0));
      if (share[i] > 0.0) kept += b.cell_area_m2[i] * share[i] * result[i];
      if (scheme.order == Order::first || scheme.limiter == Limiter::gradient) {
        CHECK((std::isnan(result[i]) || (result[i] >= least && result[i] <= most)));
      }
    }
    CHECK(std::abs(kept / mass - 1.0) < 1e-13);
    transfer.apply_valid(exec, constant, result, scheme);
    for (std::size_t i = 0; i < result.size(); ++i) {
      CHECK((share[i] < 0.5 ? std::isnan(result[i]) : result[i] == 0.1));
    }
  }
  CHECK_THROWS_AS(transfer.apply_valid(exec, field, result, kSchemes[3]), Error);
}

TEST_CASE("a field without gaps is carried alike whether gaps are looked for or not") {
  parallel::Executor exec(2);
  const Ellipsoid surface = Ellipsoid::sphere(6371220.0);
  const Grid a = samples::grid_of(surface, samples::shaken(surface, 3, 0.2, 1));
  const Grid b = samples::grid_of(surface, samples::shaken(surface, 4, 0.2, 2));
  const remap::Transfer transfer = transfer_between(a, b);
  const std::vector<double> field = steps(a.n_cells(), 3);
  std::vector<double> direct(at(b.n_cells())), looked(direct.size());
  for (const remap::TransferOptions& scheme : {kSchemes[0], kSchemes[1], kSchemes[2]}) {
    transfer.apply(exec, field, direct, scheme);
    transfer.apply_valid(exec, field, looked, scheme);
    CHECK(direct == looked);
  }
}

TEST_CASE("a transfer made for the first order refuses the second until it is added") {
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  const Ellipsoid surface = Ellipsoid::sphere(6371220.0);
  const Grid a = samples::grid_of(surface, samples::shaken(surface, 2, 0.2, 1));
  const Grid b = samples::grid_of(surface, samples::shaken(surface, 2, 0.2, 2));
  const remap::Tiling cells = remap::Tiling::cells(exec, a);
  remap::Transfer transfer(context, cells, remap::Tiling::cells(exec, b), Order::first);
  const auto field = samples::rough_field(a.n_cells(), 1);
  std::vector<double> result(at(b.n_cells())), wanted(result.size());
  transfer.apply(exec, field, result, kSchemes[0]);
  CHECK_THROWS_AS(transfer.apply(exec, field, result, kSchemes[1]), Error);
  CHECK_THROWS_AS(transfer.weights(exec, Order::second), Error);
  transfer.add_second_order(exec, cells);
  transfer.apply(exec, field, result, kSchemes[2]);
  transfer_between(a, b).apply(exec, field, wanted, kSchemes[2]);
  CHECK(result == wanted);
}
