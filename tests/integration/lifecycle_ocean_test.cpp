// SPDX-License-Identifier: BSD-3-Clause
// The oceans of published recipes, from the files of config/ and real data, where the machine has
// them.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cstdlib>
#include <filesystem>
#include <numeric>

#include "dual/validate.hpp"
#include "io/geojson.hpp"
#include "lifecycle/config_file.hpp"
#include "support/products.hpp"

using namespace delos;
using delos::testing::made;
using delos::testing::value_of;

namespace {

namespace fs = std::filesystem;

const std::string kEtopo5 = "/usr/share/ferret-vis/data/etopo5.cdf";

std::string test_data(const std::string& name) {
  const char* folder = std::getenv("DELOS_TEST_DATA");
  std::string path = std::string(folder == nullptr ? "" : folder) + "/" + name;
  if (fs::exists(path)) return path;
  MESSAGE("skipped: no " << name << " (set DELOS_TEST_DATA)");
  return "";
}

bool has_etopo5() {
  if (fs::exists(kEtopo5)) return true;
  MESSAGE("skipped: no " << kEtopo5 << " (install ferret-datasets)");
  return false;
}

/// A configuration of config/ with changes, without its pictures.
Product made_from(const std::string& name,
                  const std::vector<std::pair<std::string, std::string>>& changes) {
  ConfigFile file = read_config_file(DELOS_SOURCE_DIR "/config/" + name);
  for (const auto& [key, value] : changes) override_config(file.root, key, value);
  override_config(file.root, "output.pictures", "[]");
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  return generate(context, read_settings(file.root, file.folder), {});
}

std::string lines_of(const std::string& path, const std::string& tag) {
  return "{file: " + path + ", select: " + tag + "}";
}

double mean_edge_m(const Grid& grid) {
  const auto& lengths = grid.cell_distance_m;
  return std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
}

// On which side of the plane through a, b and the centre.
bool is_left(const Vec3& a, const Vec3& b, const Vec3& p) { return a.cross(b).dot(p) > 0.0; }

bool do_cross(const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
  return is_left(a, b, p) != is_left(a, b, q) && is_left(p, q, a) != is_left(p, q, b) &&
         a.dot(p) > 0.0;
}

/// Neighbouring cells whose centres are joined across the line: what flows through it.
std::int64_t n_links_across(const Grid& grid, const LonLatLine& line) {
  std::int64_t n = 0;
  for (std::size_t i = 0; i + 1 < line.lon_deg.size(); ++i) {
    const auto point = [&](std::size_t k) {
      return grid.surface.point({line.lon_deg[k] * kRadPerDeg, line.lat_deg[k] * kRadPerDeg},
                                grid.latitude);
    };
    const Vec3 p = point(i), q = point(i + 1);
    for (const auto& [a, b] : grid.cells_on_edge) {
      if (b == kNone) continue;
      n += do_cross(grid.cell_position[at(a)], grid.cell_position[at(b)], p, q);
    }
  }
  return n;
}

}  // namespace

TEST_CASE("Natural Earth's land makes the ocean of the bathymetry within 1 %, passages open") {
  const std::string transects = test_data("mpas_transects_passages.geojson");
  const std::string polygons = test_data("land_ne110m.geojson");
  if (transects.empty() || polygons.empty() || !has_etopo5()) return;
  const std::string yaml =
      "sizing: {sources: [{type: constant, spacing: 120 km}]}\ndomain: {passages: " +
      lines_of(transects, "Critical_Passage") +
      ", blockages: " + lines_of(transects, "Critical_Land_Blockage");
  const Product land = made(yaml + ", land: {file: " + polygons + "}}\n", 2);
  const Product sea = made(yaml + "}\n", 2);
  const auto of = [](const Product& product, const char* key) {
    return static_cast<double>(value_of<std::int64_t>(product.report, "domain", key));
  };
  CHECK(of(land, "n_passages_open") == 19);
  CHECK(of(land, "n_blockages_shut") == 21);
  CHECK(of(land, "n_cells") == doctest::Approx(of(sea, "n_cells")).epsilon(0.01));
  CHECK(value_of<double>(land.report, "domain", "area_m2") ==
        doctest::Approx(value_of<double>(sea.report, "domain", "area_m2")).epsilon(0.01));
}

TEST_CASE("the world ocean at 60 km: passages open, blockages shut, cells and area within 1 %") {
  const std::string transects = test_data("mpas_transects_passages.geojson");
  if (transects.empty() || !has_etopo5()) return;
  const Product product =
      made_from("world_ocean_60km.yaml",
                {{"domain.passages", lines_of(transects, "Critical_Passage")},
                 {"domain.blockages", lines_of(transects, "Critical_Land_Blockage")}});
  const Report& report = product.report;
  CHECK(value_of<std::int64_t>(report, "domain", "n_passages") == 19);
  CHECK(value_of<std::int64_t>(report, "domain", "n_passages_open") == 19);
  CHECK(value_of<std::int64_t>(report, "domain", "n_blockages") == 21);
  CHECK(value_of<std::int64_t>(report, "domain", "n_blockages_shut") == 21);
  for (const LonLatLine& line : read_lines(transects, "Critical_Land_Blockage")) {
    CAPTURE(line.name);
    CHECK(n_links_across(*product.grid, line) == 0);
  }
  CHECK(value_of<double>(report, "domain", "area_m2") == doctest::Approx(358.9e12).epsilon(0.01));
  CHECK(static_cast<double>(product.grid->n_cells()) == doctest::Approx(115.0e3).epsilon(0.01));
  CHECK(mean_edge_m(*product.grid) == doctest::Approx(60.0e3).epsilon(0.002));
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  CHECK(check_grid(context, *product.grid, 1e-9).empty());
}

