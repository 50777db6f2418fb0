// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A model with a component that remeshes, for tests of its decisions and its sources.
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "lifecycle/component.hpp"
#include "support/sample_times.hpp"

namespace delos::samples {

/// Waves in the northern hemisphere: the south has no eddies.
inline constexpr char kRemeshConfig[] = R"(
sizing: {sources: [{type: constant, spacing: 1200 km}], gradient_limit: 0.3, resolution: 4 deg,
         clamp: {min: 300 km, max: 2000 km}}
refine: {tile_vertices: 500}
remesh:
  interval: P10D
  sources: [{type: eke, quiet: [0.05 m/s, 1200 km], energetic: [0.5 m/s, 500 km]}]
)";

inline Settings remesh_settings(const std::string& more = "") {
  return read_settings(parse_config(kRemeshConfig + more, "remesh.yaml"), ".");
}

/// A component with its host: imports are values in the cells.
class RemeshModel {
 public:
  explicit RemeshModel(const std::string& more = "", int threads = 1,
                       const std::string& restart = "")
      : RemeshModel(remesh_settings(more), threads, restart) {}
  explicit RemeshModel(Settings settings, int threads = 1, const std::string& restart = "",
                       const std::atomic<bool>* cancel = nullptr) {
    ComponentOptions options;
    options.threads = threads;
    options.cancel = cancel;
    options.on_progress = [this](const Progress& now) {
      if (phases.empty() || phases.back() != now.phase) phases.push_back(now.phase);
    };
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
  std::vector<std::string> phases;  ///< in order, each once where it follows itself
};

inline constexpr double kStrong =
    0.6;  // m/s: variances 0.36 and 0, EKE 0.18 m2/s2, speed 0.6 again

}  // namespace delos::samples
