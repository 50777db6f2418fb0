// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/remesh.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "lifecycle/component.hpp"
#include "support/expect_error.hpp"
#include "support/sample_times.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using delos::samples::at;
using delos::testing::expect_error;

namespace {

/// Waves in the northern hemisphere: the south has no eddies.
constexpr char kConfig[] = R"(
sizing: {sources: [{type: constant, spacing: 1200 km}], gradient_limit: 0.3, resolution: 4 deg,
         clamp: {min: 300 km, max: 2000 km}}
refine: {tile_vertices: 500}
remesh:
  interval: P10D
  sources: [{type: eke, quiet: [0.05 m/s, 1200 km], energetic: [0.5 m/s, 500 km]}]
)";

Settings settings_of(const std::string& more = "") {
  return read_settings(parse_config(kConfig + more, "remesh.yaml"), ".");
}

/// A component with its host: imports are values in the cells.
class Model {
 public:
  explicit Model(const std::string& more = "", int threads = 1, const std::string& restart = "")
      : Model(settings_of(more), threads, restart) {}
  explicit Model(Settings settings, int threads = 1, const std::string& restart = "",
                 const std::atomic<bool>* cancel = nullptr) {
    ComponentOptions options;
    options.threads = threads;
    options.cancel = cancel;
    options.on_log = [this](LogLevel, const std::string& line) { log += line + "\n"; };
    component = std::make_unique<Component>(std::move(settings), options);
    component->advertise();
    restart.empty() ? component->realize()
                    : static_cast<void>(component->read_restart(restart, clock(0)));
  }

  /// The host's clock after so many days.
  Clock clock(int days) const {
    Clock out({.start = start, .step = TimeInterval::of_days(1)});
    for (int day = 0; day < days; ++day) out.advance();
    return out;
  }

  /// A day of eastward velocity +-`amplitude`, northward none.
  void run_day(int day, double amplitude) {
    const Array<Vec3>& places = component->product()->grid->cell_position;
    u.assign(places.size(), 0.0);
    v.assign(places.size(), 0.0);
    for (std::size_t i = 0; i < u.size(); ++i) {
      const double sign = day % 2 == 0 ? 1.0 : -1.0;
      u[i] = places[i].z() > 0.0 ? sign * amplitude : 0.0;
    }
    component->imports()->item("surface_eastward_sea_water_velocity")->bind(u);
    component->imports()->item("surface_northward_sea_water_velocity")->bind(v);
    run_without_values(day);
  }

  void run_without_values(int day) {
    component->run(start + TimeInterval::of_days(day), start + TimeInterval::of_days(day + 1));
  }

  double exported(const std::string& name) const {
    return component->exports()->item(name)->data()[0];
  }

  std::unique_ptr<Component> component;
  std::vector<double> u, v;
  Time start = at("2001-01-01");
  std::string log;
};

constexpr double kStrong = 0.6;  // m/s: variances 0.36 and 0, EKE 0.18 m2/s2, speed 0.6 again

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("a grid follows the eddies of its model at the alarm") {
  Model model;
  const std::int64_t before = model.component->product()->mesh.n_vertices();
  const auto area = model.component->exports()->item("cell_area");
  CHECK(model.exported("remesh_mismatch") == 0.0);
  for (int day = 0; day < 9; ++day) model.run_day(day, kStrong);
  CHECK(model.component->generation() == 1);
  CHECK_FALSE(model.component->decision());
  model.run_day(9, kStrong);

  REQUIRE(model.component->decision());
  const Decision& decision = *model.component->decision();
  CAPTURE(decision.text);
  CHECK(decision.remesh);
  CHECK(decision.mismatch.too_coarse > 0.4);
  CHECK(model.component->remesh_failure().empty());
  CHECK(model.component->generation() == 2);
  CHECK(model.exported("grid_generation") == 2.0);
  CHECK(model.exported("remesh_mismatch") == decision.mismatch.total());
  CHECK(model.exported("remesh_decision") == 1.0);
  CHECK(model.log.find("remesh at 2001-01-11T00:00:00") != std::string::npos);
  const Product& product = *model.component->product();
  CHECK(product.mesh.n_vertices() > 2 * before);
  CHECK(static_cast<double>(product.mesh.n_vertices()) ==
        doctest::Approx(decision.expected_cells).epsilon(0.05));
  // Old handles find out, imports are to be given again, exports are those of the new grid.
  expect_error(ErrorKind::state, {"generation 1", "generation 2"},
               [&] { area->check_generation(1); });
  CHECK(static_cast<std::int64_t>(area->data().size()) == product.grid->n_cells());
  CHECK_FALSE(model.component->imports()->item("surface_eastward_sea_water_velocity")->has_data());

  // The grid fits now: the next alarm decides against.
  for (int day = 10; day < 20; ++day) model.run_day(day, kStrong);
  CHECK(model.component->generation() == 2);
  CHECK_FALSE(model.component->decision()->remesh);
  CHECK(model.exported("remesh_decision") == 0.0);
}

