// SPDX-License-Identifier: BSD-3-Clause
// A grid that follows eddies which were measured: a host that hands its component velocities or
// energies on their own lat-lon table and carries a field of its own from grid to grid.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <delos/delos.hpp>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "series.hpp"

namespace {

using eke_adaptive::Series;

constexpr char kUsage[] =
    "usage: eke_adaptive winds CONFIG WINDS.cdf OUT\n"
    "       eke_adaptive snapshots CONFIG SNAPSHOTS.nc OUT\n"
    "  CONFIG   a configuration of delos with a section remesh: winds.yaml or snapshots.yaml\n"
    "  OUT      folder for the grids\n"
    "  [KEY=VALUE]...  of the configuration, behind these\n";

struct Arguments {
  std::string what, config, data, out;
  std::vector<std::string> settings;
};

Arguments arguments(int argc, char** argv) {
  if (argc < 5) throw std::invalid_argument(kUsage);
  Arguments out{argv[1], argv[2], argv[3], argv[4], {argv + 5, argv + argc}};
  if (out.what != "winds" && out.what != "snapshots") throw std::invalid_argument(kUsage);
  return out;
}

delos::Config config_of(const Arguments& arguments) {
  delos::Config config = delos::Config::from_file(arguments.config);
  for (const std::string& setting : arguments.settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) throw std::invalid_argument(setting + ": give KEY=VALUE");
    config.set(setting.substr(0, equals), setting.substr(equals + 1));
  }
  return config;
}

double total(const std::vector<double>& values, const delos::Grid& grid) {
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += values[i] * grid.cell_area_m2()[i];
  return sum;
}

/// With a section `domain` sea that was land has no value yet: it begins with the mean of the rest.
void fill_bare(std::vector<double>& values, const delos::Grid& grid) {
  double sum = 0.0, area_m2 = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    sum += values[i] * grid.cell_area_m2()[i];
    area_m2 += grid.cell_area_m2()[i];
  }
  for (double& value : values) value = std::isnan(value) ? sum / area_m2 : value;
}

/// The host's model: here no more than one field, which must survive the remeshes.
struct Model {
  explicit Model(const delos::Grid& grid) : grid(grid) {
    tracer.reserve(static_cast<std::size_t>(grid.n_cells()));
    for (std::size_t cell = 0; cell < static_cast<std::size_t>(grid.n_cells()); ++cell) {
      const double lon = grid.cell_lon_lat()[2 * cell], lat = grid.cell_lon_lat()[2 * cell + 1];
      tracer.push_back(2.0 + std::cos(lat) * std::cos(lat) * std::cos(2.0 * lon));
    }
    total_at_start = total(tracer, grid);
  }

  /// Carries the field to the component's new grid and tells what that took.
  void follow(const delos::Grid& now) {
    const auto start = std::chrono::steady_clock::now();
    const delos::Transfer transfer(grid, now);
    std::vector<double> moved(static_cast<std::size_t>(now.n_cells()));
    transfer.apply(tracer, moved);
    if (transfer.n_unmapped() > 0) fill_bare(moved, now);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    std::printf(
        "  %lld cells, %.1f %% of them as before; transfer %.2f s, its total off by %.1e\n",
        static_cast<long long>(now.n_cells()),
        100.0 * static_cast<double>(transfer.n_unchanged()) / static_cast<double>(now.n_cells()),
        seconds.count(), total(moved, now) / total_at_start - 1.0);
    tracer = std::move(moved);
    grid = now;
  }

  delos::Grid grid;
  std::vector<double> tracer;
  double total_at_start = 0.0;
};

void write(const delos::Grid& grid, const std::string& folder) {
  grid.write_mpas(folder + "/grid" + std::to_string(grid.generation()) + ".nc");
}