TEST_CASE("the world ocean at 60 km as it is shipped has its inner seas, within 1 %") {
  if (!has_etopo5()) return;
  const Product product = made_from("world_ocean_60km.yaml", {});
  CHECK(value_of<std::string>(product.report, "domain", "passages_not_open").empty());
  CHECK(value_of<std::string>(product.report, "domain", "blockages_not_shut").empty());
  CHECK(value_of<double>(product.report, "domain", "area_m2") ==
        doctest::Approx(358.9e12).epsilon(0.01));
  const Grid& grid = *product.grid;
  CHECK(static_cast<double>(grid.n_cells()) == doctest::Approx(115.0e3).epsilon(0.01));
  struct Sea {
    const char* name;
    double lon_deg, lat_deg;
  };
  for (const Sea& sea :
       {Sea{"Mediterranean", 18.0, 35.0}, Sea{"Adriatic", 15.0, 43.2}, Sea{"Black Sea", 34.0, 43.0},
        Sea{"Sea of Azov", 36.6, 46.2}, Sea{"Red Sea", 38.0, 21.0}, Sea{"Persian Gulf", 51.5, 27.0},
        Sea{"Baltic", 19.5, 56.5}, Sea{"Bothnian Sea", 19.5, 62.0}, Sea{"White Sea", 38.3, 65.3},
        Sea{"Hudson Bay", -85.0, 59.0}, Sea{"Foxe Basin", -78.5, 67.5},
        Sea{"Sea of Japan", 135.0, 40.0}}) {
    CAPTURE(sea.name);
    const Vec3 point =
        grid.surface.point({sea.lon_deg * kRadPerDeg, sea.lat_deg * kRadPerDeg}, grid.latitude);
    double nearest = 1.0;
    for (const Vec3& cell : grid.cell_position) nearest = std::min(nearest, (cell - point).norm());
    CHECK(nearest * grid.surface.scale_m() < 40.0e3);  // the corner of a cell is 35 km from it
  }
  for (const LonLatLine& line :
       read_lines(DELOS_SOURCE_DIR "/config/straits.geojson", "blockage")) {
    CAPTURE(line.name);
    CHECK(n_links_across(grid, line) == 0);
  }
}

TEST_CASE("uniform grids have the ocean cells of published meshes within 3 %") {
  if (!has_etopo5()) return;
  struct Recipe {
    std::string spacing;
    double n_ocean;
  };
  for (const Recipe& recipe : {Recipe{"240 km", 7.2e3}, Recipe{"120 km", 28.8e3}}) {
    CAPTURE(recipe.spacing);
    const Product product = made(
        "sizing: {sources: [{type: constant, spacing: " + recipe.spacing + "}]}\ndomain: {}\n", 2);
    CHECK(static_cast<double>(product.grid->n_cells()) ==
          doctest::Approx(recipe.n_ocean).epsilon(0.03));
  }
}

TEST_CASE("latitude profiles have the ocean cells of published meshes within 3 %") {
  if (!has_etopo5()) return;
  struct Recipe {
    const char* file;
    std::int64_t n_whole;
    double n_ocean;
    std::int64_t reduction;
  };
  // The published numbers of cells, with and without land, and what they are divided by here.
  for (const Recipe& recipe : {Recipe{"ec60to30.yaml", 327000, 235.0e3, 16},
                               Recipe{"rrs30to10.yaml", 2180000, 1.44e6, 64}}) {
    CAPTURE(recipe.file);
    const Product product = made_from(
        recipe.file, {{"sizing.cells", std::to_string(recipe.n_whole / recipe.reduction)}});
    CHECK(static_cast<double>(product.grid->n_cells()) ==
          doctest::Approx(recipe.n_ocean / static_cast<double>(recipe.reduction)).epsilon(0.03));
  }
}

TEST_CASE("spacing by eddies has the ocean cells of its recipe within 3 %") {
  const std::string eke = test_data("eke_mean_1993-2022_0p25.nc");
  if (eke.empty() || !has_etopo5()) return;
  const Product product =
      made_from("eke.yaml", {{"sizing.sources.0.file", eke},
                             {"sizing.sources.0.quiet", "[0.05 m/s, 240 km]"},
                             {"sizing.sources.0.energetic", "[0.45 m/s, 40 km]"},
                             {"sizing.clamp", "{min: 40 km, max: 240 km}"},
                             {"bathymetry", "{file: auto}"},
                             {"domain", "{bodies: largest}"}});
  CHECK(static_cast<double>(product.grid->n_cells()) == doctest::Approx(29.0e3).epsilon(0.03));
}
