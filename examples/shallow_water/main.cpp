// SPDX-License-Identifier: BSD-3-Clause
// A model of shallow water that makes its grid with delos when it starts.
#include <tbb/global_control.h>

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "cases.hpp"
#include "host.hpp"
#include "model.hpp"
#include "norms.hpp"
#ifdef SHALLOW_WATER_PICTURES
#include "picture.hpp"
#endif

namespace {

using shallow_water::Case;
using shallow_water::Model;

constexpr char kUsage[] =
    "usage: shallow_water CASE CONFIG [option value]...\n"
    "  CASE            tc2, tc5 or galewsky\n"
    "  CONFIG          a configuration of delos: the grid, and when to remake it\n"
    "  --days D        the case's own when left out: 5, 15, 6\n"
    "  --every H       whole hours from one line to the next, 24\n"
    "  --threads N     2; the results do not depend on it\n"
    "  --out FOLDER    pictures of vorticity and grid, one for every line, and their animation\n"
    "  --courant C     0.7\n"
    "  --anticipation  of potential vorticity in steps: 0 keeps it, 0.5 smoothes it\n"
    "  --set KEY=VALUE of the configuration, as often as wanted\n";

struct Arguments {
  std::string case_name, config;
  double days = 0.0;
  int every_h = 24;
  double courant = 0.7;
  double anticipation = 0.0;
  int threads = 2;
  std::string folder;
  std::vector<std::string> settings;
};

double number(const std::string& option, const std::string& text, double least) {
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(text, &used);
  } catch (const std::logic_error&) {
    used = 0;
  }
  if (used == 0 || used != text.size() || !(value >= least) || !std::isfinite(value)) {
    throw std::invalid_argument(option + " " + text + ": must be a number from " +
                                std::to_string(least) + " on.");
  }
  return value;
}

Arguments parse(const std::vector<std::string>& words) {
  if (words.size() < 2 || words.size() % 2 != 0) throw std::invalid_argument(kUsage);
  Arguments arguments;
  arguments.case_name = words[0];
  arguments.config = words[1];
  for (std::size_t i = 2; i < words.size(); i += 2) {
    const std::string &option = words[i], &value = words[i + 1];
    if (option == "--days") {
      arguments.days = number(option, value, 0.0);
    } else if (option == "--every") {
      arguments.every_h = static_cast<int>(number(option, value, 1.0));
    } else if (option == "--courant") {
      arguments.courant = number(option, value, 0.01);
    } else if (option == "--anticipation") {
      arguments.anticipation = number(option, value, 0.0);
    } else if (option == "--threads") {
      arguments.threads = static_cast<int>(number(option, value, 1.0));
    } else if (option == "--out") {
      arguments.folder = value;
    } else if (option == "--set") {
      arguments.settings.push_back(value);
    } else {
      throw std::invalid_argument(option + " is no option.\n" + kUsage);
    }
  }
  return arguments;
}

delos::Config make_config(const Arguments& arguments) {
  auto config = delos::Config::from_file(arguments.config);
  for (const std::string& setting : arguments.settings) {
    const auto equals = setting.find('=');
    if (equals == std::string::npos) throw std::invalid_argument("--set takes KEY=VALUE.");
    config.set(setting.substr(0, equals), setting.substr(equals + 1));
  }
  return config;
}

/// A line for every interval: what is kept, and where the solution is known, what is wrong.
class Table {
 public:
  Table(const Model& model, bool with_errors) : start_(model.totals()), with_errors_(with_errors) {
    std::printf("%8s %10s %10s %10s%s\n", "day", "mass", "energy", "enstrophy",
                with_errors ? "      L2(h)    Linf(h)" : "");
  }
  void line(const Model& model, const Case& flow, double day) const {
    std::printf("%8.3f ", day);
    print_change(start_, model.totals());
    if (with_errors_) {
      const auto truth_m = flow.start(model.grid(), {}).flow.depth_m;
      const auto norms = shallow_water::error_norms(model.grid(), model.flow().depth_m, truth_m);
      std::printf(" %10.3e %10.3e", norms.l2, norms.largest);
    }
    std::printf("\n");
    std::fflush(stdout);
  }
  void line(const shallow_water::Change& change) {
    std::printf("  remesh ");
    print_change(change.before, change.after);
    std::printf(" %lld cells, %lld of them as before\n", static_cast<long long>(change.n_after),
                static_cast<long long>(change.n_unchanged));
    energy_ += change.after.energy - change.before.energy;
    ++n_changes_;
  }
  void close() const {
    if (n_changes_ == 0) return;
    std::printf("%d remeshes changed the energy by %.2e\n", n_changes_, energy_ / start_.energy);
  }

