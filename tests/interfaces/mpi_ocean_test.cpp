// SPDX-License-Identifier: BSD-3-Clause
// Run by mpiexec with 1, 2 and 3 processes: an ocean with layers whose grid follows its eddies is
// that of one process, bit for bit.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <cmath>
#include <optional>

#include "mpi_component_support.hpp"

using delos::Location;
using delos::mpi::DistributedComponent;
using delos::mpi::DistributedGrid;
using namespace mpi_support;

namespace {

/// Sea by the embedded bathymetry, and coarse layers.
constexpr char kOcean[] = R"(
sizing: {sources: [{type: constant, spacing: 1000 km}], gradient_limit: 0.3, resolution: 4 deg,
         clamp: {min: 300 km, max: 2000 km}}
refine: {tile_vertices: 500}
data_path: [/none]
domain: {bodies: largest}
layers: {kind: z_level, levels: {shape: uniform, n: 6, depth: 6000 m}}
remesh:
  interval: P2D
  sources: [{type: eke, quiet: [0.05 m/s, 1000 km], energetic: [0.5 m/s, 450 km]}]
)";

delos::Config ocean() { return delos::Config::from_text(kOcean); }

/// Layers of all processes together are those of the whole grid.
void compare_layers(const DistributedGrid& grid, const delos::Component* serial) {
  const delos::LocalGrid& own = grid.local();
  const std::vector<double> deepest(own.max_level_cell().begin(), own.max_level_cell().end());
  const int n_levels = static_cast<int>(own.level_interface_m().size()) - 1;
  CHECK(n_levels == 6);
  const auto all_deepest = grid.gather(deepest, Location::cell);
  const auto bottom_m = grid.gather(own.bottom_depth_m(), Location::cell);
  const auto thickness_m = grid.gather(own.layer_thickness_m(), Location::cell, n_levels);
  if (serial == nullptr) return;
  const delos::Grid whole = serial->grid();
  CHECK(std::equal(all_deepest.begin(), all_deepest.end(), whole.max_level_cell().begin(),
                   whole.max_level_cell().end()));
  CHECK(same_bits(bottom_m, whole.bottom_depth_m()));
  CHECK(same_bits(thickness_m, whole.layer_thickness_m()));
}

std::vector<double> carried(const delos::Transfer& transfer, const delos::TransferOptions& how) {
  const auto n = static_cast<std::size_t>(how.n_levels);
  std::vector<double> out(n * static_cast<std::size_t>(transfer.to().n_cells()));
  transfer.apply(filled(transfer.from().cell_position(), static_cast<int>(n)), out, how);
  return out;
}

}  // namespace

TEST_CASE("an ocean over processes is the serial one, its layers and its host's fields too") {
  const int root_rank = n_ranks() - 1;
  std::optional<delos::Component> serial;
  if (rank() == root_rank) serial.emplace(ocean(), delos::GenerateOptions{.threads = 2});
  delos::Component* const alone = serial ? &*serial : nullptr;
  DistributedComponent component(MPI_COMM_WORLD, ocean, options(root_rank));
  component.initialize();
  if (serial) serial->initialize();
  compare_exports(component, alone);
  compare_layers(component.grid(), alone);

  CHECK_FALSE(run_day(component, 0));
  const DistributedGrid former = component.grid();
  REQUIRE(run_day(component, 1));
  CHECK(component.remesh_failure().empty());
  std::optional<delos::Transfer> transfer;
  if (serial) {
    const delos::Grid before = serial->grid();
    run_day(*serial, 0);
    run_day(*serial, 1);
    transfer.emplace(before, serial->grid());
    CHECK(transfer->n_unchanged() > 0);
    CHECK(transfer->n_unchanged() < before.n_cells());
  }
  compare_exports(component, alone);
  compare_layers(component.grid(), alone);

  const auto cells = former.local().cell_position();
  for (const auto normalization :
       {delos::TransferNormalization::covered, delos::TransferNormalization::whole}) {
    const delos::TransferOptions how{.n_levels = 2, .normalization = normalization};
    const auto moved =
        component.grid().gather(component.transfer(filled(cells, 2), how), Location::cell, 2);
    if (!transfer) continue;
    CHECK(same_bits(moved, carried(*transfer, how)));
    CHECK(std::count_if(moved.begin(), moved.end(), [](double x) { return std::isnan(x); }) ==
          2 * transfer->n_unmapped());
  }
  const auto velocity = component.grid().gather(
      component.transfer_velocity(filled(former.local().edge_position(), 1)), Location::edge);
  if (transfer) {
    std::vector<double> expected(velocity.size());
    transfer->apply_velocity(filled(transfer->from().edge_position(), 1), expected);
    CHECK(same_bits(velocity, expected));
  }
  component.finalize();
}

int main(int argc, char** argv) {
  int level = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  const int failed = doctest::Context(argc, argv).run();
  MPI_Finalize();
  return failed;
}
