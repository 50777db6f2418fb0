// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/requirements.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "metrics/certificate.hpp"
#include "support/expect_error.hpp"
#include "support/sample_meshes.hpp"

using namespace delos;
using delos::testing::expect_error;

namespace {

Quality measured(double shake) {
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  const Ellipsoid surface;
  const Mesh mesh = samples::shaken(surface, 3, shake, 5);
  const double spacing = mesh.vertices[0].spacing;
  return measure_quality(
      context, surface, [&](Index, int) { return spacing; }, mesh);
}

bool has(const std::string& sentence, const std::string& part) {
  return sentence.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("nothing required is nothing missed") {
  CHECK(missed_requirements({}, measured(0.25)).empty());
}

TEST_CASE("each bound is met at the value reached and missed a step beyond, with place") {
  const Quality quality = measured(0.25);
  for (const RequirementRule& rule : requirement_rules()) {
    CAPTURE(rule.key);
    const Extreme& worst = quality.*rule.reached;
    Requirements wanted;
    wanted.*rule.wanted = worst.value;
    CHECK(missed_requirements(wanted, quality).empty());
    wanted.*rule.wanted = std::nextafter(worst.value, rule.is_least ? 1e9 : -1e9);
    const auto missed = missed_requirements(wanted, quality);
    REQUIRE(missed.size() == 1);
    CAPTURE(missed[0]);
    CHECK(missed[0].find(text(rule.key, ": ", worst.value, rule.unit)) == 0);
    CHECK(has(missed[0], rule.is_least ? " instead of at least " : " instead of at most "));
    CHECK(has(missed[0], describe(worst)));
  }
}

TEST_CASE("well_centred counts the obtuse triangles and names the worst") {
  Requirements wanted;
  wanted.well_centred = true;
  CHECK(missed_requirements(wanted, measured(0.0)).empty());
  const Quality bad = measured(0.25);
  REQUIRE(bad.n_obtuse > 0);
  const auto missed = missed_requirements(wanted, bad);
  REQUIRE(missed.size() == 1);
  CHECK(has(missed[0], text("well_centred: ", bad.n_obtuse, " of 1280 triangles")));
  CHECK(has(missed[0], describe(bad.angle_max_deg)));
}

TEST_CASE("the share of hexagons is judged") {
  const Quality quality = measured(0.0);  // 12 pentagons among 642 cells
  Requirements wanted;
  wanted.degree_6_min = 0.98;
  CHECK(missed_requirements(wanted, quality).empty());
  wanted.degree_6_min = 0.99;
  const auto missed = missed_requirements(wanted, quality);
  REQUIRE(missed.size() == 1);
  CHECK(has(missed[0], "degree_6_min: 0.98"));
}

TEST_CASE("all that is missed is told, in the order of the rules") {
  Requirements wanted;
  wanted.well_centred = true;
  wanted.angle_max_deg = 61.0;
  wanted.dual_ratio_min = 0.5;
  const auto missed = missed_requirements(wanted, measured(0.25));
  REQUIRE(missed.size() == 3);
  CHECK(missed[0].find("well_centred:") == 0);
  CHECK(missed[1].find("dual_ratio_min:") == 0);
  CHECK(missed[2].find("angle_max:") == 0);
}

TEST_CASE("a spacing that is not known meets no requirement of it, a NaN none at all") {
  Quality quality = measured(0.0);
  quality.knows_spacing = false;
  Requirements wanted;
  wanted.relative_edge_min = 0.0;
  const auto missed = missed_requirements(wanted, quality);
  REQUIRE(missed.size() == 1);
  CHECK(has(missed[0], "relative_edge_min: can't be judged"));
  quality.stagger_max.value = std::numeric_limits<double>::quiet_NaN();
  wanted = {};
  wanted.stagger_max = 10.0;
  CHECK(missed_requirements(wanted, quality).size() == 1);
  expect_error(ErrorKind::internal, {"without triangles"},
               [] { missed_requirements({}, Quality{}); });
}
