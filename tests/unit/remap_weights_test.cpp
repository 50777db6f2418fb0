// SPDX-License-Identifier: BSD-3-Clause
#include "remap/weights.hpp"

#include <doctest/doctest.h>

#include "support/sample_fields.hpp"

using namespace delos;

namespace {

remap::Weights sample_weights() {
  // 1 . . | .25 . .75 | . .5 .5 | .5 .5 .
  return {3, true, {0, 1, 3, 5, 7}, {0, 0, 2, 1, 2, 0, 1}, {1.0, 0.25, 0.75, 0.5, 0.5, 0.5, 0.5}};
}

}  // namespace

TEST_CASE("weights multiply, and copy where a row has one weight") {
  parallel::Executor exec(1);
  const std::vector<double> source{0.1, 2.0, -4.0};
  std::vector<double> target(4);
  remap::apply(exec, sample_weights(), source, target);
  CHECK(target[0] == 0.1);
  CHECK(target[1] == doctest::Approx(-2.975));
  CHECK(target[2] == doctest::Approx(-1.0));
  CHECK(target[3] == doctest::Approx(1.05));
}

TEST_CASE("fields of a wrong size are refused") {
  parallel::Executor exec(1);
  const std::vector<double> source(3);
  std::vector<double> target(5);
  CHECK_THROWS_AS(remap::apply(exec, sample_weights(), source, target), Error);
}

TEST_CASE("the transposed weights have ascending columns and come back") {
  parallel::Executor exec(2);
  const remap::Weights weights = sample_weights();
  const remap::Weights turned = remap::transpose(exec, weights);
  CHECK(turned.n_rows() == 3);
  CHECK(turned.n_columns == 4);
  CHECK(turned.offsets == Array<std::int64_t>{0, 3, 5, 7});
  CHECK(turned.column == Array<Index>{0, 1, 3, 2, 3, 1, 2});
  const remap::Weights back = remap::transpose(exec, turned);
  CHECK(back.offsets == weights.offsets);
  CHECK(back.column == weights.column);
  CHECK(back.value == weights.value);
}

TEST_CASE("rows of first-order weights sum to 1 and lie in 0 to 1") {
  const Ellipsoid sphere;
  const Grid a = samples::grid_of(sphere, samples::bisected_icosahedron(sphere, 3));
  const Grid b = samples::grid_of(sphere, samples::shaken(sphere, 2, 0.1, 1));
  parallel::Executor exec(1);
  const auto weights = remap::first_order_weights(exec, samples::overlaps_of(a, b));
  CHECK(weights.n_rows() == b.n_cells());
  for (std::int64_t row = 0; row < weights.n_rows(); ++row) {
    double sum = 0.0;
    for (auto k = weights.offsets[at(row)]; k < weights.offsets[at(row) + 1]; ++k) {
      CHECK(weights.value[at(k)] > 0.0);
      CHECK((k == weights.offsets[at(row)] || weights.column[at(k)] > weights.column[at(k) - 1]));
      sum += weights.value[at(k)];
    }
    CHECK(sum == doctest::Approx(1.0).epsilon(1e-15));
  }
}
