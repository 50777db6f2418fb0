// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A model whose component is distributed, and the same on the root alone.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <delos/distributed.hpp>
#include <span>
#include <string>
#include <vector>

#include "mpi_support.hpp"

namespace mpi_support {

inline constexpr const char* kEast = "surface_eastward_sea_water_velocity";
inline constexpr const char* kNorth = "surface_northward_sea_water_velocity";
inline constexpr double kStrong_ms = 0.6;

inline delos::mpi::Options options(int root = 0) {
  delos::mpi::Options out;
  out.generate.threads = 1;
  out.root = root;
  return out;
}

inline delos::Clock clock_at(int day) {
  delos::Clock clock(
      {.start = delos::Time::parse("2001-01-01"), .step = delos::TimeInterval::of_days(1)});
  for (int i = 0; i < day; ++i) clock.advance();
  return clock;
}

/// A day's eastward velocity at a place: to and fro in the north.
inline double eastward(int day, double z) {
  return z > 0.0 ? (day % 2 == 0 ? 1.0 : -1.0) * kStrong_ms * z : 0.0;
}

inline std::vector<double> eastward_all(int day, std::span<const double> position) {
  std::vector<double> out;
  for (std::size_t i = 2; i < position.size(); i += 3) out.push_back(eastward(day, position[i]));
  return out;
}

inline void give_imports(delos::mpi::DistributedComponent& component, int day) {
  const delos::LocalGrid& own = component.grid().local();
  const auto n_owned = static_cast<std::size_t>(own.n_owned(delos::Location::cell));
  component.set_import(kEast, eastward_all(day, own.cell_position().first(3 * n_owned)));
  component.set_import(kNorth, std::vector<double>(n_owned, 0.0));
}

inline bool run_day(delos::mpi::DistributedComponent& component, int day) {
  give_imports(component, day);
  return component.run(clock_at(day));
}

/// The same by a component of one process, on the root alone.
inline void run_day(delos::Component& serial, int day) {
  const delos::Grid grid = serial.grid();
  serial.import_state().field(kEast).store(eastward_all(day, grid.cell_position()));
  serial.import_state().field(kNorth).store(
      std::vector<double>(static_cast<std::size_t>(grid.n_cells()), 0.0));
  serial.run(serial.import_state(), serial.export_state(), clock_at(day));
}

inline bool same_bits(std::span<const double> a, std::span<const double> b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

/// Exports of all processes together are those of the serial component, and halos the owners'.
inline void compare_exports(const delos::mpi::DistributedComponent& component,
                            const delos::Component* serial) {
  const delos::mpi::DistributedGrid& grid = component.grid();
  for (const delos::mpi::FieldInfo& info : component.exports()) {
    CAPTURE(info.name);
    const auto values = component.get_export(info.name);
    if (info.location == delos::Location::grid) {
      double of_root = values[0];
      MPI_Bcast(&of_root, 1, MPI_DOUBLE, grid.root(), grid.communicator());
      CHECK(values.size() == 1);
      CHECK(values[0] == of_root);
      if (serial) CHECK(same_bits(values, serial->export_state().field(info.name).data()));
      continue;
    }
    const auto whole = grid.gather(values, info.location, info.n_components);
    if (serial) CHECK(same_bits(whole, serial->export_state().field(info.name).data()));
    std::vector<double> halo(values.begin(), values.end());
    grid.exchange(std::span(halo), info.location, info.n_components);
    CHECK(same_bits(halo, values));
  }
  if (serial) CHECK(grid.digest() == serial->grid().digest());
  CHECK(is_same_everywhere(grid.digest()));
  CHECK(grid.generation() == component.generation());
  CHECK(component.get_export("grid_generation")[0] == static_cast<double>(component.generation()));
}

/// A field of the host's, [n, n_levels] at positions [n, 3].
inline std::vector<double> filled(std::span<const double> position, int n_levels) {
  std::vector<double> out;
  for (std::size_t i = 0; i < position.size(); i += 3) {
    for (int level = 0; level < n_levels; ++level) {
      out.push_back(1.0 + position[i] * position[i + 1] + level * position[i + 2]);
    }
  }
  return out;
}

}  // namespace mpi_support
