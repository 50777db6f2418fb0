// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/open_mesh.hpp"

#include <doctest/doctest.h>

using delos::Ellipsoid;
using delos::Index;
using delos::OpenMeshReport;
using delos::Vec3;

namespace {

using Corners = std::vector<std::array<Index, 3>>;

const std::vector<Vec3> kOctahedron = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                       {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};

OpenMeshReport measure(const Corners& corners, std::size_t n_points) {
  const std::span<const Vec3> points(kOctahedron.data(), n_points);
  return delos::measure_open_mesh(Ellipsoid::sphere(2.0), points, corners);
}

bool tells(const OpenMeshReport& report, const std::string& part) {
  for (const std::string& defect : report.defects) {
    if (defect.find(part) != std::string::npos) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("two octants have the numbers that geometry gives them") {
  const OpenMeshReport report = measure({{0, 1, 2}, {1, 3, 2}}, 4);
  CHECK(report.defects.empty());
  CHECK(report.n_edges == 5);
  CHECK(report.n_border_edges == 4);
  CHECK(report.n_parts == 1);
  CHECK(report.n_obtuse == 0);
  CHECK(report.area_m2 == doctest::Approx(4.0 * delos::kPi));
  CHECK(report.angle_min_deg == doctest::Approx(60.0));
  CHECK(report.edge_mean_m == doctest::Approx(delos::kPi));
}

TEST_CASE("octants that only touch in a point are two parts") {
  const OpenMeshReport report = measure({{0, 1, 2}, {2, 3, 4}}, 5);
  CHECK(report.defects.empty());
  CHECK(report.n_parts == 2);
  CHECK(report.n_border_edges == 6);
}

TEST_CASE("what no mesh may have is told with its ids") {
  CHECK(tells(measure({{0, 1, 2}}, 4), "point 4 belongs to no triangle"));
  CHECK(tells(measure({{0, 1, 2}, {0, 0, 1}}, 3), "triangle 2 has two equal corners"));
  CHECK(tells(measure({{0, 1, 2}, {1, 2, 3}}, 4), "points 2 and 3 is passed in one direction"));
  CHECK(tells(measure({{0, 1, 2}, {1, 2, 3}}, 4), "triangle 2 is flat or clockwise"));
  CHECK(tells(measure({{0, 1, 2}, {1, 3, 2}, {1, 2, 5}}, 6), "points 2 and 3 has 3 triangles"));
}
