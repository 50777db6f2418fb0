// SPDX-License-Identifier: BSD-3-Clause
// A driver without ESMF on many processes: the NUOPC cap's phases in NUOPC's order. Each process
// holds its part against the whole grid, which the host makes for itself; the parts are counted
// together.
//   mpiexec -n N cap_host CONFIG REMESHING_CONFIG
#include <cap.h>
#include <mpi.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <delos/delos.hpp>
#include <exception>
#include <string>
#include <vector>

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegPerRad = 180.0 / kPi;
constexpr double kRound = 1e-12;
constexpr int kNotValid = 42;
constexpr const char* kEnergy = "eddy_kinetic_energy";

struct Host {
  int rank = 0, size = 1, n_wrong = 0;
  delos_cap* cap = nullptr;

  void expect(bool is_right, const char* what) {
    if (is_right) return;
    ++n_wrong;
    std::fprintf(stderr, "process %d: %s; %s\n", rank, what, delos_cap_message(cap));
  }
};

/// How often each id was handed out, over all processes.
std::vector<int> counted(std::int64_t n, const std::vector<std::int32_t>& ids) {
  std::vector<int> times(static_cast<std::size_t>(n), 0);
  for (const std::int32_t id : ids) ++times[static_cast<std::size_t>(id - 1)];
  MPI_Allreduce(MPI_IN_PLACE, times.data(), static_cast<int>(n), MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  return times;
}

bool all_once(const std::vector<int>& times) {
  for (const int n : times) {
    if (n != 1) return false;
  }
  return true;
}

void check_elements(Host& host, const delos_cap_mesh& mesh, const delos::Grid& grid) {
  host.expect(
      all_once(counted(grid.n_cells(), {mesh.element_ids, mesh.element_ids + mesh.n_elements})),
      "every cell belongs to one process");
  bool same = true;
  int corner = 0;
  double area = 0.0;
  for (int i = 0; i < mesh.n_elements; ++i) {
    const auto cell = static_cast<std::size_t>(mesh.element_ids[i] - 1);
    const auto begin = grid.cell_offsets()[cell];
    same = same && mesh.element_corners[i] == grid.cell_offsets()[cell + 1] - begin;
    for (int j = 0; j < mesh.element_corners[i]; ++j, ++corner) {
      const auto vertex = grid.vertices_on_cell()[static_cast<std::size_t>(begin + j)];
      same = same && mesh.node_ids[mesh.element_nodes[corner] - 1] == vertex + 1;
    }
    area += mesh.element_area[i];
  }
  host.expect(same && corner == mesh.n_corners, "elements have the corners of their cells");
  MPI_Allreduce(MPI_IN_PLACE, &area, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  host.expect(std::abs(area / (4.0 * kPi) - 1.0) < kRound, "areas sum to 4 pi");
}

void check_nodes(Host& host, const delos_cap_mesh& mesh, const delos::Grid& grid) {
  std::vector<std::int32_t> own;
  bool same_place = true;
  for (int i = 0; i < mesh.n_nodes; ++i) {
    const auto vertex = static_cast<std::size_t>(mesh.node_ids[i] - 1);
    if (mesh.node_owners[i] == host.rank) own.push_back(mesh.node_ids[i]);
    for (std::size_t k = 0; k < 2; ++k) {
      const double place_deg = grid.vertex_lon_lat()[2 * vertex + k] * kDegPerRad;
      same_place = same_place && std::abs(mesh.node_lon_lat_deg[2 * i + static_cast<int>(k)] -
                                          place_deg) < kRound * 360.0;
    }
  }
  host.expect(same_place, "nodes are where the vertices are");
  // A node that its owner did not have would be counted by nobody.
  host.expect(all_once(counted(grid.n_vertices(), own)), "every node is owned once, where it is");
}

void check_exports(Host& host, const delos_cap_mesh& mesh, const delos::Grid& grid) {
  std::vector<double> values(static_cast<std::size_t>(mesh.n_elements));
  host.expect(delos_cap_get_export(host.cap, "cell_area", values.data(), mesh.n_elements) == 0,
              "cell_area is exported");
  bool same = true;
  for (int i = 0; i < mesh.n_elements; ++i) {
    const auto cell = static_cast<std::size_t>(mesh.element_ids[i] - 1);
    same = same && values[static_cast<std::size_t>(i)] == grid.cell_area_m2()[cell];
  }
  host.expect(same, "cell_area is the grid's");
  host.expect(
      delos_cap_get_export(host.cap, "grid_generation", values.data(), mesh.n_elements) == 0 &&
          values.front() == 1.0 && values.back() == 1.0,
      "the generation is 1 everywhere");
}

void run_days(Host& host, const delos_cap_mesh& mesh) {
  const std::vector<double> energy(static_cast<std::size_t>(mesh.n_elements), 0.02);
  for (int day = 27; day < 29; ++day) {
    const delos_cap_time from = {2000, 2, day, 0, 0, 0, 0, 1};
    const delos_cap_time until = {2000, 2, day + 1, 0, 0, 0, 0, 1};
    host.expect(delos_cap_set_import(host.cap, kEnergy, energy.data(), mesh.n_elements) == 0,
                "the energy is taken");
    host.expect(delos_cap_advance(host.cap, &from, &until, 0) == 0, "a day goes by");
  }
  // What only the first process finds out, all must say.
  const delos_cap_time from = {2000, 2, 1, 0, 0, 0, 0, 1};
  const delos_cap_time until = {2000, 2, 2, 0, 0, 0, 0, 1};
  host.expect(delos_cap_advance(host.cap, &from, &until, 0) == kNotValid &&
                  std::string(delos_cap_message(host.cap)).find("2000-02-29") != std::string::npos,
              "a step back is refused on every process");
  const auto wrong = mesh.n_elements - (host.rank == host.size - 1 ? 1 : 0);
  host.expect(delos_cap_set_import(host.cap, kEnergy, energy.data(), wrong) == kNotValid &&
                  std::string(delos_cap_message(host.cap)).find(kEnergy) != std::string::npos,
              "a wrong number of values on one process is refused on every process");
}

void run(Host& host, const char* config) {
  const MPI_Fint communicator = MPI_Comm_c2f(MPI_COMM_WORLD);
  host.expect(delos_cap_create(config, &host.cap) == 0, "the configuration is read");
  host.expect(delos_cap_advertise(host.cap) == 0, "fields are advertised");
  host.expect(delos_cap_realize(host.cap, communicator, host.size) == 0, "the mesh is made");
  delos_cap_mesh mesh = {};
  host.expect(delos_cap_get_mesh(host.cap, &mesh) == 0, "there is a mesh");
  if (host.n_wrong != 0) return;
  const delos::Grid grid = delos::generate(delos::Config::from_file(config), {.threads = 1});
  check_elements(host, mesh, grid);
  check_nodes(host, mesh, grid);
  check_exports(host, mesh, grid);
  run_days(host, mesh);
  host.expect(delos_cap_finalize(host.cap) == 0, "the cap ends");
  host.expect(delos_cap_advertise(host.cap) == 0 &&
                  delos_cap_realize(host.cap, communicator, host.size) == 0 &&
                  delos_cap_generation(host.cap) == 2,
              "a second life has the next generation");
  delos_cap_destroy(host.cap);
}

std::vector<double> exported(Host& host, const delos_cap_mesh& mesh, const char* name) {
  std::vector<double> values(static_cast<std::size_t>(mesh.n_elements));
  host.expect(delos_cap_get_export(host.cap, name, values.data(), mesh.n_elements) == 0, name);
  return values;
}

/// Energy in the north: at the second day's end the grid is made anew, the mesh is not. The same
/// energy, on the mesh still, then asks for no other grid.
void run_remesh(Host& host, const char* config) {
  host.expect(delos_cap_create(config, &host.cap) == 0 && delos_cap_advertise(host.cap) == 0 &&
                  delos_cap_realize(host.cap, MPI_Comm_c2f(MPI_COMM_WORLD), host.size) == 0,
              "the mesh is made");
  delos_cap_mesh mesh = {};
  host.expect(delos_cap_get_mesh(host.cap, &mesh) == 0, "there is a mesh");
  if (host.n_wrong != 0) return;
  const std::vector<double> area = exported(host, mesh, "cell_area");
  const std::vector<double> before = exported(host, mesh, "cell_spacing");
  std::vector<double> energy;
  for (int i = 0; i < mesh.n_elements; ++i) {
    energy.push_back(mesh.element_lon_lat_deg[2 * i + 1] > 0.0 ? 0.2 : 0.0);
  }
  for (int day = 1; day <= 4; ++day) {
    const delos_cap_time from = {2001, 1, day, 0, 0, 0, 0, 1};
    const delos_cap_time until = {2001, 1, day + 1, 0, 0, 0, 0, 1};
    host.expect(delos_cap_set_import(host.cap, kEnergy, energy.data(), mesh.n_elements) == 0 &&
                    delos_cap_advance(host.cap, &from, &until, 0) == 0,
                "a day goes by");
    host.expect(delos_cap_generation(host.cap) == (day < 2 ? 1 : 2), "a grid at the alarm");
  }
  host.expect(exported(host, mesh, "grid_generation").front() == 2.0, "the generation is told");
  host.expect(exported(host, mesh, "cell_area") == area, "the mesh stays");
  const std::vector<double> after = exported(host, mesh, "cell_spacing");
  bool is_finer_in_the_north = true, is_as_before_in_the_south = true;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const double lat_deg = mesh.element_lon_lat_deg[2 * i + 1];
    if (lat_deg > 45.0) is_finer_in_the_north = is_finer_in_the_north && after[i] < 0.7 * before[i];
    if (lat_deg < -60.0) {
      is_as_before_in_the_south = is_as_before_in_the_south && after[i] > 0.95 * before[i];
    }
  }
  host.expect(is_finer_in_the_north && is_as_before_in_the_south, "the spacing follows");
  host.expect(delos_cap_finalize(host.cap) == 0, "the cap ends");
  delos_cap_destroy(host.cap);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  Host host;
  MPI_Comm_rank(MPI_COMM_WORLD, &host.rank);
  MPI_Comm_size(MPI_COMM_WORLD, &host.size);
  try {
    if (argc == 3) run(host, argv[1]);
    if (argc == 3) run_remesh(host, argv[2]);
  } catch (const std::exception& error) {
    host.expect(false, error.what());
  }
  MPI_Allreduce(MPI_IN_PLACE, &host.n_wrong, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  MPI_Finalize();
  return host.n_wrong == 0 && argc == 3 ? 0 : 1;
}