/// Runs the component from one step of the clock to the next, with what `give` does before each.
template <class Give>
void run(delos::Component& component, delos::Clock& clock, const std::string& folder, Give give) {
  Model model(component.grid());
  std::printf("%s: %lld cells\n", clock.current().text().c_str(),
              static_cast<long long>(model.grid.n_cells()));
  write(model.grid, folder);
  const delos::State imports = component.import_state(), exports = component.export_state();
  std::string told;
  for (std::size_t step = 0; !clock.is_done(); clock.advance(), ++step) {
    give(step);
    const auto start = std::chrono::steady_clock::now();
    component.run(imports, exports, clock);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    if (component.remesh_decision() == told) continue;
    told = component.remesh_decision();
    std::printf("%s\n  %.2f s\n", told.c_str(), seconds.count());
    if (!component.remesh_failure().empty()) {
      std::printf("  %s\n", component.remesh_failure().c_str());
    }
    if (component.generation() == model.grid.generation()) continue;
    model.follow(component.grid());
    write(model.grid, folder);
  }
}

/// Half the variance of both components over all times.
std::vector<double> mean_energy(const Series& u, const Series& v) {
  const std::size_t n = u.lon_deg().size() * u.lat_deg().size();
  std::vector<double> energy(n, 0.0);
  for (const Series* series : {&u, &v}) {
    std::vector<double> sum(n, 0.0), squares(n, 0.0);
    for (std::size_t time = 0; time < series->n_times(); ++time) {
      const std::vector<double> values = series->read(time);
      for (std::size_t i = 0; i < n; ++i) {
        sum[i] += values[i];
        squares[i] += values[i] * values[i];
      }
    }
    const auto n_times = static_cast<double>(series->n_times());
    for (std::size_t i = 0; i < n; ++i) {
      energy[i] += 0.5 * (squares[i] / n_times - sum[i] / n_times * (sum[i] / n_times));
    }
  }
  return energy;
}

/// Monthly winds, as if they were the model's: the component makes its statistics of them.
void follow_winds(const Arguments& arguments) {
  const Series u(arguments.data, "UWND"), v(arguments.data, "VWND");
  const std::string mean = arguments.out + "/winds_eke_mean.nc";
  eke_adaptive::write_energy(mean, u, mean_energy(u, v));
  delos::Config config = config_of(arguments);
  config.set("sizing.sources.0.file", std::filesystem::absolute(mean).string());

  delos::Component component(config);
  component.initialize();
  delos::Field east = component.import_state().field("surface_eastward_sea_water_velocity");
  delos::Field north = component.import_state().field("surface_northward_sea_water_velocity");
  for (delos::Field* field : {&east, &north}) field->place_on_lat_lon(u.lon_deg(), u.lat_deg());
  const delos::Time start = delos::Time::parse("1982-01-01");
  const delos::TimeInterval month = delos::TimeInterval::of_months(1);
  delos::Clock clock({.start = start,
                      .stop = start + month * static_cast<std::int64_t>(u.n_times()),
                      .step = month});
  run(component, clock, arguments.out, [&](std::size_t step) {
    east.store(u.read(step));
    north.store(v.read(step));
  });
}

/// Each snapshot twice: what the grid made of it is told by the mismatch of the second time.
void follow_snapshots(const Arguments& arguments) {
  const Series eke(arguments.data, "eke");
  delos::Component component(config_of(arguments));
  component.initialize();
  delos::Field energy = component.import_state().field("eddy_kinetic_energy");
  energy.place_on_lat_lon(eke.lon_deg(), eke.lat_deg());
  const delos::Time start = delos::Time::parse("2016-09-01");
  const delos::TimeInterval stay = delos::TimeInterval::of_days(10);
  delos::Clock clock({.start = start,
                      .stop = start + stay * (2 * static_cast<std::int64_t>(eke.n_times())),
                      .step = stay});
  run(component, clock, arguments.out, [&](std::size_t step) { energy.store(eke.read(step / 2)); });
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Arguments given = arguments(argc, argv);
    std::filesystem::create_directories(given.out);
    given.what == "winds" ? follow_winds(given) : follow_snapshots(given);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "eke_adaptive: %s\n", error.what());
    return 1;
  }
  return 0;
}
