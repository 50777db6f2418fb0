// SPDX-License-Identifier: BSD-3-Clause
#include "cap.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <delos/delos.hpp>
#include <exception>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "team.hpp"

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
  std::vector<std::int32_t> node_ids, node_owners, element_ids, element_corners, element_nodes;
  std::vector<double> node_lon_lat_deg, element_area, element_lon_lat_deg;
  std::vector<double> area_m2, spacing_m;  // exports, [n_elements]
};

void append_degrees(std::span<const double> lon_lat_rad, std::size_t id, std::vector<double>& out) {
  out.push_back(lon_lat_rad[2 * id] * kDegPerRad);
  out.push_back(lon_lat_rad[2 * id + 1] * kDegPerRad);
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

/// The cell's corners as nodes, which are made where they are met first; `node` counts from 1, 0 is
/// a vertex not met yet.
void add_corners(const delos::LocalGrid& grid, std::size_t cell, std::vector<std::int32_t>& node,
                 Mesh& mesh) {
  const auto begin = static_cast<std::size_t>(grid.cell_offsets()[cell]);
  const auto end = static_cast<std::size_t>(grid.cell_offsets()[cell + 1]);
  mesh.element_corners.push_back(static_cast<std::int32_t>(end - begin));
  for (std::size_t j = begin; j < end; ++j) {
    const auto vertex = static_cast<std::size_t>(grid.vertices_on_cell()[j]);
    if (node[vertex] == 0) {
      // A vertex's owner owns its first cell, and so has the node as well.
      mesh.node_ids.push_back(grid.global_id(delos::Location::vertex)[vertex] + 1);
      mesh.node_owners.push_back(grid.owner(delos::Location::vertex)[vertex]);
      append_degrees(grid.vertex_lon_lat(), vertex, mesh.node_lon_lat_deg);
      node[vertex] = static_cast<std::int32_t>(mesh.node_ids.size());
    }
    mesh.element_nodes.push_back(node[vertex]);
  }
}

Mesh mesh_of(const delos::LocalGrid& grid, double unit_m2) {
  Mesh mesh;
  std::vector<std::int32_t> node(static_cast<std::size_t>(grid.n_local(delos::Location::vertex)),
                                 0);
  const auto n_owned = static_cast<std::size_t>(grid.n_owned(delos::Location::cell));
  for (std::size_t cell = 0; cell < n_owned; ++cell) {
    mesh.element_ids.push_back(grid.global_id(delos::Location::cell)[cell] + 1);
    mesh.area_m2.push_back(grid.cell_area_m2()[cell]);
    mesh.spacing_m.push_back(grid.cell_spacing_m()[cell]);
    mesh.element_area.push_back(grid.cell_area_m2()[cell] / unit_m2);
    append_degrees(grid.cell_lon_lat(), cell, mesh.element_lon_lat_deg);
    add_corners(grid, cell, node, mesh);
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
  std::unique_ptr<delos::cap::Team> team;
  std::optional<Mesh> mesh;
  std::vector<std::string> imported;  // since the last advance
  std::int64_t generation = 0;        // of the component's grid
  // On the process that has the grid: that of the mesh, and after a remesh the way from it.
  std::optional<delos::Grid> mesh_grid;
  std::optional<delos::Transfer> from_mesh;
  std::string message;

  delos::Component& live() {
    if (!component) refuse("the cap has no component: its configuration was not read");
    return *component;
  }
  const Mesh& made_mesh() const {
    if (!mesh) refuse("there is no mesh: realize comes first");
    return *mesh;
  }
  void check_count(const char* name, std::int64_t n_values) const {
    if (static_cast<std::size_t>(n_values) == made_mesh().element_ids.size()) return;
    refuse(std::string(name) + ": " + std::to_string(n_values) + " values for " +
           std::to_string(mesh->element_ids.size()) + " elements");
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

/// Means, as the statistics of a remesh are carried.
constexpr delos::TransferOptions kMeans = {.order = delos::TransferOrder::first,
                                           .limiter = delos::TransferLimiter::none};

/// Values of the mesh's cells on those of the component's grid.
std::vector<double> on_grid(const delos_cap& cap, std::vector<double> on_mesh) {
  if (!cap.from_mesh) return on_mesh;
  std::vector<double> out(static_cast<std::size_t>(cap.from_mesh->to().n_cells()));
  cap.from_mesh->apply(on_mesh, out, kMeans);
  return out;
}

/// On the process that has the grid.
void advance(delos_cap& cap, const delos::Time& from, const delos::Time& until) {
  delos::Component& component = *cap.component;
  for (const std::string& name : cap.imported) component.import_state().field(name).stamp(from);
  component.run(component.import_state(), component.export_state(),
                delos::Clock({.start = from, .step = until - from}));
}

/// After a remesh. ESMF's mesh stays, as fields on it have its size: the spacing on it becomes the
/// mean of the new grid's, imports will be carried to that.
void follow_grid(delos_cap& cap) {
  const auto now =
      static_cast<std::int64_t>(cap.team->shared(static_cast<double>(cap.component->generation())));
  if (now == cap.generation) return;
  std::vector<double> spacing_m;
  cap.team->together([&] {
    if (!cap.team->is_first()) return;
    const delos::Grid grid = cap.component->grid();
    cap.from_mesh.emplace(*cap.mesh_grid, grid);
    spacing_m.resize(static_cast<std::size_t>(cap.mesh_grid->n_cells()));
    delos::Transfer(grid, *cap.mesh_grid).apply(grid.cell_spacing_m(), spacing_m, kMeans);
  });
  cap.mesh->spacing_m = cap.team->scatter(spacing_m);
  cap.generation = now;
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

int delos_cap_realize(delos_cap* cap, int communicator, int n_processes) {
  return guarded(cap, [&] {
    delos::Component& component = cap->live();
    if (cap->mesh) return delos::kEsmfSuccess;
    auto team = delos::cap::make_team(communicator, n_processes);
    double unit_m2 = 0.0;
    const delos::LocalGrid grid = team->spread([&] {
      component.initialize(delos::InitializePhase::realize);
      cap->mesh_grid = component.grid();
      unit_m2 = unit_area_m2(*cap->mesh_grid);
      return *cap->mesh_grid;
    });
    const double generation = team->shared(static_cast<double>(component.generation()));
    unit_m2 = team->shared(unit_m2);
    team->together([&] { cap->mesh = mesh_of(grid, unit_m2); });
    cap->generation = static_cast<std::int64_t>(generation);
    cap->team = std::move(team);
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
    cap->check_count(name, n_values);
    if (name == std::string_view(kExports[0])) {
      std::copy(mesh.area_m2.begin(), mesh.area_m2.end(), values);
    } else if (name == std::string_view(kExports[1])) {
      std::copy(mesh.spacing_m.begin(), mesh.spacing_m.end(), values);
    } else if (name == std::string_view(kExports[2])) {
      std::fill_n(values, n_values, static_cast<double>(cap->generation));
    } else {
      return delos::kEsmfNotFound;
    }
    return delos::kEsmfSuccess;
  });
}

int delos_cap_set_import(delos_cap* cap, const char* name, const double* values, int64_t n_values) {
  return guarded(cap, [&] {
    cap->made_mesh();
    if (name == nullptr) return kArgBad;
    if (!cap->live().import_state().contains(name)) return delos::kEsmfNotFound;
    cap->team->together([&] {
      if (values == nullptr) refuse(std::string(name) + ": the values are null");
      cap->check_count(name, n_values);
    });
    const auto whole = cap->team->gather({values, static_cast<std::size_t>(n_values)});
    cap->team->together([&] {
      if (!cap->team->is_first()) return;
      cap->live().import_state().field(name).store(on_grid(*cap, whole));
    });
    cap->imported.emplace_back(name);
    return delos::kEsmfSuccess;
  });
}

int delos_cap_advance(delos_cap* cap, const delos_cap_time* from, const delos_cap_time* until,
                      int calendar) {
  return guarded(cap, [&] {
    if (from == nullptr || until == nullptr || calendar < 0 || calendar > 3) return kArgBad;
    cap->made_mesh();
    cap->team->together([&] {
      if (cap->team->is_first()) advance(*cap, time_of(*from, calendar), time_of(*until, calendar));
    });
    cap->imported.clear();
    follow_grid(*cap);
    return delos::kEsmfSuccess;
  });
}

int64_t delos_cap_generation(const delos_cap* cap) { return cap == nullptr ? 0 : cap->generation; }

int delos_cap_finalize(delos_cap* cap) {
  return guarded(cap, [&] {
    cap->live().finalize();
    cap->mesh.reset();
    cap->mesh_grid.reset();
    cap->from_mesh.reset();
    cap->team.reset();
    cap->generation = 0;
    cap->imported.clear();
    return delos::kEsmfSuccess;
  });
}
