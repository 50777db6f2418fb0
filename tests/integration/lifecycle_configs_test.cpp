// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "core/error.hpp"
#include "lifecycle/config_file.hpp"
#include "lifecycle/generate.hpp"
#include "triangulation/validate.hpp"

using namespace delos;

namespace {

namespace fs = std::filesystem;

const fs::path kConfigs = fs::path(DELOS_SOURCE_DIR) / "config";

struct Override {
  const char *key, *value;
};

/// What makes each configuration small: a few thousand cells.
const std::map<std::string, std::vector<Override>>& reductions() {
  static const std::vector<Override> kCoarse = {{"sizing.cells", "4000"},
                                                {"sizing.resolution", "2 deg"}};
  static const std::map<std::string, std::vector<Override>> kReductions = {
      {"coast.yaml",
       {{"sizing.sources.0.spacing", "200 km"},
        {"sizing.sources.0.max", "700 km"},
        {"sizing.resolution", "1 deg"}}},
      {"cubed_sphere.yaml", {{"spacing", "500 km"}}},
      {"defaults.yaml", {{"sizing.sources.0.spacing", "500 km"}}},
      {"ec60to30.yaml", kCoarse},
      {"eke.yaml",
       {{"sizing.sources.0.quiet", "[0.05 m/s, 600 km]"},
        {"sizing.sources.0.energetic", "[0.45 m/s, 150 km]"},
        {"sizing.clamp", "{min: 150 km, max: 600 km}"},
        {"sizing.resolution", "1 deg"}}},
      {"icosahedral.yaml", {{"subdivisions", "16"}}},
      {"patch_150to15km.yaml",
       {{"sizing.sources.0.spacing", "150 km"},
        {"sizing.sources.0.outside", "700 km"},
        {"sizing.resolution", "1 deg"}}},
      {"quasi_uniform_240km.yaml", {{"sizing.sources.0.spacing", "500 km"}}},
      {"quasi_uniform_120km.yaml", {{"sizing.sources.0.spacing", "450 km"}}},
      {"quasi_uniform_60km.yaml", {{"sizing.sources.0.spacing", "400 km"}}},
      {"quasi_uniform_30km.yaml", {{"sizing.sources.0.spacing", "350 km"}}},
      {"regional_10km.yaml", {{"sizing.sources.0.spacing", "80 km"}}},
      {"rossby.yaml",
       {{"sizing.clamp", "{min: 200 km, max: 700 km}"},
        {"sizing.sources.0.factor", "10"},
        {"sizing.land.spacing", "700 km"},
        {"sizing.resolution", "1 deg"}}},
      {"rrs30to10.yaml", kCoarse},
      {"slope.yaml",
       {{"sizing.clamp", "{min: 200 km, max: 700 km}"},
        {"sizing.land.spacing", "700 km"},
        {"sizing.resolution", "1 deg"}}},
      {"triaxial_120km.yaml", {{"sizing.sources.0.spacing", "500 km"}}},
      {"wgs84_60km.yaml", {{"sizing.sources.0.spacing", "400 km"}}},
      {"world_ocean_60km.yaml", {{"sizing.sources.0.spacing", "400 km"}}},
      {"world_ocean.yaml",
       {{"sizing.clamp", "{min: 200 km, max: 700 km}"},
        {"sizing.sources.1.spacing", "200 km"},
        {"sizing.sources.1.max", "700 km"},
        {"sizing.land.spacing", "700 km"},
        {"sizing.resolution", "1 deg"}}}};
  return kReductions;
}

Settings reduced(const std::string& name) {
  ConfigFile file = read_config_file((kConfigs / name).string());
  static_cast<void>(read_settings(file.root, file.folder));  // valid as it stands
  for (const Override& change : reductions().at(name)) {
    override_config(file.root, change.key, change.value);
  }
  override_config(file.root, "output.pictures", "[]");
  return read_settings(file.root, file.folder);
}

/// Nothing when a file that users may lack is missing.
std::optional<Product> made(const Settings& settings) {
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  try {
    return generate(context, settings, {});
  } catch (const Error& error) {
    const std::string message = error.what();
    const bool lacks_file =
        error.kind() == ErrorKind::input && (message.find("eke_mean") != std::string::npos ||
                                             message.find("levitus") != std::string::npos);
    if (!lacks_file) throw;
    MESSAGE("skipped, the data are not here: " << message);
    return std::nullopt;
  }
}

}  // namespace

TEST_CASE("every file in config/ is known to this test") {
  for (const auto& entry : fs::directory_iterator(kConfigs)) {
    if (entry.path().extension() != ".yaml") continue;
    CAPTURE(entry.path().filename().string());
    CHECK(reductions().count(entry.path().filename().string()) == 1);
  }
}

TEST_CASE("every configuration makes a sound grid of the expected size") {
  for (const auto& reduction : reductions()) {
    const auto& name = reduction.first;
    CAPTURE(name);
    const Settings settings = reduced(name);
    const std::optional<Product> product = made(settings);
    if (!product) continue;
    const Quality& quality = product->report.quality;
    ValidateOptions options;
    options.delaunay = false;  // judged by the measured count below
    const auto defects = validate(product->mesh, settings.surface, options);
    CHECK_MESSAGE(defects.empty(), summary(defects));
    CHECK(quality.n_non_delaunay == 0);
    // A part's numbers are its own; what is expected is the whole triangulation.
    if (!product->domain) CHECK(quality.euler == 2);
    CHECK(std::abs(quality.total_area_error) < 1e-12);
    const double ratio = product->mesh.n_vertices() / product->report.expected_vertices;
    CAPTURE(ratio);
    CHECK(ratio > 0.95);
    CHECK(ratio < 1.05);
  }
}
