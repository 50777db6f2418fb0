// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the tests on many processes have in common.
#include <mpi.h>

#include <algorithm>
#include <delos/delos.hpp>
#include <exception>
#include <iterator>
#include <string>

namespace mpi_support {

inline int rank() {
  int out = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &out);
  return out;
}
inline int n_ranks() {
  int out = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &out);
  return out;
}

/// The kind and text of what action() throws, e.g. "config: ...".
template <class Action>
std::string thrown(Action&& action) {
  try {
    action();
  } catch (const delos::Error& error) {
    return std::string(delos::to_string(error.kind())) + ": " + error.what();
  } catch (const std::exception& error) {
    return std::string("other: ") + error.what();
  }
  return "nothing";
}

inline bool begins(const std::string& text, const std::string& with) {
  return text.rfind(with, 0) == 0;
}

/// Whether all processes have the same text.
inline bool is_same_everywhere(const std::string& text) {
  char mine[1000] = {}, first[1000] = {};
  text.copy(mine, sizeof mine - 1);
  std::copy(std::begin(mine), std::end(mine), std::begin(first));
  MPI_Bcast(first, sizeof first, MPI_CHAR, 0, MPI_COMM_WORLD);
  return std::equal(std::begin(mine), std::end(mine), std::begin(first));
}

}  // namespace mpi_support
