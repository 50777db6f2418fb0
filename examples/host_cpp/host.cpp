// SPDX-License-Identifier: BSD-3-Clause
// A C++ model that makes its grid when it starts and takes delos along as a component: no file
// between configuration and arrays.
#include <algorithm>
#include <cstdio>
#include <delos/delos.hpp>
#include <vector>

namespace {

// What a model does with the arrays; here it sums them up.
void use(const delos::Grid& grid) {
  double total_m2 = 0.0;
  for (const double area_m2 : grid.cell_area_m2()) total_m2 += area_m2;  // no copy: a view
  const auto distance_m = grid.cell_distance_m();
  const auto shortest = std::ranges::min_element(distance_m);
  const auto cells = grid.cells_on_edge().subspan(  // [n_edges, 2], ids from 0
      static_cast<std::size_t>(2 * (shortest - distance_m.begin())), 2);
  std::printf("cells: %lld\ntotal area: %.10e m2\n", static_cast<long long>(grid.n_cells()),
              total_m2);
  std::printf("closest cells: %d and %d, %.1f km\n", cells[0], cells[1], *shortest / 1000.0);
}

// The model: one velocity a cell. Fields are taken from the state where they are used, as each
// belongs to one generation of the grid.
void step(std::vector<double>& u_m_s, const delos::State& exports) {
  const delos::Field latitude = exports.field("cell_latitude");
  const auto lat_deg = latitude.data();
  for (std::size_t i = 0; i < u_m_s.size(); ++i) u_m_s[i] += 1e-3 * (45.0 - lat_deg[i]) / 45.0;
}

void simulate(const char* path) {
  delos::Component component(delos::Config::from_file(path));
  component.initialize(delos::InitializePhase::advertise);  // what there will be, nothing large
  component.initialize(delos::InitializePhase::realize);    // the grid
  use(component.grid());

  const delos::State imports = component.import_state();
  const delos::State exports = component.export_state();
  delos::Field u = imports.field("surface_eastward_sea_water_velocity");
  std::vector<double> u_m_s(static_cast<std::size_t>(u.n_points()), 0.0);
  u.bind(u_m_s);  // no copy: the component reads the model's array

  const auto calendar = delos::Calendar::noleap;
  delos::Clock clock({.start = delos::Time::parse("2000-02-28", calendar),
                      .stop = delos::Time::parse("2000-03-14", calendar),
                      .step = delos::TimeInterval::of_days(1)});
  delos::Alarm weekly = clock.add_alarm({.interval = delos::TimeInterval::of_days(7)});
  while (!clock.is_done()) {
    step(u_m_s, exports);
    u.stamp(clock.next());
    component.run(imports, exports, clock);
    clock.advance();
    if (!weekly.is_ringing()) continue;
    weekly.ringer_off();
    std::printf("%s: %.4f m/s in the first cell\n", clock.current().text().c_str(), u_m_s[0]);
  }
  component.finalize();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: host_cpp CONFIG.yaml\n");
    return 2;
  }
  try {
    simulate(argv[1]);
  } catch (const delos::Error& error) {
    std::fprintf(stderr, "host_cpp: %s: %s\n", delos::to_string(error.kind()), error.what());
    return delos::esmf_code(error.kind());
  }
  return 0;
}
