// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <new>
#include <utility>

#include "mpi_handle.hpp"

using delos::Location;
using delos::c::need;
using delos::mpi::DistributedGrid;
using delos::mpi::c::call;
using delos::mpi::c::config_from_file;
using delos::mpi::c::config_from_text;
using delos::mpi::c::create;
using delos::mpi::c::options_of;

namespace {

std::vector<double> weights(const delos_mpi_options& options, const delos::Grid& grid) {
  std::vector<double> out(static_cast<std::size_t>(grid.n_cells()), 0.0);
  const int status = options.cell_weight(grid.n_cells(), grid.cell_lon_lat().data(), out.data(),
                                         options.user_data);
  if (status != 0) {
    throw delos::Error(delos::ErrorKind::input,
                       "the callback for the weights of cells failed, and "
                       "returned " +
                           std::to_string(status) + ".");
  }
  return out;
}

}  // namespace

namespace delos::mpi::c {

Options options_of(const delos_mpi_options* given) {
  const delos_mpi_options from = given == nullptr ? delos_mpi_options{} : *given;
  Options out;
  out.generate.threads = std::max(from.n_threads, 0);
  out.root = from.root;
  out.halo_layers = from.halo_layers == 0 ? 1 : from.halo_layers;
  out.method = from.method == DELOS_MPI_KWAY    ? delos::PartitionMethod::kway
               : from.method == DELOS_MPI_CURVE ? delos::PartitionMethod::curve
                                                : delos::PartitionMethod::automatic;
  out.work = from.work == DELOS_MPI_WORK_CELLS    ? delos::CellWork::cells
             : from.work == DELOS_MPI_WORK_LAYERS ? delos::CellWork::layers
                                                  : delos::CellWork::automatic;
  if (from.cell_weight != nullptr) {
    out.cell_weight = [from](const delos::Grid& grid) { return weights(from, grid); };
  }
  return out;
}

Config config_from_file(const char* path) {
  if (path == nullptr) throw delos::Error(delos::ErrorKind::config, "path is NULL: name a file.");
  return delos::Config::from_file(path);
}

Config config_from_text(const char* yaml, const char* folder) {
  if (yaml == nullptr) throw delos::Error(delos::ErrorKind::config, "yaml is NULL: give a text.");
  return delos::Config::from_text(yaml, "configuration", folder == nullptr ? "." : folder);
}

}  // namespace delos::mpi::c

namespace {

/// Numbers beyond the three become one that LocalGrid refuses.
Location location_of(int number) {
  constexpr Location kKnown[] = {Location::cell, Location::edge, Location::vertex};
  return number >= 0 && number < 3 ? kKnown[number] : Location::grid;
}

template <class Number>
std::span<Number> field(Number* values, int64_t size) {
  return {values, values == nullptr || size < 0 ? 0 : static_cast<std::size_t>(size)};
}

template <class Number>
int exchange(delos_mpi_grid* grid, std::span<Number> values, int location, int n_components) {
  return call(grid, __func__, [&](const DistributedGrid& own) {
    own.exchange(values, location_of(location), n_components);
  });
}

}  // namespace

int delos_mpi_generate_file(MPI_Comm comm, const char* path, const delos_mpi_options* options,
                            delos_mpi_grid** grid) {
  return create(__func__, grid, [&] {
    return delos::mpi::generate(
        comm, [&] { return config_from_file(path); }, options_of(options));
  });
}
int delos_mpi_generate_file_f(MPI_Fint comm, const char* path, const delos_mpi_options* options,
                              delos_mpi_grid** grid) {
  return delos_mpi_generate_file(MPI_Comm_f2c(comm), path, options, grid);
}
int delos_mpi_generate_text(MPI_Comm comm, const char* yaml, const char* folder,
                            const delos_mpi_options* options, delos_mpi_grid** grid) {
  return create(__func__, grid, [&] {
    return delos::mpi::generate(
        comm, [&] { return config_from_text(yaml, folder); }, options_of(options));
  });
}
int delos_mpi_generate_text_f(MPI_Fint comm, const char* yaml, const char* folder,
                              const delos_mpi_options* options, delos_mpi_grid** grid) {
  return delos_mpi_generate_text(MPI_Comm_f2c(comm), yaml, folder, options, grid);
}

int delos_mpi_grid_destroy(delos_mpi_grid* grid) {
  delete grid;
  return DELOS_SUCCESS;
}

const char* delos_mpi_last_error(const delos_mpi_grid* grid) {
  return delos::mpi::c::text_of(grid);
}

int delos_mpi_grid_generation(delos_mpi_grid* grid, int64_t* generation) {
  return call(grid, __func__, [&](const DistributedGrid& own) {
    need(generation, "generation");
    *generation = own.generation();
  });
}

