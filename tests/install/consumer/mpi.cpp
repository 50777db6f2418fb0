// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <delos/mpi.hpp>

int main(int argc, char** argv) {
  int level = 0, status = 1;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  {
    const auto grid = delos::mpi::generate(MPI_COMM_WORLD, [] {
      return delos::Config::from_text("generator: icosahedral\nsubdivisions: 4\n");
    });
    status = grid.local().n_owned(delos::Location::cell) == 162 ? 0 : 1;
  }
  MPI_Finalize();
  if (status == 0) std::puts("mpi consumer: one process owns all cells");
  return status;
}
