// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <delos/delos.hpp>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace {

/// A host whose velocities swing in the north, so that its component makes a new grid at the first
/// alarm, finer in the north and, in the south, with the cells it had.
constexpr char kFollows[] = R"(
sizing: {sources: [{type: constant, spacing: 900 km}], gradient_limit: 0.3, resolution: 4 deg,
         clamp: {min: 300 km, max: 2000 km}}
refine: {tile_vertices: 500}
remesh:
  interval: P4D
  sources: [{type: eke, quiet: [0.05 m/s, 900 km], energetic: [0.5 m/s, 500 km]}]
)";

class Host {
 public:
  Host() : component_(delos::Config::from_text(kFollows), {.threads = 2}) {
    component_.initialize();
  }

  void run_day(int day, double amplitude) {
    const auto n_cells = static_cast<std::size_t>(component_.grid().n_cells());
    std::vector<double> u(n_cells), v(n_cells);
    const delos::Grid grid = component_.grid();
    const auto places = grid.cell_position();
    for (std::size_t i = 0; i < n_cells; ++i) {
      u[i] = places[3 * i + 2] > 0.6 ? (day % 2 == 0 ? amplitude : -amplitude) : 0.0;
    }
    auto imports = component_.import_state();
    imports.field("surface_eastward_sea_water_velocity").store(u);
    imports.field("surface_northward_sea_water_velocity").store(v);
    component_.run(imports, component_.export_state(), clock_);
    clock_.advance();
  }

  delos::Component& component() { return component_; }

 private:
  delos::Component component_;
  delos::Clock clock_{
      {.start = delos::Time::parse("2001-01-01"), .step = delos::TimeInterval::parse("P1D")}};
};

/// The grids around one remesh.
std::pair<delos::Grid, delos::Grid> before_and_after() {
  Host host;
  const delos::Grid before = host.component().grid();
  for (int day = 0; day < 4; ++day) host.run_day(day, 0.6);
  REQUIRE(host.component().generation() == 2);
  return {before, host.component().grid()};
}

double mass(const delos::Grid& grid, const std::vector<double>& values) {
  const auto area_m2 = grid.cell_area_m2();
  return std::inner_product(values.begin(), values.end(), area_m2.begin(), 0.0);
}

