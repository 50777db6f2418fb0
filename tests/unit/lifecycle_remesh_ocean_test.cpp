// SPDX-License-Identifier: BSD-3-Clause
// The grid of an ocean that follows its model.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "dual/digest.hpp"
#include "lifecycle/whole_grid.hpp"
#include "support/expect_error.hpp"
#include "support/remesh_model.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using delos::samples::kStrong;
using delos::samples::RemeshModel;
using delos::testing::expect_error;

namespace {

/// A continent from 0 to 90 degrees east, 60 south to 60 north.
constexpr double kEast_deg = 90.0, kNorth_deg = 60.0;
constexpr char kLand[] = R"({"type": "FeatureCollection", "features": [{"type": "Feature",
"properties": {"name": "continent"}, "geometry": {"type": "Polygon", "coordinates":
[[[0, -60], [30, -60], [60, -60], [90, -60], [90, 0], [90, 60], [60, 60], [30, 60], [0, 60], [0, 0], [0, -60]]]}}]})";

/// Settings of the model's ocean, with the file of its land.
class OceanFiles {
 public:
  OceanFiles() { std::ofstream(folder_.file("land.geojson")) << kLand; }
  Settings settings(const std::string& more = "") const {
    const std::string text =
        std::string(samples::kRemeshConfig) + more + "domain: {land: {file: land.geojson}}\n";
    return read_settings(parse_config(text, "ocean.yaml"), folder_.file("."));
  }
  std::string file(const std::string& name) const { return folder_.file(name); }

 private:
  testing::TemporaryFolder folder_;
};

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::set<std::vector<double>> places_of(const Grid& grid) {
  std::set<std::vector<double>> out;
  for (const Vec3& p : grid.cell_position) out.insert({p.x(), p.y(), p.z()});
  return out;
}

/// Strong eddies at first, weak ones later.
void run_days(RemeshModel& model, int begin, int end) {
  for (int day = begin; day < end; ++day) model.run_day(day, day < 12 ? kStrong : 0.02);
}

/// The model's day, its velocities on a table of the host's.
void run_day_on_table(RemeshModel& model, int day, double amplitude) {
  model.u.assign(8, 0.0);
  model.u.resize(16, day % 2 == 0 ? amplitude : -amplitude);
  model.v.assign(16, 0.0);
  for (const auto& [name, values] : {std::pair("surface_eastward_sea_water_velocity", &model.u),
                                     std::pair("surface_northward_sea_water_velocity", &model.v)}) {
    const auto field = model.component->imports()->item(name);
    field->place_on({{0.0, 90.0, 180.0, 270.0}, {-60.0, -20.0, 20.0, 60.0}});
    field->bind(*values);
  }
  model.run_without_values(day);
}

}  // namespace

TEST_CASE("the grid of an ocean follows the eddies of its model") {
  const OceanFiles files;
  RemeshModel model(files.settings());
  const auto first = model.component->product();
  REQUIRE(first->domain);
  CHECK(first->grid->n_cells() < first->mesh.n_vertices());
  run_days(model, 0, 10);
  CAPTURE(model.log);
  CHECK(model.component->remesh_failure().empty());
  REQUIRE(model.component->generation() == 2);
  const auto second = model.component->product();
  REQUIRE(second->domain);
  CHECK(second->grid->n_cells() > first->grid->n_cells());
  CHECK(second->grid->n_cells() < second->mesh.n_vertices());
  for (const LonLat& place : second->grid->cell_lon_lat) {
    constexpr double kMargin_deg = 6.0;
    const double lon_deg = place.lon_rad * kDegPerRad, lat_deg = place.lat_rad * kDegPerRad;
    CHECK_FALSE((lon_deg > kMargin_deg && lon_deg < kEast_deg - kMargin_deg &&
                 std::abs(lat_deg) < kNorth_deg - kMargin_deg));
  }
  // The quiet south keeps its cells.
  const auto before = places_of(*first->grid), after = places_of(*second->grid);
  std::size_t n_same = 0;
  for (const auto& place : before) n_same += after.count(place);
  CHECK(n_same > before.size() / 4);
  // The statistics have come along: when the eddies are gone the grid becomes coarse again.
  run_days(model, 10, 40);
  CHECK(model.component->remesh_failure().empty());
  CHECK(model.component->generation() >= 3);
  CHECK(model.component->product()->grid->n_cells() < second->grid->n_cells());
}