TEST_CASE("a still model keeps its grid, and so does one that gives no values") {
  Model model;
  for (int day = 0; day < 10; ++day) model.run_day(day, 0.0);
  CHECK(model.component->decision()->reasons == std::vector<Reason>{Reason::below_threshold});
  Model silent;
  for (int day = 0; day < 10; ++day) silent.run_without_values(day);
  CHECK(silent.component->decision()->reasons == std::vector<Reason>{Reason::no_statistics});
  CHECK(silent.component->generation() == 1);
}

TEST_CASE("a remesh that fails leaves the grid and its fields, with the reason") {
  // The uniform grid is met by the clamp, a budget of a million cells is not.
  Model model("  cells: 1000000\n  threshold: 0\n");
  const std::string digest = model.component->product()->report.digest;
  for (int day = 0; day < 10; ++day) model.run_day(day, kStrong);
  CHECK(model.component->generation() == 1);
  CHECK(model.component->product()->report.digest == digest);
  CHECK(model.component->remesh_failure().find("the grid stays") != std::string::npos);
  CHECK(model.component->remesh_failure().find("budget") != std::string::npos);
  CHECK(model.exported("remesh_decision") == -1.0);
  CHECK(model.component->imports()->item("surface_eastward_sea_water_velocity")->has_data());
  model.run_day(10, kStrong);
}

TEST_CASE("a value that is no number stops a run before anything changes") {
  Model model;
  model.run_day(0, kStrong);
  model.u[17] = std::nan("");
  expect_error(ErrorKind::input,
               {"surface_eastward_sea_water_velocity", "nan", "cell 17", "lon", "lat"},
               [&] { model.run_without_values(1); });
  CHECK(model.component->clock()->current() == model.start + TimeInterval::of_days(1));
  model.run_day(1, kStrong);
}

TEST_CASE("a budget is met within 1 % whatever is kept") {
  // The uniform grid of the start has some 410 cells; half of it may stay where the budget lets the
  // still south keep a spacing within tau.
  const std::string fixed =
      "  fixed: [{type: box, west: 0 deg, east: 120 deg, south: -60 deg, north: 60 deg}]\n";
  struct Case {
    int cells;
    std::string more;
  };
  const std::vector<Case> cases = {{900, ""}, {1100, "  tau: 1.1\n"}, {1300, fixed}, {1500, ""}};
  for (const Case& one : cases) {
    CAPTURE(one.cells);
    CAPTURE(one.more);
    Model model(text("  cells: ", one.cells, "\n", one.more));
    for (int day = 0; day < 10; ++day) model.run_day(day, kStrong);
    CAPTURE(model.component->remesh_failure());
    CAPTURE(model.log);
    REQUIRE(model.component->generation() == 2);
    const auto n = static_cast<double>(model.component->product()->mesh.n_vertices());
    CHECK(std::abs(n - one.cells) <= 0.01 * one.cells);
    // The second remesh, of a graded grid that has moved, too.
    for (int day = 10; day < 20; ++day) model.run_day(day, 0.3);
    const auto again = static_cast<double>(model.component->product()->mesh.n_vertices());
    CHECK(std::abs(again - one.cells) <= 0.01 * one.cells);
  }
}

