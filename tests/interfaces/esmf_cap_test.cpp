// SPDX-License-Identifier: BSD-3-Clause
// A driver without ESMF: goes through the NUOPC cap's phases in NUOPC's order on several
// "processes" in one, and holds what they hand out against the grid.
#include <cap.h>
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <delos/delos.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "support/temporary_folder.hpp"

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadPerDeg = kPi / 180.0;
constexpr double kRadius_m = 6371220.0;
constexpr const char* kYaml =
    "surface: {shape: sphere, radius: 6371.22 km}\n"
    "sizing: {sources: [{type: constant, spacing: 600 km}]}\nrefine: {tile_vertices: 500}\n";
constexpr std::array kImports = {"surface_eastward_sea_water_velocity",
                                 "surface_northward_sea_water_velocity", "eddy_kinetic_energy"};
constexpr std::array kExports = {"cell_area", "cell_spacing", "grid_generation"};
constexpr int kArgValue = 9;   // ESMF_RC_ARG_VALUE
constexpr int kNotValid = 42;  // ESMF_RC_NOT_VALID
constexpr int kNotFound = 41;  // ESMF_RC_NOT_FOUND
constexpr int kNoCommunicator = 0;
constexpr int kGregorian = 0;
constexpr int kNoleap = 2;

struct Destroy {
  void operator()(delos_cap* cap) const { delos_cap_destroy(cap); }
};
using Cap = std::unique_ptr<delos_cap, Destroy>;

/// One process, in NUOPC's order of phases.
class Driver {
 public:
  Driver() {
    delos_cap* cap = nullptr;
    REQUIRE(delos_cap_create(folder_.write("grid.yaml", kYaml).c_str(), &cap) == 0);
    cap_.reset(cap);
  }
  delos_cap* cap() { return cap_.get(); }
  void initialize() {
    REQUIRE(delos_cap_advertise(cap()) == 0);
    REQUIRE_MESSAGE(delos_cap_realize(cap(), kNoCommunicator, 1) == 0, delos_cap_message(cap()));
  }
  delos_cap_mesh mesh() {
    delos_cap_mesh out = {};
    REQUIRE(delos_cap_get_mesh(cap(), &out) == 0);
    return out;
  }
  std::vector<double> exported(const char* name) {
    std::vector<double> values(static_cast<std::size_t>(mesh().n_elements));
    REQUIRE(delos_cap_get_export(cap(), name, values.data(), mesh().n_elements) == 0);
    return values;
  }
  void import(const char* name, const std::vector<double>& values) {
    const int code =
        delos_cap_set_import(cap(), name, values.data(), static_cast<std::int64_t>(values.size()));
    REQUIRE_MESSAGE(code == 0, delos_cap_message(cap()));
  }
  void advance(const delos_cap_time& from, const delos_cap_time& until) {
    const int code = delos_cap_advance(cap(), &from, &until, kGregorian);
    REQUIRE_MESSAGE(code == 0, delos_cap_message(cap()));
  }

 private:
  delos::testing::TemporaryFolder folder_;
  Cap cap_;
};

delos_cap_time day(int number) { return {2000, 2, number, 0, 0, 0, 0, 1}; }

std::array<double, 3> on_sphere(const double* lon_lat_deg) {
  const double lon = lon_lat_deg[0] * kRadPerDeg;
  const double lat = lon_lat_deg[1] * kRadPerDeg;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

/// Above 0 when a, b, c turn left seen from outside.
double turn(const std::array<double, 3>& a, const std::array<double, 3>& b,
            const std::array<double, 3>& c) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

double sum(std::span<const double> values) {
  double total = 0.0;
  for (const double value : values) total += value;
  return total;
}

void check_elements(const delos_cap_mesh& mesh) {
  int corner = 0;
  for (int i = 0; i < mesh.n_elements; ++i) {
    const int n = mesh.element_corners[i];
    REQUIRE(n >= 4);
    const auto centre = on_sphere(mesh.element_lon_lat_deg + 2 * i);
    for (int j = 0; j < n; ++j) {
      const int a = mesh.element_nodes[corner + j];
      const int b = mesh.element_nodes[corner + (j + 1) % n];
      REQUIRE(a >= 1);
      REQUIRE(a <= mesh.n_nodes);
      REQUIRE(turn(centre, on_sphere(mesh.node_lon_lat_deg + 2 * (a - 1)),
                   on_sphere(mesh.node_lon_lat_deg + 2 * (b - 1))) > 0.0);
    }
    corner += n;
  }
  CHECK(corner == mesh.n_corners);
}

}  // namespace

TEST_CASE("the cap advertises its fields with units before there is a grid") {
  Driver driver;
  REQUIRE(delos_cap_advertise(driver.cap()) == 0);
  delos_cap_item item = {};
  for (int i = 0; i < 3; ++i) {
    REQUIRE(delos_cap_get_item(driver.cap(), DELOS_CAP_IMPORT, i, &item) == 0);
    CHECK(std::string(item.name) == kImports[static_cast<std::size_t>(i)]);
    CHECK(std::string(item.units) == (i < 2 ? "m s-1" : "m2 s-2"));
    REQUIRE(delos_cap_get_item(driver.cap(), DELOS_CAP_EXPORT, i, &item) == 0);
    CHECK(std::string(item.name) == kExports[static_cast<std::size_t>(i)]);
  }
  CHECK(delos_cap_get_item(driver.cap(), DELOS_CAP_IMPORT, 3, &item) == kNotFound);
  CHECK(delos_cap_get_item(driver.cap(), DELOS_CAP_EXPORT, 3, &item) == kNotFound);
  CHECK(delos_cap_generation(driver.cap()) == 0);
}

