// SPDX-License-Identifier: BSD-3-Clause
// The same through BMI, in C++17 and without delos.hpp.
#include <cmath>
#include <delos/bmi.hpp>
#include <exception>
#include <iostream>
#include <vector>

int main(int /*argc*/, char** argv) {
  try {
    delos::Bmi model;
    model.Initialize(argv[1]);
    std::vector<double> area_m2(static_cast<std::size_t>(model.GetGridFaceCount(0)));
    model.GetValue("cell_area", area_m2.data());
    double total_m2 = 0.0;
    for (const double value : area_m2) total_m2 += value;
    std::cout << "in BMI: " << area_m2.size() << " cells, total area " << total_m2 << ' '
              << model.GetVarUnits("cell_area") << '\n';
    model.Finalize();
    return std::abs(total_m2 / 5.1e14 - 1.0) < 1e-2 ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