namespace {

/// Degrees from -180 to 180.
double lon_deg_of(const LonLat& place) {
  const double lon_deg = place.lon_rad * kDegPerRad;
  return lon_deg > 180.0 ? lon_deg - 360.0 : lon_deg;
}

/// A host that gives one field of values in the cells, of its own making.
template <class Value>
void run_with(Model& model, int day, const std::string& name, const Value& value) {
  const Array<LonLat>& places = model.component->product()->grid->cell_lon_lat;
  model.u.assign(places.size(), 0.0);
  for (std::size_t i = 0; i < model.u.size(); ++i) {
    model.u[i] = value(lon_deg_of(places[i]), places[i].lat_rad * kDegPerRad);
  }
  model.component->imports()->item(name)->bind(model.u);
  model.run_without_values(day);
}

/// Cells whose generators lie in a box.
std::int64_t cells_in(const Model& model, double west, double east, double south, double north) {
  std::int64_t n = 0;
  for (const LonLat& place : model.component->product()->grid->cell_lon_lat) {
    const double lon = lon_deg_of(place), lat = place.lat_rad * kDegPerRad;
    if (lon > west && lon < east && lat > south && lat < north) ++n;
  }
  return n;
}

Settings with_sources(const std::string& sources) {
  const std::string all = kConfig;
  return read_settings(parse_config(all.substr(0, all.find("  sources: [{type: eke")) +
                                        "  sources: [" + sources + "]\n",
                                    "remesh.yaml"),
                       ".");
}

}  // namespace

TEST_CASE("the variability of the sea surface makes the grid fine from YAML on") {
  Model model(
      with_sources("{type: ssh_variability, form: threshold, threshold: 0.1 m, "
                   "spacing_below: 1200 km, spacing_above: 500 km}"));
  const std::int64_t before = cells_in(model, -60, 60, 0, 60);
  for (int day = 0; day < 10; ++day) {
    run_with(model, day, "sea_surface_height_above_geoid", [&](double lon, double lat) {
      const bool is_lively = std::abs(lon) < 60.0 && lat > 0.0 && lat < 60.0;
      return 0.5 + (is_lively ? (day % 2 == 0 ? 0.3 : -0.3) : 0.0);
    });
  }
  REQUIRE(model.component->generation() == 2);
  CHECK(cells_in(model, -60, 60, 0, 60) > 2 * before);
}

TEST_CASE("the gradient of vorticity makes the grid fine from YAML on") {
  Model model(
      with_sources("{type: vorticity_gradient, quiet: [1e-14, 1200 km], "
                   "energetic: [1e-13, 500 km]}"));
  const std::int64_t before = cells_in(model, -180, 180, 0, 60);
  for (int day = 0; day < 10; ++day) {
    const Array<LonLat>& places = model.component->product()->grid->cell_lon_lat;
    model.v.assign(places.size(), 0.0);
    model.component->imports()->item("surface_northward_sea_water_velocity")->bind(model.v);
    // A jet in the north: its vorticity changes sign over some 20 degrees.
    run_with(model, day, "surface_eastward_sea_water_velocity", [](double, double lat) {
      const double d = (lat - 30.0) / 15.0;
      return std::exp(-d * d);
    });
  }
  REQUIRE(model.component->generation() == 2);
  CHECK(cells_in(model, -180, 180, 0, 60) > 2 * before);
}

TEST_CASE("the host's own spacing is taken as it is") {
  const std::string source = "{type: wanted_spacing, missing: 900 km}";
  // Farther from the 1200 km of the start than tau everywhere: within it the old spacing stays.
  const auto wanted = [](double, double lat) { return lat > 0.0 ? 450e3 : 900e3; };
  Model model(with_sources(source));
  for (int day = 0; day < 10; ++day) run_with(model, day, "wanted_spacing", wanted);
  REQUIRE(model.component->generation() == 2);
  const SpacingField& spacing = model.component->product()->spacing;
  const double scale_m = model.component->product()->settings.surface.scale_m();
  CHECK(spacing.at(0.0, 0.6, 0.8) * scale_m == doctest::Approx(450e3).epsilon(0.01));
  CHECK(spacing.at(0.0, 0.6, -0.8) * scale_m == doctest::Approx(900e3).epsilon(0.01));

  // On the host's own table, where a value may be missing.
  Model gridded(with_sources(source));
  LatLonAxes axes;
  for (double lon = 0.0; lon < 360.0; lon += 5.0) axes.lon_deg.push_back(lon);
  for (double lat = 87.5; lat > -90.0; lat -= 5.0) axes.lat_deg.push_back(lat);
  std::vector<double> values;
  for (const double lat : axes.lat_deg) {
    for (const double lon : axes.lon_deg) {
      values.push_back(lat < -40.0 ? std::nan("") : wanted(lon, lat));
    }
  }
  for (int day = 0; day < 10; ++day) {
    const auto item = gridded.component->imports()->item("wanted_spacing");
    item->place_on(axes);
    item->bind(values);
    gridded.run_without_values(day);
  }
  REQUIRE(gridded.component->generation() == 2);
  CHECK(gridded.component->product()->spacing.at(0.0, 0.6, 0.8) * scale_m ==
        doctest::Approx(450e3).epsilon(0.01));
  // What is no spacing leaves the grid.
  Model wrong(with_sources(source));
  for (int day = 0; day < 10; ++day) {
    run_with(wrong, day, "wanted_spacing",
             [](double, double lat) { return lat > 0.0 ? -5.0 : 1e6; });
  }
  CHECK(wrong.component->generation() == 1);
  CHECK(wrong.component->remesh_failure().find("wanted_spacing") != std::string::npos);
}