TEST_CASE("an ocean's remesh and restart have the same bits for any number of threads") {
  const OceanFiles files;
  const std::string more = "  statistics: {window: exponential, length: 4 d}\n";
  constexpr int kDays = 12;
  RemeshModel straight(files.settings(more));
  run_days(straight, 0, 7);
  straight.component->write_restart(files.file("7.nc"), straight.clock(7));
  run_days(straight, 7, 11);
  straight.component->write_restart(files.file("11.nc"), straight.clock(11));
  run_days(straight, 11, kDays);
  CHECK(straight.component->generation() == 2);
  straight.component->write_restart(files.file("end.nc"), straight.clock(kDays));
  for (const int begin : {7, 11}) {
    RemeshModel restarted(files.settings(more), 5, files.file(text(begin, ".nc")));
    run_days(restarted, begin, kDays);
    restarted.component->write_restart(files.file("again.nc"), restarted.clock(kDays));
    CHECK(bytes_of(files.file("again.nc")) == bytes_of(files.file("end.nc")));
  }
}

TEST_CASE("the vorticity of an ocean with coasts makes its grid fine") {
  const OceanFiles files;
  Settings settings = files.settings();
  settings.remesh = read_settings(parse_config(R"(
sizing: {sources: [{type: constant, spacing: 1200 km}], clamp: {min: 300 km, max: 2000 km}}
remesh:
  interval: P10D
  sources: [{type: vorticity_gradient, quiet: [1e-13, 1200 km], energetic: [1e-12, 600 km], fill: 0}]
)",
                                               "vorticity.yaml"),
                                  ".")
                        .remesh;
  RemeshModel model(std::move(settings));
  run_days(model, 0, 10);
  CAPTURE(model.log);
  CHECK(model.component->remesh_failure().empty());
  CHECK(model.component->generation() == 2);
}

TEST_CASE("an ocean's whole grid is made at an alarm only where it is needed") {
  struct Case {
    bool on_table, has_eddies;
    std::int64_t n_duals, n_transfers;  // one of the duals is the new grid's own
  };
  const OceanFiles files;
  for (const Case& one : {Case{true, false, 0, 0}, Case{true, true, 2, 0}, Case{false, false, 1, 0},
                          Case{false, true, 3, 1}}) {
    CAPTURE(one.on_table);
    CAPTURE(one.has_eddies);
    RemeshModel model(files.settings("  statistics: {window: exponential, length: 4 d}\n"));
    for (int day = 0; day < 10; ++day) {
      model.phases.clear();  // but for the alarm's
      const double amplitude = one.has_eddies ? kStrong : 0.01;
      one.on_table ? run_day_on_table(model, day, amplitude) : model.run_day(day, amplitude);
    }
    CHECK(model.component->remesh_failure().empty());
    REQUIRE(model.component->decision());
    CHECK(model.component->generation() == (one.has_eddies ? 2 : 1));
    const auto& phases = model.phases;
    CHECK(std::count(phases.begin(), phases.end(), "dual") == one.n_duals);
    CHECK(std::count(phases.begin(), phases.end(), "transfer") == one.n_transfers);
  }
}

TEST_CASE("values of an ocean's cells come to all cells and back") {
  const OceanFiles files;
  const RemeshModel model(files.settings());
  const Product& product = *model.component->product();
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  WholeGrid whole(context, product);
  REQUIRE(whole.is_culled());
  CHECK(whole.grid().n_cells() == product.mesh.n_vertices());
  const auto n = static_cast<std::size_t>(product.grid->n_cells());
  std::vector<double> values(n), back(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = product.grid->cell_position[i].z();
  const Array<double> spread = whole.spread(values), flooded = whole.flooded(values);
  const auto n_without =
      std::count_if(spread.begin(), spread.end(), [](double value) { return std::isnan(value); });
  CHECK(n_without == whole.grid().n_cells() - product.grid->n_cells());
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  for (std::size_t i = 0; i < flooded.size(); ++i) {
    CHECK(flooded[i] >= *least);
    CHECK(flooded[i] <= *most);
    if (!std::isnan(spread[i])) CHECK(flooded[i] == spread[i]);
  }
  whole.pick(flooded, back);
  CHECK(back == values);
}

TEST_CASE("cells moved to the coast and a remesh exclude each other") {
  expect_error(ErrorKind::config, {"domain", "fit_coast", "remesh"}, [] {
    const OceanFiles files;
    const std::string text = std::string(samples::kRemeshConfig) +
                             "domain: {land: {file: land.geojson}, fit_coast: true}\n";
    static_cast<void>(read_settings(parse_config(text, "ocean.yaml"), files.file(".")));
  });
}