std::vector<double> waves(const delos::Grid& grid) {
  const auto places = grid.cell_position();
  std::vector<double> values(static_cast<std::size_t>(grid.n_cells()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = 2.0 + places[3 * i] * places[3 * i + 1] + places[3 * i + 2];
  }
  return values;
}

/// Normal velocities of the flow with stream function z + xy: outflows telescope.
std::vector<double> free_flow(const delos::Grid& grid) {
  const auto places = grid.vertex_position();
  const auto psi = [&](std::int32_t v) {
    const auto at = 3 * static_cast<std::size_t>(v);
    return grid.scale_m() * (places[at + 2] + places[at] * places[at + 1]);
  };
  const auto ends = grid.vertices_on_edge();
  const auto dv = grid.vertex_distance_m();
  std::vector<double> normal(static_cast<std::size_t>(grid.n_edges()));
  for (std::size_t e = 0; e < normal.size(); ++e) {
    normal[e] = (psi(ends[2 * e]) - psi(ends[2 * e + 1])) / dv[e];
  }
  return normal;
}

/// Net outflow of every cell over its area.
std::vector<double> divergence(const delos::Grid& grid, const std::vector<double>& normal) {
  std::vector<double> outflow(static_cast<std::size_t>(grid.n_cells()));
  const auto cells = grid.cells_on_edge();
  for (std::size_t e = 0; e < normal.size(); ++e) {
    const double flux = normal[e] * grid.vertex_distance_m()[e];
    outflow[static_cast<std::size_t>(cells[2 * e])] += flux;
    outflow[static_cast<std::size_t>(cells[2 * e + 1])] -= flux;
  }
  for (std::size_t i = 0; i < outflow.size(); ++i) outflow[i] /= grid.cell_area_m2()[i];
  return outflow;
}

/// Adds the gradient of zx at the cells; returns the divergence of the whole flow.
std::vector<double> add_gradient(const delos::Grid& grid, std::vector<double>& normal) {
  const auto places = grid.cell_position();
  const auto cells = grid.cells_on_edge();
  const auto chi = [&](std::int32_t c) {
    const auto at = 3 * static_cast<std::size_t>(c);
    return grid.scale_m() * places[at + 2] * places[at];
  };
  for (std::size_t e = 0; e < normal.size(); ++e) {
    normal[e] += (chi(cells[2 * e + 1]) - chi(cells[2 * e])) / grid.cell_distance_m()[e];
  }
  return divergence(grid, normal);
}

/// The largest divergence of a cell over 1 m/s by its spacing.
double largest_divergence(const delos::Grid& grid, const std::vector<double>& normal) {
  const std::vector<double> found = divergence(grid, normal);
  double largest = 0.0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    largest = std::max(largest, std::abs(found[i]) * std::sqrt(grid.cell_area_m2()[i]));
  }
  return largest;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace

TEST_CASE("a host's fields follow its component's remesh: mass, constants, cells that stayed") {
  const auto [before, after] = before_and_after();
  CHECK(before.generation() == 1);
  CHECK(after.generation() == 2);
  const delos::Transfer transfer(before, after);
  CHECK(transfer.from().digest() == before.digest());
  CHECK(transfer.to().digest() == after.digest());
  CHECK(transfer.n_unchanged() > 0);
  CHECK(transfer.n_unchanged() < after.n_cells());
  CHECK(transfer.n_overlaps() >= after.n_cells());

  const auto n_after = static_cast<std::size_t>(after.n_cells());
  const std::vector<double> old = waves(before);
  const auto [low, high] = std::minmax_element(old.begin(), old.end());
  double errors[2] = {};
  for (const auto order : {delos::TransferOrder::first, delos::TransferOrder::second}) {
    for (const auto limiter : {delos::TransferLimiter::none, delos::TransferLimiter::gradient,
                               delos::TransferLimiter::assured_sum}) {
      std::vector<double> moved(n_after);
      transfer.apply(old, moved, {.order = order, .limiter = limiter});
      CHECK(mass(after, moved) == doctest::Approx(mass(before, old)).epsilon(1e-14));
      if (limiter != delos::TransferLimiter::none) {
        CHECK(*std::min_element(moved.begin(), moved.end()) >= *low);
        CHECK(*std::max_element(moved.begin(), moved.end()) <= *high);
      }
      errors[static_cast<int>(order)] = largest_difference(moved, waves(after));
    }
  }
  CHECK(errors[1] < 0.5 * errors[0]);

  const std::vector<double> constant(old.size(), 0.1);
  std::vector<double> same(n_after);
  transfer.apply(constant, same);
  CHECK(std::all_of(same.begin(), same.end(), [](double value) { return value == 0.1; }));
}

TEST_CASE("levels that stand together are carried as each by itself") {
  const auto [before, after] = before_and_after();
  const delos::Transfer transfer(before, after);
  const std::vector<double> upper = waves(before);
  std::vector<double> both;
  for (const double value : upper) both.insert(both.end(), {value, -3.0 * value});
  const auto n_after = static_cast<std::size_t>(after.n_cells());
  std::vector<double> moved(n_after), all(2 * n_after);
  transfer.apply(upper, moved);
  transfer.apply(both, all, {.n_levels = 2});
  for (std::size_t i = 0; i < n_after; ++i) REQUIRE(all[2 * i] == moved[i]);

  const std::vector<double> flow = free_flow(before);
  std::vector<double> flows;
  for (const double value : flow) flows.insert(flows.end(), {0.0, value});
  std::vector<double> one(static_cast<std::size_t>(after.n_edges())), two(2 * one.size());
  transfer.apply_velocity(flow, one);
  transfer.apply_velocity(flows, two, delos::VelocityRoute::vectors, {.n_levels = 2});
  for (std::size_t e = 0; e < one.size(); ++e) REQUIRE(two[2 * e + 1] == one[e]);
}

TEST_CASE("a grid's transfer to itself copies fields and velocities to the bit") {
  const delos::Grid grid = delos::generate(delos::Config::from_text(
      "sizing: {sources: [{type: constant, spacing: 1500 km}]}\nrefine: {tile_vertices: 500}\n"));
  const delos::Transfer transfer(grid, grid);
  CHECK(transfer.n_unchanged() == grid.n_cells());
  const std::vector<double> values = waves(grid), flow = free_flow(grid);
  std::vector<double> moved(values.size()), carried(flow.size());
  transfer.apply(values, moved);
  CHECK(moved == values);
  for (const auto route : {delos::VelocityRoute::vectors, delos::VelocityRoute::stream_function,
                           delos::VelocityRoute::helmholtz}) {
    transfer.apply_velocity(flow, carried, route);
    CHECK(carried == flow);
  }
}

TEST_CASE("velocities arrive, and by the stream function they get no divergence") {
  const auto [before, after] = before_and_after();
  const delos::Transfer transfer(before, after, {.threads = 1});
  const std::vector<double> flow = free_flow(before), wanted = free_flow(after);
  std::vector<double> moved(wanted.size()), again(wanted.size());
  transfer.apply_velocity(flow, moved, delos::VelocityRoute::vectors);
  CHECK(largest_difference(moved, wanted) < 0.15);
  CHECK(largest_divergence(after, moved) > 1e-4);
  transfer.apply_velocity(flow, moved, delos::VelocityRoute::stream_function);
  CHECK(largest_difference(moved, wanted) < 0.1);
  CHECK(largest_divergence(after, moved) < 1e-11);
  const delos::Transfer threaded(before, after, {.threads = 2});
  threaded.apply_velocity(flow, again, delos::VelocityRoute::stream_function);
  CHECK(again == moved);

  // Edges between cells that stayed: found by the middles of edges, which stayed with them.
  std::size_t n_same = 0;
  const auto old_places = before.edge_position(), places = after.edge_position();
  for (std::size_t e = 0; e < wanted.size(); ++e) {
    for (std::size_t f = 0; f < flow.size(); ++f) {
      if (std::equal(&places[3 * e], &places[3 * e] + 3, &old_places[3 * f]) &&
          moved[e] == flow[f]) {
        ++n_same;
      }
    }
  }
  CHECK(n_same > 0);
}

TEST_CASE("velocities by their potentials diverge as the old cells did") {
  const auto [before, after] = before_and_after();
  const delos::Transfer transfer(before, after, {.threads = 1});
  std::vector<double> flow = free_flow(before), moved(free_flow(after).size());
  transfer.apply_velocity(flow, moved, delos::VelocityRoute::helmholtz);
  CHECK(largest_difference(moved, free_flow(after)) < 0.1);
  CHECK(largest_divergence(after, moved) < 1e-11);
  const std::vector<double> old = add_gradient(before, flow);
  std::vector<double> wanted(static_cast<std::size_t>(after.n_cells()));
  transfer.apply(old, wanted);
  transfer.apply_velocity(flow, moved, delos::VelocityRoute::helmholtz);
  CHECK(largest_divergence(after, moved) > 1e-3);
  CHECK(largest_difference(divergence(after, moved), wanted) < 1e-9 / after.scale_m());
}

TEST_CASE("sizes and grids that do not fit a transfer are refused with both generations") {
  const auto grids = before_and_after();
  const auto& before = grids.first;
  const auto& after = grids.second;
  const delos::Transfer transfer(before, after);
  CHECK_NOTHROW(transfer.check(before, after));
  const auto message_of = [](delos::ErrorKind kind, auto&& call) -> std::string {
    try {
      call();
    } catch (const delos::Error& error) {
      CHECK(error.kind() == kind);
      return error.what();
    }
    return "";
  };
  const std::string swapped =
      message_of(delos::ErrorKind::state, [&] { transfer.check(after, before); });
  CAPTURE(swapped);
  CHECK(swapped.find("from generation 1 (") != std::string::npos);
  CHECK(swapped.find("used from generation 2 (") != std::string::npos);

  std::vector<double> old = waves(before), few(3);
  const std::string size = message_of(delos::ErrorKind::input, [&] { transfer.apply(old, few); });
  CAPTURE(size);
  CHECK(size.find("to fill are 3") != std::string::npos);
  CHECK(size.find("generation 2 (" + std::to_string(after.n_cells())) != std::string::npos);
  CHECK(message_of(delos::ErrorKind::input, [&] { transfer.apply(few, old); }).find("to carry") !=
        std::string::npos);
  CHECK(message_of(delos::ErrorKind::input, [&] { transfer.apply_velocity(old, few); }) != "");
  CHECK(message_of(delos::ErrorKind::input, [&] {
          transfer.apply({}, {}, {.n_levels = 0});
        }).find("n_levels = 0") != std::string::npos);
  // Whose product with the cells wraps round.
  CHECK(message_of(delos::ErrorKind::input, [&] {
          transfer.apply({}, {}, {.n_levels = std::int64_t{1} << 62});
        }).find("at most") != std::string::npos);

  const delos::Grid smaller = delos::generate(delos::Config::from_text(
      "surface: {radius: 1000 km}\nsizing: {sources: [{type: constant, spacing: 300 km}]}\n"
      "refine: {tile_vertices: 500}\n"));
  CHECK(message_of(delos::ErrorKind::input, [&] {
          delos::Transfer(before, smaller);
        }).find("different surfaces") != std::string::npos);
}

TEST_CASE("a component tells why it remeshed or did not") {
  Host host;
  CHECK(host.component().remesh_decision().empty());
  for (int day = 0; day < 4; ++day) host.run_day(day, 0.6);
  CHECK(host.component().generation() == 2);
  CHECK(host.component().remesh_decision().find("remesh") != std::string::npos);
  const std::string first = host.component().remesh_decision();
  CHECK(host.component().remesh_failure().empty());
  for (int day = 4; day < 8; ++day) host.run_day(day, 0.6);
  CHECK(host.component().generation() == 2);
  CHECK(host.component().remesh_decision() != first);
  CHECK(host.component().remesh_failure().empty());
}
