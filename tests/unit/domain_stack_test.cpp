// SPDX-License-Identifier: BSD-3-Clause
#include "domain/stack.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/hash.hpp"
#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"

using namespace delos;
using delos::testing::expect_error;
using domain::Stack;
using domain::StackOptions;

namespace {

Stack stack_of(const std::vector<double>& depth_m, const StackOptions& options, int threads = 1) {
  parallel::Executor exec(threads);
  Monitor monitor;
  Context context{exec, monitor};
  const double interfaces[] = {10.0, 30.0, 60.0, 100.0};  // 10, 20, 30 and 40 m
  return domain::build_stack(context, domain::listed_levels(interfaces), depth_m, options);
}

}  // namespace

TEST_CASE("the bottom cell is a part of its level, and never a thin one") {
  const StackOptions options{1, true, 0.2};
  //                          land  whole  part  thin, made thicker  thin, left out  too deep
  const std::vector<double> depths{0.0, 60.0, 45.0, 63.0 + 2.0, 63.0, 500.0, 2.0};
  const Stack stack = stack_of(depths, options);
  CHECK(std::ranges::equal(stack.n_layers, std::vector<Index>{0, 3, 3, 4, 3, 4, 1}));
  CHECK(std::ranges::equal(stack.bottom_depth_m,
                           std::vector<double>{0.0, 60.0, 45.0, 68.0, 60.0, 100.0, 10.0}));
  CHECK(stack.thickness_m(2, 0) == 10.0);
  CHECK(stack.thickness_m(2, 1) == 20.0);
  CHECK(stack.thickness_m(2, 2) == 15.0);
  CHECK(stack.thickness_m(2, 3) == 0.0);
  CHECK(stack.thickness_m(0, 0) == 0.0);
}

TEST_CASE("without partial cells the bottom goes to the nearest interface") {
  const Stack stack = stack_of({19.0, 21.0, 79.0, 81.0}, {1, false, 0.1});
  CHECK(std::ranges::equal(stack.bottom_depth_m, std::vector<double>{10.0, 30.0, 60.0, 100.0}));
}

TEST_CASE("a sea cell has the least number of whole levels") {
  const Stack stack = stack_of({1.0, 30.0, 31.0, 0.0}, {2, true, 0.5});
  CHECK(std::ranges::equal(stack.n_layers, std::vector<Index>{2, 2, 2, 0}));
  CHECK(std::ranges::equal(stack.bottom_depth_m, std::vector<double>{30.0, 30.0, 30.0, 0.0}));
  expect_error(ErrorKind::config, {"minimum_levels = 5", "4 levels"}, [] {
    static_cast<void>(stack_of({1.0}, {5, true, 0.1}));
  });
}

TEST_CASE("layers sum to the depth of the bottom, and their volume to the sea's") {
  const Ellipsoid earth = Ellipsoid::sphere(6371220.0);
  const Grid grid = samples::grid_of(earth, samples::shaken(earth, 3, 0.2, 9));
  std::vector<double> depth_m;
  for (std::uint64_t i = 0; i < grid.cell_area_m2.size(); ++i) {
    depth_m.push_back(std::max(0.0, 120.0 * uniform01(5, i) - 20.0));
  }
  const StackOptions options{1, true, 0.1};
  const Stack stack = stack_of(depth_m, options);
  double volume_m3 = 0.0, moved_m = 0.0;
  std::int64_t n_layers = 0;
  for (std::int64_t i = 0; i < grid.n_cells(); ++i) {
    const auto cell = static_cast<std::size_t>(i);
    double sum_m = 0.0;
    for (std::int64_t k = 0; k < stack.levels.n_levels(); ++k) {
      const double thickness_m = stack.thickness_m(i, k);
      CHECK((thickness_m > 0.0) == (k < stack.n_layers[cell]));
      if (thickness_m > 0.0) CHECK(thickness_m >= 0.0999 * stack.levels.thickness_m(k));
      sum_m += thickness_m;
    }
    CHECK(sum_m == doctest::Approx(stack.bottom_depth_m[cell]).epsilon(1e-14));
    if (depth_m[cell] > 10.0) {
      moved_m = std::max(moved_m, std::abs(stack.bottom_depth_m[cell] - depth_m[cell]));
    }
    volume_m3 += grid.cell_area_m2[cell] * sum_m;
    n_layers += stack.n_layers[cell];
  }
  CHECK(moved_m <= 0.5 * 0.1 * 40.0 + 1e-12);  // half the least part of the thickest level
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  const auto report = domain::measure_stack(context, grid, stack);
  CHECK(report.volume_m3 == doctest::Approx(volume_m3).epsilon(1e-13));
  CHECK(report.n_layers == n_layers);
  CHECK(report.min_bottom_layer_m >= 2.0 - 1e-12);
  CHECK(report.n_wet ==
        std::count_if(depth_m.begin(), depth_m.end(), [](double d) { return d > 0.0; }));
  for (const int threads : {2, 5}) {
    CHECK(std::ranges::equal(stack_of(depth_m, options, threads).bottom_depth_m,
                             stack.bottom_depth_m));
  }
}
