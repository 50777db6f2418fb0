// SPDX-License-Identifier: BSD-3-Clause
// A model that makes its grid at start-up and takes delos along as a component.
#include <cstdio>
#include <delos/delos.hpp>
#include <vector>

namespace {

/// A wanted spacing of 300 km, 150 km around 40 W 35 N.
constexpr char kRecipe[] = R"(
sizing:
  sources:
    - {type: constant, spacing: 300 km}
    - {type: disc, centre: [-40 deg, 35 deg], radius: 20 deg, spacing: 150 km, outside: 300 km}
  combine: min
  gradient_limit: 0.15
)";

/// The model's own state: one velocity a cell.
struct Ocean {
  std::vector<double> u_m_s, v_m_s;
};

void step(Ocean& ocean, const delos::Field& latitude) {
  const auto lat_deg = latitude.data();
  for (std::size_t cell = 0; cell < lat_deg.size(); ++cell) {
    ocean.u_m_s[cell] += 1e-3 * (45.0 - lat_deg[cell]) / 45.0;
  }
}

double mean_area_km2(const delos::Field& area) {
  double sum_m2 = 0.0;
  for (const double area_m2 : area.data()) sum_m2 += area_m2;
  return sum_m2 / static_cast<double>(area.n_points()) / 1e6;
}

void simulate() {
  delos::Component component(delos::Config::from_text(kRecipe));
  component.initialize(delos::InitializePhase::advertise);  // what there will be, nothing large
  component.initialize(delos::InitializePhase::realize);    // the grid
  const delos::State imports = component.import_state();
  const delos::State exports = component.export_state();

  Ocean ocean;
  delos::Field u = imports.field("surface_eastward_sea_water_velocity");
  delos::Field v = imports.field("surface_northward_sea_water_velocity");
  ocean.u_m_s.assign(static_cast<std::size_t>(u.n_points()), 0.0);
  ocean.v_m_s.assign(static_cast<std::size_t>(v.n_points()), 0.0);
  u.bind(ocean.u_m_s);  // no copy: the component reads the model's arrays
  v.bind(ocean.v_m_s);

  delos::Clock clock({.start = delos::Time::parse("2000-02-27"),
                      .stop = delos::Time::parse("2000-03-02"),
                      .step = delos::TimeInterval::of_hours(12)});
  delos::Alarm daily = clock.add_alarm({.interval = delos::TimeInterval::of_days(1)});
  while (!clock.is_done()) {
    step(ocean, exports.field("cell_latitude"));
    u.stamp(clock.next());
    v.stamp(clock.next());
    component.run(imports, exports, clock);
    clock.advance();
    if (!daily.is_ringing()) continue;
    daily.ringer_off();
    const delos::Field area = exports.field("cell_area");
    std::printf("%s: %lld cells of %.0f km2, generation %lld\n", area.time_stamp()->text().c_str(),
                static_cast<long long>(area.n_points()), mean_area_km2(area),
                static_cast<long long>(component.generation()));
  }
  component.finalize();
}

}  // namespace

int main() {
  try {
    simulate();
  } catch (const delos::Error& error) {
    std::fprintf(stderr, "%s error: %s\n", delos::to_string(error.kind()), error.what());
    return delos::esmf_code(error.kind());
  }
  return 0;
}
