// SPDX-License-Identifier: BSD-3-Clause
// A driver without ESMF: goes through the NUOPC cap's phases in NUOPC's order on several
// "processes" in one, and holds what they hand out against the grid.
#include <cap.h>
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <delos/delos.hpp>
#include <map>
#include <memory>
#include <set>
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
constexpr int kGregorian = 0;
constexpr int kNoleap = 2;

struct Destroy {
  void operator()(delos_cap* cap) const { delos_cap_destroy(cap); }
};
using Cap = std::unique_ptr<delos_cap, Destroy>;

/// The phases on all processes, one after another.
class Driver {
 public:
  explicit Driver(int n_processes) {
    const std::string config = folder_.write("grid.yaml", kYaml);
    for (int i = 0; i < n_processes; ++i) {
      delos_cap* cap = nullptr;
      REQUIRE(delos_cap_create(config.c_str(), &cap) == 0);
      caps_.emplace_back(cap);
    }
  }
  int size() const { return static_cast<int>(caps_.size()); }
  delos_cap* cap(int process) { return caps_[static_cast<std::size_t>(process)].get(); }

  void advertise() {
    for (int i = 0; i < size(); ++i) REQUIRE(delos_cap_advertise(cap(i)) == 0);
  }
  void realize() {
    for (int i = 0; i < size(); ++i) REQUIRE(delos_cap_realize(cap(i), i, size()) == 0);
  }
  void initialize() {
    advertise();
    realize();
  }
  delos_cap_mesh mesh(int process) {
    delos_cap_mesh out = {};
    REQUIRE(delos_cap_get_mesh(cap(process), &out) == 0);
    return out;
  }
  /// An export of all processes, in their order.
  std::vector<double> gathered(const char* name) {
    std::vector<double> all;
    for (int i = 0; i < size(); ++i) {
      std::vector<double> part(static_cast<std::size_t>(mesh(i).n_elements));
      REQUIRE(delos_cap_get_export(cap(i), name, part.data(), mesh(i).n_elements) == 0);
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }
  void advance(const delos_cap_time& from, const delos_cap_time& until) {
    for (int i = 0; i < size(); ++i) {
      const int code = delos_cap_advance(cap(i), &from, &until, kGregorian);
      REQUIRE_MESSAGE(code == 0, delos_cap_message(cap(i)));
    }
  }

 private:
  delos::testing::TemporaryFolder folder_;
  std::vector<Cap> caps_;
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

/// What the processes' meshes are together.
struct Whole {
  std::set<std::int32_t> elements;
  std::map<std::int32_t, std::int32_t> node_owner;
  std::map<std::int32_t, std::set<int>> node_processes;
  std::map<std::int32_t, std::array<double, 2>> node_place;
  double area = 0.0;
  bool agree = true;  ///< on owners and places of nodes
};

Whole put_together(Driver& driver) {
  Whole whole;
  for (int process = 0; process < driver.size(); ++process) {
    const auto mesh = driver.mesh(process);
    for (int i = 0; i < mesh.n_elements; ++i) {
      whole.agree = whole.agree && whole.elements.insert(mesh.element_ids[i]).second;
      whole.area += mesh.element_area[i];
    }
    for (int i = 0; i < mesh.n_nodes; ++i) {
      const auto id = mesh.node_ids[i];
      const std::array place = {mesh.node_lon_lat_deg[2 * i], mesh.node_lon_lat_deg[2 * i + 1]};
      const auto owner = whole.node_owner.emplace(id, mesh.node_owners[i]).first->second;
      const auto known = whole.node_place.emplace(id, place).first->second;
      whole.agree = whole.agree && owner == mesh.node_owners[i] && known == place;
      whole.node_processes[id].insert(process);
    }
  }
  return whole;
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
  Driver driver(1);
  driver.advertise();
  delos_cap_item item = {};
  for (int i = 0; i < 3; ++i) {
    REQUIRE(delos_cap_get_item(driver.cap(0), DELOS_CAP_IMPORT, i, &item) == 0);
    CHECK(std::string(item.name) == kImports[static_cast<std::size_t>(i)]);
    CHECK(std::string(item.units) == (i < 2 ? "m s-1" : "m2 s-2"));
    REQUIRE(delos_cap_get_item(driver.cap(0), DELOS_CAP_EXPORT, i, &item) == 0);
    CHECK(std::string(item.name) == kExports[static_cast<std::size_t>(i)]);
  }
  CHECK(delos_cap_get_item(driver.cap(0), DELOS_CAP_IMPORT, 3, &item) == kNotFound);
  CHECK(delos_cap_get_item(driver.cap(0), DELOS_CAP_EXPORT, 3, &item) == kNotFound);
  CHECK(delos_cap_generation(driver.cap(0)) == 0);
}

TEST_CASE("the cap's meshes are one grid on any number of processes") {
  Driver alone(1);
  alone.initialize();
  const Whole whole = put_together(alone);
  const auto area_m2 = alone.gathered("cell_area");
  const auto n_cells = static_cast<std::int32_t>(area_m2.size());
  CHECK(std::abs(sum(area_m2) / (4.0 * kPi * kRadius_m * kRadius_m) - 1.0) < 1e-13);
  CHECK(std::abs(whole.area / (4.0 * kPi) - 1.0) < 1e-13);
  for (const int n_processes : {1, 2, 5}) {
    CAPTURE(n_processes);
    Driver driver(n_processes);
    driver.initialize();
    const Whole parts = put_together(driver);
    CHECK(parts.agree);
    CHECK(parts.elements.size() == area_m2.size());
    CHECK(*parts.elements.begin() == 1);
    CHECK(*parts.elements.rbegin() == n_cells);
    CHECK(parts.node_owner.size() == 2 * area_m2.size() - 4);  // Euler
    CHECK(parts.node_place == whole.node_place);
    bool owners_have_theirs = true;
    for (const auto& [id, owner] : parts.node_owner) {
      owners_have_theirs = owners_have_theirs && parts.node_processes.at(id).count(owner) == 1;
    }
    CHECK(owners_have_theirs);
    for (int i = 0; i < n_processes; ++i) check_elements(driver.mesh(i));
    CHECK(driver.gathered("cell_area") == area_m2);
    CHECK(driver.gathered("grid_generation") == std::vector<double>(area_m2.size(), 1.0));
  }
}

TEST_CASE("the cap's areas and places are those of the C++ grid") {
  Driver driver(2);
  driver.initialize();
  const delos::Grid grid = delos::generate(delos::Config::from_text(kYaml));
  const auto area_m2 = driver.gathered("cell_area");
  const auto spacing_m = driver.gathered("cell_spacing");
  REQUIRE(static_cast<std::int64_t>(area_m2.size()) == grid.n_cells());
  for (std::size_t i = 0; i < area_m2.size(); ++i) {
    REQUIRE(area_m2[i] == grid.cell_area_m2()[i]);
    REQUIRE(spacing_m[i] == grid.cell_spacing_m()[i]);
  }
  const auto mesh = driver.mesh(1);
  const auto cell = static_cast<std::size_t>(mesh.element_ids[0] - 1);
  CHECK(mesh.element_lon_lat_deg[0] ==
        doctest::Approx(grid.cell_lon_lat()[2 * cell] / kRadPerDeg).epsilon(1e-14));
  CHECK(mesh.element_area[0] ==
        doctest::Approx(grid.cell_area_m2()[cell] / (kRadius_m * kRadius_m)).epsilon(1e-14));
}

TEST_CASE("the cap goes from step to step with imports and ends") {
  Driver driver(2);
  driver.initialize();
  const std::vector<double> energy(driver.gathered("cell_area").size(), 0.02);
  for (const int from : {27, 28}) {
    for (int i = 0; i < driver.size(); ++i) {
      REQUIRE(delos_cap_set_import(driver.cap(i), kImports[2], energy.data(),
                                   static_cast<std::int64_t>(energy.size())) == 0);
    }
    driver.advance(day(from), day(from + 1));
  }
  const auto area_m2 = driver.gathered("cell_area");
  for (int i = 0; i < driver.size(); ++i) {
    REQUIRE(delos_cap_finalize(driver.cap(i)) == 0);
    CHECK(delos_cap_generation(driver.cap(i)) == 0);
  }
  // Once more, with the next generation.
  driver.initialize();
  CHECK(delos_cap_generation(driver.cap(0)) == 2);
  CHECK(driver.gathered("cell_area") == area_m2);
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

  Driver driver(1);
  delos_cap* const cap = driver.cap(0);
  delos_cap_mesh mesh = {};
  double value = 0.0;
  const auto says = [&](const char* part) {
    return std::string(delos_cap_message(cap)).find(part) != std::string::npos;
  };
  CHECK(delos_cap_realize(cap, 0, 1) == kNotValid);
  CHECK(says("initialize(advertise)"));
  driver.advertise();
  CHECK(delos_cap_get_mesh(cap, &mesh) == kNotValid);
  CHECK(says("realize"));
  CHECK(delos_cap_realize(cap, 0, 1000000) == kNotValid);
  CHECK(says("processes"));
  CHECK(delos_cap_realize(cap, 1, 1) != 0);
  driver.realize();
  const auto n = driver.mesh(0).n_elements;
  std::vector<double> values(static_cast<std::size_t>(n), 0.0);
  CHECK(delos_cap_get_export(cap, "cell_area", &value, 1) == kNotValid);
  CHECK(delos_cap_get_export(cap, "cell_volume", values.data(), n) == kNotFound);
  CHECK(delos_cap_set_import(cap, "cell_volume", values.data(), n) == kNotFound);
  CHECK(delos_cap_set_import(cap, kImports[0], &value, 1) != 0);
  CHECK(says(kImports[0]));
  driver.advance(day(3), day(4));
  const auto from = day(3), until = day(4);
  CHECK(delos_cap_advance(cap, &from, &until, kGregorian) == kNotValid);
  CHECK(says("2000-02-04"));
  CHECK(delos_cap_advance(cap, &until, &from, kGregorian) != 0);
  CHECK(delos_cap_advance(cap, &from, &until, kNoleap) != 0);
  driver.advance(day(4), day(5));
}
