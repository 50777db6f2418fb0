// SPDX-License-Identifier: BSD-3-Clause
#include "domain/levels.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numeric>

#include "support/expect_error.hpp"

using namespace delos;
using delos::testing::expect_error;
using domain::Levels;
using domain::Stretching;

namespace {

void check_ascending(const Levels& levels) {
  CHECK(levels.interface_m.front() == 0.0);
  for (std::int64_t k = 0; k < levels.n_levels(); ++k) CHECK(levels.thickness_m(k) > 0.0);
}

}  // namespace

TEST_CASE("the usual ocean levels begin at 10 m and grow to the floor") {
  for (const Stretching& shape : {domain::ocean_60(), domain::ocean_80()}) {
    CAPTURE(shape.n_levels);
    const Levels levels = domain::stretched_levels(shape);
    check_ascending(levels);
    CHECK(levels.n_levels() == shape.n_levels);
    CHECK(levels.depth_m() == shape.depth_m);
    CHECK(levels.thickness_m(0) == doctest::Approx(shape.top_m).epsilon(1e-9));
    CHECK(levels.thickness_m(shape.n_levels - 1) == doctest::Approx(shape.bottom_m).epsilon(1e-9));
    for (std::int64_t k = 1; k < levels.n_levels(); ++k) {
      const double growth = levels.thickness_m(k) / levels.thickness_m(k - 1);
      CHECK(growth >= 1.0);
      CHECK(growth < 1.2);  // neighbours are alike, as vertical differences want
    }
    // The surface layer of the ocean is seen by some tens of levels.
    CHECK(levels.bottom_m(14) < 200.0);
  }
}

TEST_CASE("stretched layers follow their formula, to any depth within reach") {
  for (const Stretching& shape :
       {Stretching{40, 5000.0, 5.0, 300.0}, Stretching{2, 30.0, 10.0, 20.0},
        Stretching{25, 1000.0, 80.0, 10.0}}) {
    CAPTURE(shape.n_levels);
    const Levels levels = domain::stretched_levels(shape);
    check_ascending(levels);
    CHECK(levels.depth_m() == shape.depth_m);
    CHECK(levels.thickness_m(0) == doctest::Approx(shape.top_m).epsilon(1e-8));
    CHECK(levels.thickness_m(shape.n_levels - 1) == doctest::Approx(shape.bottom_m).epsilon(1e-8));
    if (shape.n_levels < 10) continue;
    // Three layers give the centre c of tanh((x - c) / w); the others must agree with it.
    const auto expected = [&](double x, double c) {
      const double w = 0.2, top = std::tanh(c / w);
      return shape.top_m + (shape.bottom_m - shape.top_m) * (std::tanh((x - c) / w) + top) /
                               (std::tanh((1.0 - c) / w) + top);
    };
    double best = 1e300;
    for (double c = -0.5; c <= 1.5; c += 1e-3) {
      double worst = 0.0;
      for (std::int64_t k = 0; k < levels.n_levels(); ++k) {
        const double x = static_cast<double>(k) / static_cast<double>(levels.n_levels() - 1);
        worst = std::max(worst, std::abs(levels.thickness_m(k) - expected(x, c)));
      }
      best = std::min(best, worst);
    }
    CHECK(best < 1e-2 * std::max(shape.top_m, shape.bottom_m));
  }
}

TEST_CASE("levels that can't be are refused with what can") {
  const auto refused = [](const Stretching& shape, const std::string& message) {
    expect_error(ErrorKind::config, {message},
                 [&] { static_cast<void>(domain::stretched_levels(shape)); });
  };
  refused({60, 20000.0, 10.0, 250.0}, "m, not 20000 m");
  refused({60, 300.0, 10.0, 250.0}, "60 layers of 10 to 250 m reach");
  refused({1, 10.0, 10.0, 10.0}, "two at least");
  refused({10, 100.0, 0.0, 10.0}, "thicknesses > 0 m");
  const double wrong[] = {10.0, 30.0, 20.0};
  expect_error(ErrorKind::config, {"the interface at 20 m follows one at 30 m"},
               [&] { static_cast<void>(domain::listed_levels(wrong)); });
  expect_error(ErrorKind::config, {"one depth at least"},
               [&] { static_cast<void>(domain::listed_levels(std::span(wrong, 0))); });
  expect_error(ErrorKind::config, {"0 levels of 10 m"},
               [] { static_cast<void>(domain::uniform_levels(0, 10.0)); });
}

TEST_CASE("listed levels take a zero or leave it out, uniform ones share the depth") {
  const double with_zero[] = {0.0, 10.0, 30.0}, without[] = {10.0, 30.0};
  CHECK(domain::listed_levels(with_zero).interface_m == std::vector<double>{0.0, 10.0, 30.0});
  CHECK(domain::listed_levels(without).interface_m == std::vector<double>{0.0, 10.0, 30.0});
  const Levels even = domain::uniform_levels(4, 100.0);
  CHECK(even.interface_m == std::vector<double>{0.0, 25.0, 50.0, 75.0, 100.0});
  CHECK(even.middle_m(1) == 37.5);
}
