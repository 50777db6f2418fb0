// SPDX-License-Identifier: BSD-3-Clause
#include "remap/velocities.hpp"

#include <doctest/doctest.h>

#include <functional>
#include <limits>

#include "remap/potential.hpp"
#include "remap/stream.hpp"
#include "remap/vectors.hpp"
#include "support/sample_fields.hpp"

using namespace delos;

namespace {

struct Rig {
  explicit Rig(int threads = 2) : exec(threads) {}
  parallel::Executor exec;
  Monitor monitor;
  Context context{exec, monitor};
};

/// Flow of a stream function and, times `diverging`, of a velocity potential, both given in space.
Array<double> mixed_flow(parallel::Executor& exec, const Grid& grid, double diverging) {
  const double scale_m = grid.surface.scale_m();
  std::vector<double> psi(at(grid.n_vertices())), chi(at(grid.n_cells()));
  for (std::size_t v = 0; v < psi.size(); ++v) {
    const Vec3& p = grid.vertex_position[v];
    psi[v] = scale_m * (p.z() * p.z() + 0.3 * p.x() * p.y() + 0.2 * p.x());
  }
  for (std::size_t c = 0; c < chi.size(); ++c) {
    const Vec3& p = grid.cell_position[c];
    chi[c] = scale_m * diverging * (p.z() * p.x() + 0.4 * p.y());
  }
  Array<double> normal = remap::flow_of(exec, grid, psi);
  const Array<double> more = remap::gradient_of(exec, grid, chi);
  for (std::size_t e = 0; e < normal.size(); ++e) normal[e] += more[e];
  return normal;
}

/// The points of a cap around each pole moved a little: cells between stay as they are.
Mesh with_new_caps(const Ellipsoid& surface, Mesh mesh) {
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vec3 p = mesh.vertices[v].position();
    if (std::abs(p.z()) < 0.7) continue;
    const Vec3 q =
        surface.project(p + 0.01 * Vec3(uniform01(7, 2 * v), uniform01(7, 2 * v + 1), 0));
    mesh.vertices[v] = {q.x(), q.y(), q.z(), mesh.vertices[v].spacing};
  }
  return samples::make_delaunay(std::move(mesh));
}

remap::Transfer transfer_of(Context& context, const Grid& from, const Grid& to) {
  return {context, remap::Tiling::cells(context.exec, from),
          remap::Tiling::cells(context.exec, to)};
}

constexpr remap::VelocityOptions kPotentials{remap::VelocityRoute::helmholtz, {}};

/// Largest difference of the divergence of a moved flow to what the field's transfer wants, over
/// velocity by spacing.
double divergence_error(Rig& rig, const remap::Transfer& transfer, const remap::GridPair& grids,
                        std::span<const double> old, std::span<const double> moved) {
  Array<double> wanted(at(grids.target.n_cells()));
  transfer.apply(rig.exec, remap::divergence(rig.exec, grids.source, old), wanted);
  const Array<double> found = remap::divergence(rig.exec, grids.target, moved);
  double worst = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    worst =
        std::max(worst, std::abs(found[i] - wanted[i]) * std::sqrt(grids.target.cell_area_m2[i]));
  }
  double fastest = 0.0;
  for (const double value : old) fastest = std::max(fastest, std::abs(value));
  return worst / fastest;
}