int delos_mpi_grid_digest(delos_mpi_grid* grid, const char** text) {
  if (text != nullptr) *text = nullptr;
  return call(grid, __func__, [&](const DistributedGrid& own) {
    need(text, "text");
    *text = own.digest().c_str();
  });
}

#define DELOS_COUNT(name)                                                         \
  int delos_mpi_grid_##name(delos_mpi_grid* grid, int location, int64_t* value) { \
    return call(grid, __func__, [&](const DistributedGrid& own) {                 \
      need(value, "n");                                                           \
      *value = own.local().name(location_of(location));                           \
    });                                                                           \
  }
DELOS_COUNT(n_local)
DELOS_COUNT(n_owned)
DELOS_COUNT(n_global)
#undef DELOS_COUNT

#define DELOS_LIST(name, type)                                                       \
  int delos_mpi_grid_##name(delos_mpi_grid* grid, int location, const type** values, \
                            int64_t* size) {                                         \
    if (values != nullptr) *values = nullptr;                                        \
    return call(grid, __func__, [&](const DistributedGrid& own) {                    \
      need(values, "values");                                                        \
      const std::span<const type> list = own.local().name(location_of(location));    \
      *values = list.data();                                                         \
      if (size != nullptr) *size = static_cast<int64_t>(list.size());                \
    });                                                                              \
  }
DELOS_LIST(global_id, int32_t)
DELOS_LIST(owner, int32_t)
DELOS_LIST(layer_offsets, int64_t)
DELOS_LIST(neighbours, int32_t)
DELOS_LIST(send_offsets, int64_t)
DELOS_LIST(send_ids, int32_t)
DELOS_LIST(receive_offsets, int64_t)
DELOS_LIST(receive_ids, int32_t)
#undef DELOS_LIST

#define DELOS_ARRAY(name, type)                                                         \
  int delos_mpi_grid_##name(delos_mpi_grid* grid, const type** values, int64_t* size) { \
    if (values != nullptr) *values = nullptr;                                           \
    return call(grid, __func__, [&](const DistributedGrid& own) {                       \
      need(values, "values");                                                           \
      const std::span<const type> array = own.local().name();                           \
      *values = array.data();                                                           \
      if (size != nullptr) *size = static_cast<int64_t>(array.size());                  \
    });                                                                                 \
  }
#include "arrays.inc"
#undef DELOS_ARRAY

#define DELOS_LEVELS(name)                                                        \
  int delos_mpi_grid_##name(delos_mpi_grid* grid, double* values, int64_t size) { \
    return call(grid, __func__, [&](const DistributedGrid& own) {                 \
      delos::c::fill(own.local().name(), values, size);                           \
    });                                                                           \
  }
DELOS_LEVELS(layer_thickness_m)
DELOS_LEVELS(interface_height_m)
#undef DELOS_LEVELS

int delos_mpi_exchange(delos_mpi_grid* grid, double* values, int64_t size, int location,
                       int n_components) {
  return exchange(grid, field(values, size), location, n_components);
}
int delos_mpi_exchange_float(delos_mpi_grid* grid, float* values, int64_t size, int location,
                             int n_components) {
  return exchange(grid, field(values, size), location, n_components);
}
int delos_mpi_exchange_int32(delos_mpi_grid* grid, int32_t* values, int64_t size, int location,
                             int n_components) {
  return exchange(grid, field(values, size), location, n_components);
}

// What is wrong with an argument of one process is found after the collective part, or by it, so
// that the others do not wait.
// NOLINTBEGIN(readability-function-size): C has no structs of arguments to spare
int delos_mpi_gather(delos_mpi_grid* grid, const double* values, int64_t size, int location,
                     int n_components, double* whole) {
  return call(grid, __func__, [&](const DistributedGrid& own) {
    const auto all = own.gather(field(values, size), location_of(location), n_components);
    if (own.local().part() != own.root()) return;
    need(whole, "whole");
    std::copy(all.begin(), all.end(), whole);
  });
}

int delos_mpi_scatter(delos_mpi_grid* grid, const double* whole, int location, int n_components,
                      double* values, int64_t size) {
  return call(grid, __func__, [&](const DistributedGrid& own) {
    const Location at = location_of(location);
    const auto part = own.scatter(
        field(whole, own.local().n_global(at) * std::max(n_components, 0)), at, n_components);
    if (field(values, size).size() != part.size()) {
      throw delos::c::Refusal{DELOS_ERROR_ARGUMENT, "size = " + std::to_string(size) +
                                                        ": must be n_local * " +
                                                        std::to_string(n_components) + " = " +
                                                        std::to_string(part.size())};
    }
    std::copy(part.begin(), part.end(), values);
  });
}
// NOLINTEND(readability-function-size)
