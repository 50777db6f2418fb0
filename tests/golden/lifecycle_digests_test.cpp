// SPDX-License-Identifier: BSD-3-Clause
// The digests of small grids, kept in digests.txt: a change of bits is a decision, to be written in
// CHANGELOG.md. DELOS_UPDATE_GOLDEN=1 rewrites the file.
#include <doctest/doctest.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "dual/build.hpp"
#include "dual/digest.hpp"
#include "lifecycle/generate.hpp"
#include "lifecycle/settings_tree.hpp"

using namespace delos;

namespace {

const std::string kFile = DELOS_SOURCE_DIR "/tests/golden/digests.txt";

// Analytic spacings alone, so that no data file has a part in the bits.
std::map<std::string, std::string> cases() {
  const std::string uniform = "sizing: {sources: [{type: constant, spacing: 250 km}]}\n";
  const std::string tiles = "refine: {tile_vertices: 1000}\n";
  return {
      {"uniform_sphere", "surface: {shape: sphere}\n" + uniform + tiles},
      {"uniform_wgs84", "surface: {shape: wgs84}\n" + uniform + tiles},
      {"uniform_triaxial",
       "surface: {shape: ellipsoid, radii: [7645.464 km, 6371.22 km, 5096.976 km], "
       "centre: [1 km, 2 km, 3 km]}\n" +
           uniform + tiles},
      {"patch",
       "sizing: {sources: [{type: disc, centre: [-40 deg, 35 deg], radius: 10 deg, spacing: 60 km, "
       "outside: 500 km, transition: gaussian, width: 10 deg}], gradient_limit: 0.15}\n" +
           tiles},
      {"profile",
       "sizing: {sources: [{type: latitude_profile, latitude: [-90 deg, 0 deg, 90 deg], "
       "spacing: [150 km, 400 km, 200 km]}], gradient_limit: 0.1, cells: 8000}\n" +
           tiles},
      {"icosahedral", "generator: icosahedral\nsubdivisions: 16\n"},
      {"cubed_sphere", "generator: cubed_sphere\nsubdivisions: 12\n"},
  };
}

// "mesh grid": of positions and triangles, and of all arrays of the C-grid.
std::string digests_of(const std::string& yaml) {
  parallel::Executor exec(2);
  Monitor monitor;
  Context context{exec, monitor};
  const Settings settings = read_settings(parse_config(yaml, "golden.yaml"), ".");
  const Product product = generate(context, settings, {true, ""});
  return product.report.digest + " " + digest(exec, *product.grid);
}

std::map<std::string, std::string> read_golden() {
  std::map<std::string, std::string> golden;
  std::ifstream file(kFile);
  for (std::string line; std::getline(file, line);) {
    const std::size_t space = line.find(' ');
    if (space != std::string::npos) golden[line.substr(0, space)] = line.substr(space + 1);
  }
  return golden;
}

}  // namespace

TEST_CASE("small grids have the bits that they have always had") {
  std::map<std::string, std::string> found;
  for (const auto& [name, yaml] : cases()) found[name] = digests_of(yaml);
  if (std::getenv("DELOS_UPDATE_GOLDEN") != nullptr) {
    std::ofstream file(kFile);
    for (const auto& [name, digests] : found) file << name << ' ' << digests << '\n';
  }
  const std::map<std::string, std::string> golden = read_golden();
  CHECK(golden.size() == found.size());
  for (const auto& entry : found) {
    CAPTURE(entry.first);
    CHECK(golden.count(entry.first) == 1);
    CHECK(entry.second == golden.at(entry.first));
  }
}
