// SPDX-License-Identifier: BSD-3-Clause
#include "cap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <delos/delos.hpp>
#include <exception>
#include <limits>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegPerRad = 180.0 / kPi;
constexpr int kArgBad = 6;        // ESMF_RC_ARG_BAD
constexpr int kInternalBad = 45;  // ESMF_RC_INTNRL_BAD
constexpr int kMem = 30;          // ESMF_RC_MEM

// Places are the mesh's own coordinates.
constexpr std::array kExports = {"cell_area", "cell_spacing", "grid_generation"};

struct Item {
  std::string name, units;
};

/// A process's part of the mesh; delos_cap_mesh points into it.
struct Mesh {
  std::int64_t first_cell = 0;
  std::vector<std::int32_t> node_ids, node_owners, element_ids, element_corners, element_nodes;
  std::vector<double> node_lon_lat_deg, element_area, element_lon_lat_deg;
};

/// Processes own runs of cell ids, which follow the grid's own order in space.
struct Blocks {
  std::int64_t n_cells;
  std::int64_t n_processes;
  std::int64_t first(std::int64_t process) const { return n_cells * process / n_processes; }
  std::int32_t owner(std::int64_t cell) const {
    auto process = (cell * n_processes) / n_cells;
    while (first(process + 1) <= cell) ++process;
    return static_cast<std::int32_t>(process);
  }
};

void append_degrees(std::span<const double> lon_lat_rad, std::int64_t id,
                    std::vector<double>& out) {
  const auto i = static_cast<std::size_t>(2 * id);
  out.push_back(lon_lat_rad[i] * kDegPerRad);
  out.push_back(lon_lat_rad[i + 1] * kDegPerRad);
}

/// m2 of the surface to a square radian: R2 of a sphere, of an ellipsoid that of the sphere of
/// equal area.
double unit_area_m2(const delos::Grid& grid) {
  const auto radii_m = grid.radii_m();
  if (radii_m[0] == radii_m[1] && radii_m[1] == radii_m[2]) return radii_m[0] * radii_m[0];
  double total_m2 = 0.0;
  for (const double area_m2 : grid.cell_area_m2()) total_m2 += area_m2;
  return total_m2 / (4.0 * kPi);
}

void add_elements(const delos::Grid& grid, const Blocks& blocks, int process, Mesh& mesh) {
  const double unit_m2 = unit_area_m2(grid);
  std::vector<std::int32_t> local(static_cast<std::size_t>(grid.n_vertices()), 0);  // from 1
  for (std::int64_t cell = blocks.first(process); cell < blocks.first(process + 1); ++cell) {
    const auto i = static_cast<std::size_t>(cell);
    const auto begin = grid.cell_offsets()[i];
    const auto end = grid.cell_offsets()[i + 1];
    mesh.element_ids.push_back(static_cast<std::int32_t>(cell + 1));
    mesh.element_corners.push_back(static_cast<std::int32_t>(end - begin));
    mesh.element_area.push_back(grid.cell_area_m2()[i] / unit_m2);
    append_degrees(grid.cell_lon_lat(), cell, mesh.element_lon_lat_deg);
    for (std::int64_t j = begin; j < end; ++j) {
      const std::int32_t vertex = grid.vertices_on_cell()[static_cast<std::size_t>(j)];
      auto& node = local[static_cast<std::size_t>(vertex)];
      if (node == 0) {
        mesh.node_ids.push_back(vertex + 1);
        node = static_cast<std::int32_t>(mesh.node_ids.size());
      }
      mesh.element_nodes.push_back(node);
    }
  }
}

Mesh mesh_of(const delos::Grid& grid, int process, int n_processes) {
  const Blocks blocks{grid.n_cells(), n_processes};
  Mesh mesh;
  mesh.first_cell = blocks.first(process);
  add_elements(grid, blocks, process, mesh);
  for (const std::int32_t id : mesh.node_ids) {
    const auto cells = grid.cells_on_vertex().subspan(3 * static_cast<std::size_t>(id - 1), 3);
    // The lowest process that has one of the vertex's cells, so that all of them agree.
    std::int32_t owner = std::numeric_limits<std::int32_t>::max();
    for (const std::int32_t cell : cells) {
      if (cell >= 0) owner = std::min(owner, blocks.owner(cell));
    }
    mesh.node_owners.push_back(owner);
    append_degrees(grid.vertex_lon_lat(), id - 1, mesh.node_lon_lat_deg);
  }
  return mesh;
}

