// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/certificate.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "metrics/report.hpp"
#include "support/expect_error.hpp"
#include "support/sample_meshes.hpp"

using namespace delos;
using delos::testing::expect_error;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

struct Example {
  explicit Example(const Ellipsoid& body, double shake = 0.2)
      : surface(body), mesh(samples::shaken(body, 3, shake, 5)) {
    spacing = [this](Index tri, int k) {
      return mesh
          .vertices[static_cast<std::size_t>(
              mesh.triangle(tri).vertex[static_cast<std::size_t>(next_corner(k))])]
          .spacing;
    };
    quality = measure_quality(context, surface, spacing, mesh);
  }
  std::vector<std::string> defects(const Certificate& recorded) {
    return certificate_defects(context, {surface, spacing, mesh}, quality, recorded);
  }

  parallel::Executor exec{1};
  Monitor monitor;
  Context context{exec, monitor};
  Ellipsoid surface;
  Mesh mesh;
  SideSpacing spacing;
  Quality quality;
};

/// The only defect, which must hold these words.
void check_defect(Example& example, const Certificate& changed, const std::string& part) {
  const auto defects = example.defects(changed);
  REQUIRE(defects.size() == 1);
  CAPTURE(defects[0]);
  CHECK(defects[0].find(part) != std::string::npos);
}

double angle_deg(const Vec3& at, const Vec3& b, const Vec3& c) {
  return std::acos((b - at).normalized().dot((c - at).normalized())) * kDegPerRad;
}

}  // namespace

TEST_CASE("the certificate has the worst elements that a plain search finds") {
  const Example example{Ellipsoid::wgs84()};
  const Mesh& mesh = example.mesh;
  std::int64_t n_obtuse = 0;
  double worst_deg = 0.0, shortest = 1e9;
  Index worst = kNone;
  std::array<Index, 2> edge{};
  for (Index tri = 0; tri < mesh.n_triangles(); ++tri) {
    const auto& v = mesh.triangle(tri).vertex;
    double largest = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 a = mesh.position(v[k]), b = mesh.position(v[(k + 1) % 3]);
      largest = std::max(largest, angle_deg(a, b, mesh.position(v[(k + 2) % 3])));
      const double relative = (b - a).norm() / mesh.vertices[0].spacing;
      if (relative < shortest)
        edge = {std::min(v[k], v[(k + 1) % 3]), std::max(v[k], v[(k + 1) % 3])};
      shortest = std::min(shortest, relative);
    }
    n_obtuse += largest >= 90.0;
    if (largest > worst_deg) worst = tri;
    worst_deg = std::max(worst_deg, largest);
  }
  REQUIRE(n_obtuse > 0);
  const Certificate c = certificate(example.quality);
  CHECK(c.n_obtuse == n_obtuse);
  CHECK(c.well_centred == 1.0 - static_cast<double>(n_obtuse) / mesh.n_triangles());
  CHECK_FALSE(c.is_well_centred());
  CHECK(c.angle_max_deg.id == worst);
  CHECK(c.angle_max_deg.value == doctest::Approx(worst_deg));
  REQUIRE(c.relative_edge_min);
  CHECK(c.relative_edge_min->value == doctest::Approx(shortest).epsilon(1e-12));
  CHECK(c.relative_edge_min->id == edge[0]);
  CHECK(c.relative_edge_min->other == edge[1]);
  const Vec3 middle = example.surface.project(mesh.position(edge[0]) + mesh.position(edge[1]));
  const Vec3 where = example.surface.point(c.relative_edge_min->where, LatitudeKind::geodetic);
  CHECK((where - middle).norm() < 1e-14);
}

TEST_CASE("nothing measured and numbers that are none have no certificate") {
  expect_error(ErrorKind::internal, {"without triangles"}, [] { certificate(Quality{}); });
  const Example example{Ellipsoid()};
  for (Extreme Quality::*measure : {&Quality::angle_max_deg, &Quality::dual_ratio_min,
                                    &Quality::stagger_max, &Quality::relative_edge_min}) {
    Quality quality = example.quality;
    (quality.*measure).value = kNan;
    expect_error(ErrorKind::internal, {"is nan"}, [&] { certificate(quality); });
    quality = example.quality;
    (quality.*measure).where.lon_rad = kNan;
    CHECK_THROWS_AS(certificate(quality), Error);
  }
  Quality unknown = example.quality;
  unknown.knows_spacing = false;
  CHECK_FALSE(certificate(unknown).relative_edge_min);
  CHECK_FALSE(certificate(unknown).keeps_spacing());
}

TEST_CASE("elements are described with ids from 1, longitude and latitude") {
  const LonLat place{-12.5 * kRadPerDeg, 45.0 * kRadPerDeg};
  CHECK(describe({0.1, 11, 56, place, Element::edge}) ==
        "the edge of cells 12 and 57 (from 1), lon -12.500000, lat 45.000000 deg");
  CHECK(
      describe({0.1, 6, kNone, place, Element::triangle}).find("triangle 7 (from 1), lon -12.5") ==
      0);
  CHECK(describe({0.1, 0, kNone, place, Element::cell}).find("cell 1 (from 1)") == 0);
}

