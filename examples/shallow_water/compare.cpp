// SPDX-License-Identifier: BSD-3-Clause
// The same flow on several grids: how far its vorticity is from that of a finer one, day by day.
#include <tbb/global_control.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "host.hpp"
#include "norms.hpp"

namespace {

using shallow_water::Case;
using shallow_water::Host;

constexpr char kUsage[] =
    "usage: shallow_water_compare CASE DAYS CACHE REFERENCE CONFIG...\n"
    "  CACHE   a file that gets the reference's vorticity, or - for none; later runs read it\n"
    "Errors are in L2, relative to the reference's vorticity, twice a day.\n";

constexpr int kEvery_h = 12;
constexpr double kCourant = 0.7;
constexpr int kThreads = 2;  // the results do not depend on it
// Vorticity piles up at the scale of the grid without; half a step takes that away.
constexpr shallow_water::Physics kPhysics{.anticipation = 0.5};

/// Vorticity of every cell at every time on one grid.
struct Reference {
  delos::Grid grid;
  std::vector<std::vector<double>> vorticity_s;
};

template <class Visit>
void run(const Case& flow, int n_times, const delos::Config& config, const Visit& visit) {
  Host host(flow, kPhysics, config, kThreads);
  for (int time = 0; time <= n_times; ++time) {
    while (host.hour() < time * kEvery_h) host.advance_hour(kCourant);
    visit(time, host);
  }
}

std::size_t bytes_of(const std::vector<double>& values) { return values.size() * sizeof(double); }

/// Whether the file held all of it, for this grid.
bool read(const std::string& path, Reference& reference) {
  std::ifstream file(path, std::ios::binary);
  std::string digest(reference.grid.digest().size(), ' ');
  file.read(digest.data(), static_cast<std::streamsize>(digest.size()));
  if (!file || digest != reference.grid.digest()) return false;
  for (auto& values : reference.vorticity_s) {
    values.resize(static_cast<std::size_t>(reference.grid.n_cells()));
    file.read(reinterpret_cast<char*>(values.data()),
              static_cast<std::streamsize>(bytes_of(values)));
  }
  return static_cast<bool>(file);
}

void write(const std::string& path, const Reference& reference) {
  std::ofstream file(path, std::ios::binary);
  file << reference.grid.digest();
  for (const auto& values : reference.vorticity_s) {
    file.write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(bytes_of(values)));
  }
  file.close();
  if (!file) throw std::runtime_error(path + " can't be written.");
}

Reference make_reference(const Case& flow, int n_times, const std::string& cache,
                         const delos::Config& config) {
  Reference reference{delos::generate(config, {.threads = kThreads}), {}};
  reference.vorticity_s.resize(static_cast<std::size_t>(n_times) + 1);
  if (cache != "-" && read(cache, reference)) return reference;
  run(flow, n_times, config, [&](int time, const Host& host) {
    reference.vorticity_s[static_cast<std::size_t>(time)] = host.model().vorticity();
  });
  if (cache != "-") write(cache, reference);
  return reference;
}

/// The model's cells brought to the reference's, with slopes, so that coarse cells are no steps.
double error(const Reference& reference, int time, const Host& host) {
  const auto& truth = reference.vorticity_s[static_cast<std::size_t>(time)];
  const delos::Transfer transfer(host.model().grid(), reference.grid, {.threads = kThreads});
  std::vector<double> found(truth.size());
  transfer.apply(host.model().vorticity(), found, {.limiter = delos::TransferLimiter::none});
  return shallow_water::error_norms(reference.grid, found, truth).l2;
}

void compare(const std::vector<std::string>& words) {
  if (words.size() < 5) throw std::invalid_argument(kUsage);
  const Case flow = Case::named(words[0]);
  const int n_times = std::stoi(words[1]) * 24 / kEvery_h;
  const Reference reference =
      make_reference(flow, n_times, words[2], delos::Config::from_file(words[3]));
  std::printf("reference: %s, %lld cells\n", words[3].c_str(),
              static_cast<long long>(reference.grid.n_cells()));
  for (std::size_t i = 4; i < words.size(); ++i) {
    std::printf("%s\n%8s %10s %10s %10s %10s\n", words[i].c_str(), "day", "cells", "L2(vort.)",
                "mass", "energy");
    shallow_water::Totals start;
    run(flow, n_times, delos::Config::from_file(words[i]), [&](int time, const Host& host) {
      const shallow_water::Totals now = host.model().totals();
      if (time == 0) start = now;
      std::printf("%8.1f %10lld %10.4f %10.2e %10.2e\n", time * kEvery_h / 24.0,
                  static_cast<long long>(host.model().grid().n_cells()),
                  error(reference, time, host), now.mass / start.mass - 1.0,
                  now.energy / start.energy - 1.0);
      std::fflush(stdout);
    });
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, kThreads);
    compare({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