delos::Time time_of(const delos_cap_time& time, int calendar) {
  return delos::Time::of({.year = time.year,
                          .month = static_cast<int>(time.month),
                          .day = static_cast<int>(time.day),
                          .hour = static_cast<int>(time.hour),
                          .minute = static_cast<int>(time.minute),
                          .second = static_cast<int>(time.second),
                          .numerator = time.numerator,
                          .denominator = time.denominator},
                         static_cast<delos::Calendar>(calendar));
}

[[noreturn]] void refuse(const std::string& message) {
  throw delos::Error(delos::ErrorKind::state, message);
}

}  // namespace

struct delos_cap {
  std::optional<delos::Component> component;
  std::array<std::vector<Item>, 2> items;  // by intent
  std::optional<Mesh> mesh;
  std::vector<std::string> imported;  // since the last advance
  std::int64_t generation = 0;        // of the mesh
  std::string message;

  delos::Component& live() {
    if (!component) refuse("the cap has no component: its configuration was not read");
    return *component;
  }
  const Mesh& made_mesh() const {
    if (!mesh) refuse("there is no mesh: realize comes first");
    return *mesh;
  }
};

namespace {

/// Runs body(); what it throws becomes a code and the message.
template <class Body>
int guarded(delos_cap* cap, Body&& body) noexcept {
  if (cap == nullptr) return kArgBad;
  try {
    try {
      cap->message.clear();
      return body();
    } catch (const delos::Error& error) {
      cap->message = error.what();
      return delos::esmf_code(error.kind());
    } catch (const std::bad_alloc&) {
      cap->message = "out of memory";
      return kMem;
    } catch (const std::exception& error) {
      cap->message = error.what();
      return kInternalBad;
    }
  } catch (...) {
    return kMem;  // no memory for the message either
  }
}

void list_items(delos_cap& cap) {
  for (auto& list : cap.items) list.clear();
  const delos::State imports = cap.live().import_state();
  for (const std::string& name : imports.names()) {
    cap.items[DELOS_CAP_IMPORT].push_back({name, imports.field(name).units()});
  }
  const delos::State exports = cap.live().export_state();
  for (const char* const name : kExports) {
    cap.items[DELOS_CAP_EXPORT].push_back({name, exports.field(name).units()});
  }
}

}  // namespace

int delos_cap_create(const char* config_file, delos_cap** cap) {
  if (cap == nullptr) return kArgBad;
  *cap = new (std::nothrow) delos_cap();
  if (*cap == nullptr) return kMem;
  return guarded(*cap, [&] {
    if (config_file == nullptr) refuse("no configuration file was named");
    (*cap)->component.emplace(delos::Config::from_file(config_file));
    return delos::kEsmfSuccess;
  });
}

void delos_cap_destroy(delos_cap* cap) { delete cap; }

const char* delos_cap_message(const delos_cap* cap) {
  return cap == nullptr ? "the cap is null" : cap->message.c_str();
}

int delos_cap_advertise(delos_cap* cap) {
  return guarded(cap, [&] {
    cap->live().initialize(delos::InitializePhase::advertise);
    list_items(*cap);
    return delos::kEsmfSuccess;
  });
}

int delos_cap_get_item(delos_cap* cap, int intent, int index, delos_cap_item* item) {
  return guarded(cap, [&] {
    if ((intent != DELOS_CAP_IMPORT && intent != DELOS_CAP_EXPORT) || index < 0 ||
        item == nullptr) {
      cap->message = "delos_cap_get_item: intent 0 or 1, index from 0, and a place for the item";
      return kArgBad;
    }
    const auto& list = cap->items[static_cast<std::size_t>(intent)];
    if (static_cast<std::size_t>(index) >= list.size()) return delos::kEsmfNotFound;
    const Item& found = list[static_cast<std::size_t>(index)];
    *item = {found.name.c_str(), found.units.c_str()};
    return delos::kEsmfSuccess;
  });
}