 private:
  static void print_change(const shallow_water::Totals& from, const shallow_water::Totals& to) {
    std::printf("%10.2e %10.2e %10.2e", to.mass / from.mass - 1.0, to.energy / from.energy - 1.0,
                to.potential_enstrophy / from.potential_enstrophy - 1.0);
  }
  shallow_water::Totals start_;
  double energy_ = 0.0;
  int n_changes_ = 0;
  bool with_errors_;
};

/// Keeps a picture for every line when a folder was named.
class Album {
 public:
  explicit Album(const Arguments& arguments) : arguments_(arguments) {
    if (arguments.folder.empty()) return;
#ifdef SHALLOW_WATER_PICTURES
    std::filesystem::create_directories(arguments.folder);
#else
    throw std::invalid_argument("--out: this program was built without cairo, so it can't draw.");
#endif
  }
#ifdef SHALLOW_WATER_PICTURES
  void take(const Model& model, const Case& flow, double day) {
    if (arguments_.folder.empty()) return;
    std::array<char, 120> title;
    std::snprintf(title.data(), title.size(),
                  "%s, day %.2f: vorticity from %.1e to %.1e 1/s, %lld cells",
                  arguments_.case_name.c_str(), day, -flow.view().largest, flow.view().largest,
                  static_cast<long long>(model.grid().n_cells()));
    pictures_.push_back(draw(model.grid(), model.vorticity(), flow.view(), title.data()));
    std::array<char, 40> name;
    std::snprintf(name.data(), name.size(), "_%03zu.png", pictures_.size() - 1);
    write(name.data(), pictures_.back());
  }
  void close() const {
    if (!arguments_.folder.empty()) write(".apng", shallow_water::animate(pictures_));
  }

 private:
  void write(const std::string& ending, const std::string& bytes) const {
    const std::string path = arguments_.folder + "/" + arguments_.case_name + ending;
    std::ofstream file(path, std::ios::binary);
    file << bytes;
    file.close();
    if (!file) throw std::runtime_error(path + " can't be written.");
  }
  std::vector<std::string> pictures_;
#else
  void take(const Model&, const Case&, double) {}
  void close() const {}

 private:
#endif
  const Arguments& arguments_;
};

void simulate(const Arguments& arguments) {
  const Case flow = Case::named(arguments.case_name);
  shallow_water::Host host(flow, {.anticipation = arguments.anticipation}, make_config(arguments),
                           arguments.threads);
  const Model& model = host.model();
  const double days = arguments.days > 0.0 ? arguments.days : flow.days();
  const auto n_hours = static_cast<int>(std::lround(days * 24.0));
  std::printf("%s on %lld cells, steps of %.0f s\n", arguments.case_name.c_str(),
              static_cast<long long>(model.grid().n_cells()), model.step_s(arguments.courant));
  Album album(arguments);
  album.take(model, flow, 0.0);
  Table table(model, flow.is_steady());
  const auto from = std::chrono::steady_clock::now();
  while (host.hour() < n_hours) {
    const auto change = host.advance_hour(arguments.courant);
    if (change) table.line(*change);
    if (change || host.hour() % arguments.every_h == 0) album.take(model, flow, host.hour() / 24.0);
    if (host.hour() % arguments.every_h == 0) table.line(model, flow, host.hour() / 24.0);
  }
  album.close();
  table.close();
  std::printf("%.1f s\n",
              std::chrono::duration<double>(std::chrono::steady_clock::now() - from).count());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Arguments arguments = parse({argv + 1, argv + argc});
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(arguments.threads));
    simulate(arguments);
  } catch (const delos::Error& error) {
    std::fprintf(stderr, "%s error: %s\n", delos::to_string(error.kind()), error.what());
    return delos::esmf_code(error.kind());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
  return 0;
}
