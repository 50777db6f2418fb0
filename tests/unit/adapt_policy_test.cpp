// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/policy.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"
#include "time/iso8601.hpp"

using namespace delos;

namespace {

Time day(int n) { return parse_time(Calendar::noleap, "2001-01-01") + TimeInterval::of_days(n); }

PolicyInput input(int day_number, double share) {
  return {day(day_number), true, true, {0.75 * share, 0.25 * share}, 40000.0};
}

Grid sample_grid() {
  const Ellipsoid sphere = Ellipsoid::sphere(6371220.0);
  Grid grid = samples::grid_of(sphere, samples::bisected_icosahedron(sphere, 4));
  for (double& spacing_m : grid.cell_spacing_m) spacing_m = 100.0e3;
  return grid;
}

/// Twice the spacing north of the equator, half of it south of 45 degrees south.
std::vector<double> sample_wanted(const Grid& grid) {
  std::vector<double> out;
  for (const LonLat& place : grid.cell_lon_lat) {
    out.push_back(place.lat_rad > 0.0 ? 200.0e3 : place.lat_rad < -0.25 * kPi ? 50.0e3 : 110.0e3);
  }
  return out;
}

}  // namespace

TEST_CASE("mismatch is the share of the area that is off by more than tau") {
  const Grid grid = sample_grid();
  const std::vector<double> wanted = sample_wanted(grid);
  parallel::Executor exec(1);
  const Mismatch found = mismatch(exec, grid, wanted, 1.2);
  CHECK(found.too_fine == doctest::Approx(0.5).epsilon(0.05));
  CHECK(found.too_coarse == doctest::Approx(0.5 * (1.0 - std::sqrt(0.5))).epsilon(0.05));
  CHECK(found.total() == found.too_fine + found.too_coarse);
  CHECK(mismatch(exec, grid, wanted, 1.05).total() == doctest::Approx(1.0));
  // Bounds belong to what fits.
  CHECK(mismatch(exec, grid, wanted, 2.0).total() == 0.0);
  CHECK(mismatch(exec, grid, grid.cell_spacing_m, 1.01).total() == 0.0);
}

TEST_CASE("fixed cells count neither as area nor as mismatch") {
  const Grid grid = sample_grid();
  const std::vector<double> wanted = sample_wanted(grid);
  std::vector<char> north(wanted.size()), all(wanted.size(), 1);
  for (std::size_t i = 0; i < north.size(); ++i) north[i] = wanted[i] == 200.0e3 ? 1 : 0;
  parallel::Executor exec(1);
  const Mismatch found = mismatch(exec, grid, wanted, 1.2, north);
  CHECK(found.too_fine == 0.0);
  CHECK(found.too_coarse == doctest::Approx(1.0 - std::sqrt(0.5)).epsilon(0.1));
  CHECK(mismatch(exec, grid, wanted, 1.2, all).total() == 0.0);
}

TEST_CASE("mismatch has the same bits for any number of threads and refuses what does not fit") {
  const Grid grid = sample_grid();
  const std::vector<double> wanted = sample_wanted(grid), few(3);
  parallel::Executor one(1);
  const Mismatch expected = mismatch(one, grid, wanted, 1.2);
  for (const int threads : {2, 5, 8}) {
    parallel::Executor exec(threads);
    const Mismatch found = mismatch(exec, grid, wanted, 1.2);
    CHECK(found.too_fine == expected.too_fine);
    CHECK(found.too_coarse == expected.too_coarse);
  }
  testing::expect_error(ErrorKind::input, {"3 values", "2562 cells"},
                        [&] { mismatch(one, grid, few, 1.2); });
  testing::expect_error(ErrorKind::config, {"tau", "> 1"},
                        [&] { mismatch(one, grid, wanted, 1.0); });
}

TEST_CASE("the wanted spacing is looked up at the cells in metres") {
  const Grid grid = sample_grid();
  const SpacingField field = SpacingField::constant(grid.surface, 123.0e3);
  parallel::Executor exec(2);
  const Array<double> wanted = wanted_at_cells(exec, grid, field);
  REQUIRE(wanted.size() == at(grid.n_cells()));
  for (const double h : wanted) CHECK(h == doctest::Approx(123.0e3).epsilon(1e-14));
}