TEST_CASE("what lies upstream of the eddies becomes fine when it is asked for") {
  const auto cells_upstream = [](const std::string& more) {
    Model model(
        with_sources("{type: eke, form: threshold, threshold: 0.2 m/s, spacing_below: "
                     "1200 km, spacing_above: 500 km" +
                     more + "}"));
    for (int day = 0; day < 10; ++day) {
      const Array<LonLat>& places = model.component->product()->grid->cell_lon_lat;
      model.v.assign(places.size(), 0.0);
      for (std::size_t i = 0; i < model.v.size(); ++i) {
        const double lon = places[i].lon_rad * kDegPerRad, lat = places[i].lat_rad * kDegPerRad;
        const bool is_lively = lon > 0.0 && lon < 60.0 && std::abs(lat) < 30.0;
        model.v[i] = is_lively ? (day % 2 == 0 ? 2.0 : -2.0) : 0.0;
      }
      model.component->imports()->item("surface_northward_sea_water_velocity")->bind(model.v);
      run_with(model, day, "surface_eastward_sea_water_velocity",
               [](double, double) { return 0.5; });
    }
    REQUIRE(model.component->generation() == 2);
    return std::pair(cells_in(model, -50, -15, -25, 25), cells_in(model, 75, 110, -25, 25));
  };
  const auto plain = cells_upstream("");
  const auto spread = cells_upstream(", upstream: {length: 6000 km}");
  CHECK(spread.first > 2 * plain.first);
  CHECK(spread.second < 1.3 * static_cast<double>(plain.second));
}

TEST_CASE("a polygon from a file stays, and is missed at the start when it is not there") {
  const testing::TemporaryFolder folder;
  std::ofstream(folder.file("regions.geojson"))
      << R"({"type": "Feature", "properties": {"name": "box"}, "geometry": {"type": "Polygon",
           "coordinates": [[[0, 20], [60, 20], [60, 70], [0, 70], [0, 20]]]}})";
  const auto more = [&](const std::string& name) {
    return text("  fixed: [{type: polygon, file: ", folder.file(name), "}]\n");
  };
  Model model(more("regions.geojson"));
  const Grid before = *model.component->product()->grid;
  std::filesystem::remove(folder.file("regions.geojson"));  // it has been read
  for (int day = 0; day < 10; ++day) model.run_day(day, kStrong);
  REQUIRE(model.component->generation() == 2);
  const Grid& after = *model.component->product()->grid;
  int n_held = 0;
  for (std::size_t i = 0; i < before.cell_position.size(); ++i) {
    const double lon = before.cell_lon_lat[i].lon_rad * kDegPerRad;
    const double lat = before.cell_lon_lat[i].lat_rad * kDegPerRad;
    if (!(lon > 0.0 && lon < 60.0 && lat > 20.0 && lat < 70.0)) continue;
    ++n_held;
    CHECK(std::find(after.cell_position.begin(), after.cell_position.end(),
                    before.cell_position[i]) != after.cell_position.end());
  }
  CHECK(n_held > 10);
  expect_error(ErrorKind::input, {"remesh.fixed.0.file", "nowhere.geojson"},
               [&] { Model missing(more("nowhere.geojson")); });
}

