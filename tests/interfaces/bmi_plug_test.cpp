// SPDX-License-Identifier: BSD-3-Clause
// A framework that knows nothing of delos but BMI's functions: it opens the plug, makes a model,
// reads the areas, and gives the model back. Two models at once do not meet.
//   bmi_plug_host LIBRARY CONFIG
#include <dlfcn.h>

#include <cmath>
#include <cstddef>
#include <cstdio>
#include <delos/bmi.hpp>
#include <exception>
#include <vector>

namespace {

using delos::BmiInterface;

double total_area_m2(BmiInterface& model) {
  std::vector<double> area_m2(static_cast<std::size_t>(model.GetGridFaceCount(0)));
  model.GetValue("cell_area", area_m2.data());
  double total_m2 = 0.0;
  for (const double value : area_m2) total_m2 += value;
  return total_m2;
}

int run(const char* library, const char* config) {
  void* const plug = dlopen(library, RTLD_NOW | RTLD_LOCAL);
  if (plug == nullptr) {
    std::fprintf(stderr, "%s\n", dlerror());
    return 1;
  }
  auto* const create = reinterpret_cast<BmiInterface* (*)()>(dlsym(plug, "bmi_model_create"));
  auto* const destroy = reinterpret_cast<void (*)(BmiInterface*)>(dlsym(plug, "bmi_model_destroy"));
  if (create == nullptr || destroy == nullptr) return 2;
  BmiInterface* const one = create();
  BmiInterface* const other = create();
  if (one == nullptr || other == nullptr) return 3;
  one->Initialize(config);
  other->Initialize(config);
  one->Finalize();
  other->Update();
  constexpr double kEarth_m2 = 5.1e14;
  const bool sound = std::abs(total_area_m2(*other) / kEarth_m2 - 1.0) < 1e-2;
  bool caught = false;
  try {
    one->Update();
  } catch (const std::exception&) {
    caught = true;
  }
  destroy(one);
  destroy(other);
  destroy(nullptr);
  return sound && caught ? 0 : 4;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 5;
  try {
    return run(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 6;
  }
}