TEST_CASE("a mismatch at the threshold decides for a remesh and says why") {
  PolicyState state;
  const Decision decision = decide({}, input(10, 0.1), state);
  CHECK(decision.remesh);
  CHECK(decision.reasons == std::vector<Reason>{Reason::mismatch});
  CHECK(
      decision.text ==
      "remesh at 2001-01-11T00:00:00: 10 % of the area is off by more than a factor 1.2 (7.5 % too "
      "coarse, 2.5 % too fine), 40000 cells are expected: above the threshold of 10 %");
  CHECK(decision.expected_cells == 40000.0);
}

TEST_CASE("every reason against a remesh is told") {
  PolicyOptions options;
  options.minimum_interval = TimeInterval::of_days(30);
  PolicyState state;
  note_remesh(day(0), state);
  PolicyInput none = input(10, 0.5);
  none.alarm_rings = false;
  none.has_statistics = false;
  const Decision decision = decide(options, none, state);
  CHECK(!decision.remesh);
  CHECK(decision.reasons ==
        std::vector<Reason>{Reason::no_alarm, Reason::no_statistics, Reason::too_soon});
  CHECK(
      decision.text ==
      "no remesh at 2001-01-11T00:00:00: the interval is not over; the window of the statistics is "
      "not filled; the last remesh was at 2001-01-01T00:00:00, less than P0Y0M30DT0H0M0S ago");
  CHECK(decision.mismatch.total() == 0.0);
  CHECK(decide(options, input(40, 0.05), state).reasons ==
        std::vector<Reason>{Reason::below_threshold});
  for (const Reason reason : {Reason::mismatch, Reason::no_alarm, Reason::not_rearmed}) {
    CHECK(std::string(to_string(reason)).size() > 5);
  }
}

TEST_CASE("after a remesh the mismatch must have been low once before it counts again") {
  PolicyOptions options;
  options.threshold = 0.2;
  options.hysteresis = 0.5;
  PolicyState state;
  CHECK(decide(options, input(0, 0.3), state).remesh);
  note_remesh(day(0), state);
  CHECK(decide(options, input(1, 0.3), state).reasons == std::vector<Reason>{Reason::not_rearmed});
  CHECK(!decide(options, input(2, 0.15), state).remesh);  // low, but not low enough
  CHECK(!decide(options, input(3, 0.25), state).remesh);
  CHECK(!decide(options, input(4, 0.09), state).remesh);  // armed again
  CHECK(!decide(options, input(5, 0.15), state).remesh);
  CHECK(decide(options, input(6, 0.2), state).remesh);
}

TEST_CASE("a remesh that was decided but not done is decided again") {
  PolicyState state;
  CHECK(decide({}, input(0, 0.3), state).remesh);
  CHECK(decide({}, input(1, 0.3), state).remesh);
}

TEST_CASE("a month is the shortest time between remeshes where it is asked for") {
  PolicyOptions options;
  options.minimum_interval = TimeInterval::of_months(1);
  PolicyState state;
  note_remesh(day(0), state);
  CHECK(!decide(options, input(1, 0.0), state).remesh);  // arms
  CHECK(!decide(options, input(30, 0.5), state).remesh);
  CHECK(decide(options, input(31, 0.5), state).remesh);
}

TEST_CASE("options out of range are refused by name") {
  const auto refused = [](auto&& change, const std::string& part) {
    PolicyOptions options;
    change(options);
    testing::expect_error(ErrorKind::config, {part}, [&] { check(options); });
  };
  refused([](PolicyOptions& o) { o.tau = 1.0; }, "tau");
  refused([](PolicyOptions& o) { o.threshold = 1.5; }, "threshold");
  refused([](PolicyOptions& o) { o.hysteresis = -0.1; }, "hysteresis");
  refused([](PolicyOptions& o) { o.minimum_interval = TimeInterval(); }, "minimum interval");
}

TEST_CASE("the budget allows for what grids have more or less than expected") {
  CHECK(corrected_budget(100000, 101000, 100000.0) == 99010);
  CHECK(corrected_budget(100000, 98000, 100000.0) == 102041);
  CHECK(corrected_budget(100000, 50000, 100000.0) == 100000);
}