TEST_CASE("whatever fails at a remesh leaves grid, fields and statistics") {
  struct Case {
    std::string more, reason;
  };
  // A certificate that the uniform grid has and the graded one misses; a fixed region that holds
  // about as many cells as the budget.
  Model free;
  const double before = free.component->product()->report.quality.grading_max.value;
  for (int day = 0; day < 10; ++day) free.run_day(day, kStrong);
  const double after = free.component->product()->report.quality.grading_max.value;
  REQUIRE(after > before);
  const std::vector<Case> cases = {
      {text("require: {grading_max: ", 0.5 * (before + after), "}\n"), "grading_max"},
      {"  cells: 215\n  threshold: 0\n"
       "  fixed: [{type: box, west: -180 deg, east: 180 deg, south: -90 deg, north: 0 deg}]\n",
       "fixed regions"}};
  for (const Case& one : cases) {
    CAPTURE(one.reason);
    Model model(one.more);
    const auto product = model.component->product();
    const auto area = model.component->exports()->item("cell_area");
    for (int day = 0; day < 10; ++day) model.run_day(day, kStrong);
    CAPTURE(model.component->remesh_failure());
    CHECK(model.component->remesh_failure().find(one.reason) != std::string::npos);
    CHECK(model.component->product() == product);
    CHECK(model.component->generation() == 1);
    CHECK(area->data().data() == product->grid->cell_area_m2.data());
    CHECK(model.exported("remesh_decision") == -1.0);
    model.run_day(10, kStrong);
  }
}

TEST_CASE("a request to stop leaves the grid, and the next alarm tries again") {
  std::atomic<bool> cancel = false;
  Model model(settings_of(), 1, "", &cancel);
  for (int day = 0; day < 9; ++day) model.run_day(day, kStrong);
  cancel = true;
  model.run_day(9, kStrong);
  CHECK(model.component->generation() == 1);
  CHECK_FALSE(model.component->remesh_failure().empty());
  cancel = false;
  for (int day = 10; day < 20; ++day) model.run_day(day, kStrong);
  CHECK(model.component->generation() == 2);
  CHECK(model.component->remesh_failure().empty());
}

TEST_CASE("the remeshed grid has the same bits for any number of threads") {
  std::string expected;
  for (const int threads : {1, 2, 5}) {
    Model model("", threads);
    for (int day = 0; day < 10; ++day) model.run_day(day, kStrong);
    const std::string digest = model.component->product()->report.digest;
    if (threads == 1) expected = digest;
    CHECK(digest == expected);
  }
}

TEST_CASE("a restart before or after a remesh goes on to the same bytes") {
  constexpr int kDays = 22;
  for (const char* const window :
       {"{window: exponential, length: 4 d}", "{window: fixed, length: 3 d}"}) {
    CAPTURE(std::string(window));
    const std::string more = text("  statistics: ", window, "\n");
    const testing::TemporaryFolder folder;
    const std::string end = folder.file("end.nc");
    Model straight(more);
    for (int day = 0; day < kDays; ++day) {
      if (day == 7 || day == 15) {
        straight.component->write_restart(folder.file(text(day, ".nc")), straight.clock(day));
      }
      straight.run_day(day, day < 12 ? kStrong : 0.02);
    }
    CHECK(straight.component->generation() == 3);
    straight.component->write_restart(end, straight.clock(kDays));
    for (const int begin : {7, 15}) {
      Model restarted(more, 2, folder.file(text(begin, ".nc")));
      CHECK(restarted.exported("remesh_decision") == (begin < 10 ? 0.0 : 1.0));
      for (int day = begin; day < kDays; ++day) {
        restarted.run_day(day, day < 12 ? kStrong : 0.02);
      }
      const std::string again = folder.file("again.nc");
      restarted.component->write_restart(again, restarted.clock(kDays));
      CHECK(bytes_of(again) == bytes_of(end));
    }
  }
}

TEST_CASE("fixed regions stay while the rest is made anew") {
  Model model("  fixed: [{type: disc, centre: [20 deg, 50 deg], radius: 20 deg}]\n");
  const Grid before = *model.component->product()->grid;
  for (int day = 0; day < 10; ++day) model.run_day(day, kStrong);
  REQUIRE(model.component->generation() == 2);
  const Grid& after = *model.component->product()->grid;
  parallel::Executor exec(1);
  const std::vector<FixedRegion> region{FixedDisc{20.0, 50.0, 20.0 * kRadPerDeg}};
  const auto held = in_fixed_regions(exec, region, before.cell_lon_lat);
  int n_held = 0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i] == 0) continue;
    ++n_held;
    const bool is_there = std::any_of(after.cell_position.begin(), after.cell_position.end(),
                                      [&](const Vec3& p) { return p == before.cell_position[i]; });
    CHECK(is_there);
  }
  CHECK(n_held > 3);
}
