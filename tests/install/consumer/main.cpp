// SPDX-License-Identifier: BSD-3-Clause
// Makes a coarse grid through the installed headers and checks that it covers the sphere.
#include <cmath>
#include <delos/delos.hpp>
#include <exception>
#include <iostream>
#include <numeric>

namespace {

constexpr double kRadius_m = 6371220.0;
constexpr double kPi = 3.14159265358979323846;

int run() {
  const delos::Config config = delos::Config::from_text(
      "surface: {shape: sphere, radius: 6371.22 km}\n"
      "sizing: {sources: [{type: constant, spacing: 600 km}]}\n");
  const delos::Grid grid = delos::generate(config);
  const auto areas = grid.cell_area_m2();
  const double total_m2 = std::accumulate(areas.begin(), areas.end(), 0.0);
  std::cout << "delos " << delos::version() << ": " << grid.n_cells() << " cells, total area "
            << total_m2 << " m2, digest " << grid.digest() << '\n';
  const double wanted_m2 = 4.0 * kPi * kRadius_m * kRadius_m;
  if (grid.n_cells() < 1000 || std::abs(total_m2 / wanted_m2 - 1.0) > 1e-12) {
    std::cerr << "wrong: the cells must cover " << wanted_m2 << " m2\n";
    return 1;
  }
  try {
    delos::Config::from_text("sizing: {sourcs: []}\n", "typo.yaml").check();
  } catch (const delos::Error& error) {
    std::cout << "a typo is refused: " << error.what() << '\n';
    return error.kind() == delos::ErrorKind::config ? 0 : 1;
  }
  std::cerr << "wrong: an unknown key was accepted\n";
  return 1;
}

}  // namespace

int main() {
  try {
    return run();
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