std::string message_of(ErrorKind kind, const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    CHECK(error.kind() == kind);
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("by its potentials a flow gets the divergence that the transfer of the old one's gives") {
  for (const Ellipsoid& surface : {Ellipsoid::sphere(6371220.0), Ellipsoid::wgs84(),
                                   Ellipsoid(Vec3(1.0, 0.95, 0.9), Vec3::Zero())}) {
    Rig rig;
    const Grid a = samples::grid_of(surface, samples::shaken(surface, 4, 0.1, 1));
    const Grid b = samples::grid_of(surface, samples::shaken(surface, 4, 0.1, 2));
    const remap::Transfer transfer = transfer_of(rig.context, a, b);
    for (const double diverging : {0.0, 0.5}) {
      const auto old = mixed_flow(rig.exec, a, diverging);
      const auto moved =
          remap::transfer_velocities(rig.context, transfer, {a, b}, old, kPotentials);
      CHECK(divergence_error(rig, transfer, {a, b}, old, moved) < 1e-11);
    }
  }
}

TEST_CASE(
    "cells that stay keep their velocities to the bit while those beside them diverge right") {
  const Ellipsoid sphere = Ellipsoid::sphere(6371220.0);
  Rig rig;
  const Mesh mesh = samples::shaken(sphere, 4, 0.1, 1);
  const Grid a = samples::grid_of(sphere, mesh);
  const Grid b = samples::grid_of(sphere, with_new_caps(sphere, mesh));
  const remap::Transfer transfer = transfer_of(rig.context, a, b);
  const std::int64_t n_unchanged = transfer.overlaps().n_unchanged;
  CHECK(n_unchanged > a.n_cells() / 2);
  CHECK(n_unchanged < a.n_cells() - 500);
  const auto old = mixed_flow(rig.exec, a, 0.5), exact = mixed_flow(rig.exec, b, 0.5);
  const auto moved = remap::transfer_velocities(rig.context, transfer, {a, b}, old, kPotentials);
  CHECK(divergence_error(rig, transfer, {a, b}, old, moved) < 1e-11);
  std::int64_t n_same = 0;
  double error = 0.0, size = 0.0;
  for (std::size_t e = 0; e < moved.size(); ++e) {
    n_same += moved[e] == exact[e] ? 1 : 0;
    error += (moved[e] - exact[e]) * (moved[e] - exact[e]);
    size += exact[e] * exact[e];
  }
  CHECK(n_same > 2 * n_unchanged);  // of an unchanged cell's six edges each other has half
  CHECK(error < 0.02 * 0.02 * size);
  CHECK(remap::transfer_velocities(rig.context, transfer_of(rig.context, a, a), {a, a}, old,
                                   kPotentials) == old);
}

TEST_CASE("flows by their potentials have the same bits for any threads, level by level") {
  const Ellipsoid sphere;
  Rig one(1), five(5);
  const Grid a = samples::grid_of(sphere, samples::shaken(sphere, 4, 0.1, 1));
  const Grid b = samples::grid_of(sphere, samples::shaken(sphere, 4, 0.1, 2));
  const remap::Transfer transfer = transfer_of(one.context, a, b);
  const auto first = mixed_flow(one.exec, a, 0.5), second = mixed_flow(one.exec, a, 0.0);
  const auto move = [&](Rig& rig, std::span<const double> flow, std::int64_t n_levels) {
    remap::VelocityOptions options = kPotentials;
    options.transfer.n_levels = n_levels;
    return remap::transfer_velocities(rig.context, transfer, {a, b}, flow, options);
  };
  const auto moved = move(one, first, 1), other = move(one, second, 1);
  CHECK(move(five, first, 1) == moved);
  std::vector<double> both;
  for (std::size_t e = 0; e < first.size(); ++e) both.insert(both.end(), {first[e], second[e]});
  const auto levels = move(five, both, 2);
  for (std::size_t e = 0; e < moved.size(); ++e) {
    CHECK(levels[2 * e] == moved[e]);
    CHECK(levels[2 * e + 1] == other[e]);
  }
}

TEST_CASE("a gradient's velocity potential is found, and kept to the bit where cells stay") {
  const Ellipsoid surface = Ellipsoid::wgs84();
  Rig rig;
  const Grid grid = samples::grid_of(surface, samples::shaken(surface, 4, 0.1, 1));
  std::vector<double> chi(at(grid.n_cells()));
  for (std::size_t c = 0; c < chi.size(); ++c) {
    const Vec3& p = grid.cell_position[c];
    chi[c] = p.z() * p.x() + 0.4 * p.y();
  }
  const auto found = remap::velocity_potential(grid, remap::gradient_of(rig.exec, grid, chi));
  for (std::size_t c = 0; c < chi.size(); ++c) {
    CHECK(found[c] == doctest::Approx(chi[c] - chi[0]).epsilon(1e-12));
  }
  CHECK(remap::transfer_potential(rig.exec, grid, grid, found) == found);
}

TEST_CASE("flows that no potential can have are refused with what is wrong") {
  const Ellipsoid sphere;
  Rig rig;
  const Grid grid = samples::grid_of(sphere, samples::shaken(sphere, 3, 0.1, 1));
  auto normal = mixed_flow(rig.exec, grid, 0.5);
  std::vector<double> divergence(at(grid.n_cells()), 0.01);
  std::vector<char> all(at(grid.n_edges()), 1), none(at(grid.n_edges()), 0);
  const auto impose = [&](std::span<const double> wanted, std::span<const char> is_free) {
    remap::impose_divergence(rig.context, grid, {wanted, is_free}, normal);
  };
  const auto before = normal;
  CHECK(message_of(ErrorKind::input, [&] {
          impose(divergence, all);
        }).find("in a part of 642 cells") != std::string::npos);
  CHECK(message_of(ErrorKind::input, [&] {
          impose({divergence.data(), 3}, all);
        }).find("a divergence of 3 values") != std::string::npos);
  impose(divergence, none);
  CHECK(normal == before);
  CHECK(message_of(ErrorKind::input, [&] {
          remap::transfer_potential(rig.exec, grid, grid, {divergence.data(), 3});
        }).find("3 values was given for 642 cells") != std::string::npos);
  normal[5] = std::numeric_limits<double>::quiet_NaN();
  CHECK(message_of(ErrorKind::input, [&] {
          remap::stream_function(rig.context, grid, normal);
        }).find("not finite") != std::string::npos);
}