TEST_CASE("the verdict says what holds and fits its columns") {
  Certificate c;
  c.well_centred = 1.0;
  c.angle_max_deg.value = 81.234;
  c.relative_edge_min = Extreme{0.7123};
  auto lines = certificate_text(c);
  REQUIRE(lines.size() == 2);
  CHECK(lines[0] == "well centred: every triangle acute, largest angle 81.23 degrees");
  CHECK(lines[1] == "spacing kept: every edge at least 0.7123 of the wanted (bound 0.65)");
  c = {0.99999, 123456789, {179.999}, {}, {}, Extreme{0.6499}};
  lines = certificate_text(c);
  CHECK(lines[0].find("NOT well centred: 123456789 obtuse") == 0);
  CHECK(lines[1].find("spacing NOT kept: an edge is 0.6499") == 0);
  for (const std::string& line : lines) CHECK(line.size() <= 68);
  c.relative_edge_min.reset();
  CHECK(certificate_text(c)[1].find("spacing not known") == 0);
}

TEST_CASE("a mesh bears out its own certificate on any body") {
  for (const Ellipsoid& body :
       {Ellipsoid(), Ellipsoid::wgs84(), Ellipsoid(Vec3(1.2, 1.0, 0.8), Vec3(0, 0, 0))}) {
    for (const double shake : {0.0, 0.05, 0.25}) {
      Example example{body, shake};
      CHECK(example.defects(certificate(example.quality)).empty());
    }
  }
}

TEST_CASE("every change of a recorded certificate is found and named") {
  Example example{Ellipsoid::wgs84()};
  const Certificate good = certificate(example.quality);
  const auto changed = [&](const std::function<void(Certificate&)>& change) {
    Certificate c = good;
    change(c);
    return c;
  };
  check_defect(example, changed([](auto& c) { c.well_centred = 1.0; }), "well_centred is 1 of");
  check_defect(example, changed([](auto& c) { c.angle_max_deg.value -= 1e-3; }), "angle_max is ");
  check_defect(example, changed([](auto& c) { c.dual_ratio_min.value += 1e-6; }),
               "dual_ratio_min is ");
  check_defect(example, changed([](auto& c) { c.stagger_max.value = kNan; }), "stagger_max is nan");
  check_defect(example, changed([](auto& c) { c.relative_edge_min->value = 0.9; }),
               "relative_edge_min is 0.9, the arrays give 0.");
  check_defect(example, changed([](auto& c) { c.relative_edge_min->where.lat_rad += 1e-5; }),
               "but that element is at the edge of cells");
  check_defect(example, changed([](auto& c) { c.angle_max_deg.id = 100000; }),
               "triangle 100001 (from 1), lon");
  check_defect(example, changed([](auto& c) { c.stagger_max.other = c.stagger_max.id; }),
               "which is not there");
  check_defect(example, changed([](auto& c) {
                 ++c.n_obtuse;
                 c.well_centred -= 1.0 / 1280;
               }),
               "n_obtuse is ");
}

TEST_CASE("another element in place of the worst is found by its value") {
  Example example{Ellipsoid()};
  Certificate c = certificate(example.quality);
  c.angle_max_deg.id = c.angle_max_deg.id == 0 ? 1 : 0;
  const auto defects = example.defects(c);
  REQUIRE(defects.size() == 2);  // its value and its place
  CHECK(defects[0].find("but that element has") != std::string::npos);
  CHECK(defects[1].find("but that element is at") != std::string::npos);
}

TEST_CASE("elements that tie with the worst bear out a certificate too") {
  Example example{Ellipsoid(), 0.0};  // 120 symmetries
  Certificate c = certificate(example.quality);
  int n_ties = 0;
  for (Index tri = 0; tri < example.mesh.n_triangles(); ++tri) {
    const auto& v = example.mesh.triangle(tri).vertex;
    c.angle_max_deg.id = tri;
    c.angle_max_deg.where = example.surface.lon_lat(
        example.surface.project(example.mesh.position(v[0]) + example.mesh.position(v[1]) +
                                example.mesh.position(v[2])),
        LatitudeKind::geodetic);
    n_ties += example.defects(c).empty();
  }
  CHECK(n_ties >= 20);
  CHECK(n_ties < example.mesh.n_triangles());
}

TEST_CASE("a spacing in the certificate that the file lacks is a defect") {
  Example example{Ellipsoid()};
  const Certificate c = certificate(example.quality);
  example.spacing = nullptr;
  example.quality =
      measure_quality(example.context, example.surface, example.spacing, example.mesh);
  check_defect(example, c, "does not say the wanted spacing");
}