TEST_CASE("the cap's mesh is the C++ grid") {
  Driver driver;
  driver.initialize();
  const delos::Grid grid = delos::generate(delos::Config::from_text(kYaml));
  const auto mesh = driver.mesh();
  REQUIRE(mesh.n_elements == grid.n_cells());
  REQUIRE(mesh.n_nodes == grid.n_vertices());
  REQUIRE(mesh.n_corners == 2 * grid.n_edges());
  const auto area_m2 = driver.exported("cell_area");
  const auto spacing_m = driver.exported("cell_spacing");
  double area = 0.0;
  for (std::int32_t i = 0; i < mesh.n_elements; ++i) {
    const auto cell = static_cast<std::size_t>(i);
    REQUIRE(mesh.element_ids[i] == i + 1);
    REQUIRE(area_m2[cell] == grid.cell_area_m2()[cell]);
    REQUIRE(spacing_m[cell] == grid.cell_spacing_m()[cell]);
    REQUIRE(mesh.element_lon_lat_deg[2 * i] * kRadPerDeg ==
            doctest::Approx(grid.cell_lon_lat()[2 * cell]).epsilon(1e-14));
    area += mesh.element_area[i];
  }
  for (std::int32_t i = 0; i < mesh.n_corners; ++i) {
    const auto vertex = grid.vertices_on_cell()[static_cast<std::size_t>(i)];
    REQUIRE(mesh.node_ids[mesh.element_nodes[i] - 1] == vertex + 1);
  }
  for (std::int32_t i = 0; i < mesh.n_nodes; ++i) {
    const auto vertex = static_cast<std::size_t>(mesh.node_ids[i] - 1);
    REQUIRE(mesh.node_owners[i] == 0);
    REQUIRE(mesh.node_lon_lat_deg[2 * i + 1] * kRadPerDeg ==
            doctest::Approx(grid.vertex_lon_lat()[2 * vertex + 1]).epsilon(1e-14));
  }
  check_elements(mesh);
  CHECK(std::abs(area / (4.0 * kPi) - 1.0) < 1e-13);
  CHECK(std::abs(sum(area_m2) / (4.0 * kPi * kRadius_m * kRadius_m) - 1.0) < 1e-13);
  CHECK(driver.exported("grid_generation") == std::vector<double>(area_m2.size(), 1.0));
}

TEST_CASE("the cap goes from step to step with imports and ends") {
  Driver driver;
  driver.initialize();
  const std::vector<double> energy(driver.exported("cell_area").size(), 0.02);
  for (const int from : {27, 28}) {
    driver.import(kImports[2], energy);
    driver.advance(day(from), day(from + 1));
  }
  const auto area_m2 = driver.exported("cell_area");
  REQUIRE(delos_cap_finalize(driver.cap()) == 0);
  CHECK(delos_cap_generation(driver.cap()) == 0);
  // Once more, with the next generation.
  driver.initialize();
  CHECK(delos_cap_generation(driver.cap()) == 2);
  CHECK(driver.exported("grid_generation")[0] == 2.0);
  CHECK(driver.exported("cell_area") == area_m2);
}

TEST_CASE("the cap refuses wrong calls with ESMF's codes and a text") {
  delos_cap* raw = nullptr;
  CHECK(delos_cap_create(nullptr, &raw) == kNotValid);
  CHECK(std::string(delos_cap_message(raw)).find("configuration") != std::string::npos);
  CHECK(delos_cap_advertise(raw) == kNotValid);
  delos_cap_destroy(raw);
  delos::testing::TemporaryFolder folder;
  CHECK(delos_cap_create(folder.write("bad.yaml", "sizng: {}\n").c_str(), &raw) == kArgValue);
  CHECK(std::string(delos_cap_message(raw)).find("sizng") != std::string::npos);
  delos_cap_destroy(raw);
  delos_cap_destroy(nullptr);

  Driver driver;
  delos_cap* const cap = driver.cap();
  delos_cap_mesh mesh = {};
  double value = 0.0;
  const auto says = [&](const char* part) {
    return std::string(delos_cap_message(cap)).find(part) != std::string::npos;
  };
  CHECK(delos_cap_realize(cap, kNoCommunicator, 1) == kNotValid);
  CHECK(says("initialize(advertise)"));
  CHECK(delos_cap_advertise(cap) == 0);
  CHECK(delos_cap_get_mesh(cap, &mesh) == kNotValid);
  CHECK(says("realize"));
  CHECK(delos_cap_set_import(cap, kImports[0], &value, 1) == kNotValid);
  CHECK(delos_cap_realize(cap, kNoCommunicator, 2) == kArgValue);
  CHECK(says("2 processes"));
  driver.initialize();
  const auto n = driver.mesh().n_elements;
  std::vector<double> values(static_cast<std::size_t>(n), 0.0);
  CHECK(delos_cap_get_export(cap, "cell_area", &value, 1) == kNotValid);
  CHECK(delos_cap_get_export(cap, "cell_volume", values.data(), n) == kNotFound);
  CHECK(delos_cap_set_import(cap, "cell_volume", values.data(), n) == kNotFound);
  CHECK(delos_cap_set_import(cap, kImports[0], &value, 1) == kNotValid);
  CHECK(says(kImports[0]));
  const auto from = day(3), until = day(4);
  driver.advance(from, until);
  CHECK(delos_cap_advance(cap, &from, &until, kGregorian) == kNotValid);
  CHECK(says("2000-02-04"));
  CHECK(delos_cap_advance(cap, &until, &from, kGregorian) != 0);
  CHECK(delos_cap_advance(cap, &from, &until, kNoleap) != 0);
  driver.advance(day(4), day(5));
}