int delos_cap_realize(delos_cap* cap, int process, int n_processes) {
  return guarded(cap, [&] {
    if (process < 0 || process >= n_processes) {
      cap->message = "process " + std::to_string(process) + " of " + std::to_string(n_processes) +
                     ": processes count from 0";
      return kArgBad;
    }
    cap->live().initialize(delos::InitializePhase::realize);
    const delos::Grid grid = cap->live().grid();
    if (grid.n_cells() < n_processes) {
      refuse("the grid has " + std::to_string(grid.n_cells()) + " cells, fewer than the " +
             std::to_string(n_processes) + " processes: give the component fewer");
    }
    cap->mesh = mesh_of(grid, process, n_processes);
    cap->generation = grid.generation();
    return delos::kEsmfSuccess;
  });
}

int delos_cap_get_mesh(delos_cap* cap, delos_cap_mesh* mesh) {
  return guarded(cap, [&] {
    const Mesh& made = cap->made_mesh();
    if (mesh == nullptr) return kArgBad;
    const auto count = [](const auto& ids) { return static_cast<std::int32_t>(ids.size()); };
    *mesh = {.n_nodes = count(made.node_ids),
             .n_elements = count(made.element_ids),
             .n_corners = count(made.element_nodes),
             .node_ids = made.node_ids.data(),
             .node_owners = made.node_owners.data(),
             .node_lon_lat_deg = made.node_lon_lat_deg.data(),
             .element_ids = made.element_ids.data(),
             .element_corners = made.element_corners.data(),
             .element_nodes = made.element_nodes.data(),
             .element_area = made.element_area.data(),
             .element_lon_lat_deg = made.element_lon_lat_deg.data()};
    return delos::kEsmfSuccess;
  });
}

int delos_cap_get_export(delos_cap* cap, const char* name, double* values, int64_t n_values) {
  return guarded(cap, [&] {
    const Mesh& mesh = cap->made_mesh();
    if (name == nullptr || values == nullptr) return kArgBad;
    if (static_cast<std::size_t>(n_values) != mesh.element_ids.size()) {
      refuse(std::string(name) + ": " + std::to_string(n_values) + " values for " +
             std::to_string(mesh.element_ids.size()) + " elements");
    }
    const delos::State exports = cap->live().export_state();
    if (!exports.contains(name)) return delos::kEsmfNotFound;
    const delos::Field field = exports.field(name);
    if (field.location() == delos::Location::grid) {
      std::fill_n(values, n_values, field.data()[0]);
    } else {
      std::copy_n(field.data().begin() + mesh.first_cell, n_values, values);
    }
    return delos::kEsmfSuccess;
  });
}

int delos_cap_set_import(delos_cap* cap, const char* name, const double* values, int64_t n_values) {
  return guarded(cap, [&] {
    if (name == nullptr || values == nullptr || n_values < 0) return kArgBad;
    const delos::State imports = cap->live().import_state();
    if (!imports.contains(name)) return delos::kEsmfNotFound;
    imports.field(name).store({values, static_cast<std::size_t>(n_values)});
    cap->imported.emplace_back(name);
    return delos::kEsmfSuccess;
  });
}

int delos_cap_advance(delos_cap* cap, const delos_cap_time* from, const delos_cap_time* until,
                      int calendar) {
  return guarded(cap, [&] {
    if (from == nullptr || until == nullptr || calendar < 0 || calendar > 3) return kArgBad;
    delos::Component& component = cap->live();
    const delos::Time begin = time_of(*from, calendar);
    const delos::Time end = time_of(*until, calendar);
    for (const std::string& name : cap->imported) {
      component.import_state().field(name).stamp(begin);
    }
    component.run(component.import_state(), component.export_state(),
                  delos::Clock({.start = begin, .step = end - begin}));
    cap->imported.clear();
    if (component.generation() != cap->generation) {
      refuse("the grid was made anew (generation " + std::to_string(component.generation()) +
             "), which fields on an ESMF mesh can't follow: switch remeshing off");
    }
    return delos::kEsmfSuccess;
  });
}

int64_t delos_cap_generation(const delos_cap* cap) {
  return cap == nullptr || !cap->component ? 0 : cap->component->generation();
}

int delos_cap_finalize(delos_cap* cap) {
  return guarded(cap, [&] {
    cap->live().finalize();
    cap->mesh.reset();
    cap->generation = 0;
    cap->imported.clear();
    return delos::kEsmfSuccess;
  });
}
