// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The items of a distributed component's states.
#include <cstddef>
#include <string>
#include <vector>

#include "delos/distributed.hpp"

namespace delos::mpi {

[[noreturn]] void refuse(const std::string& message);

/// An item of a state, with what this process has of it.
struct Item {
  FieldInfo info;
  std::vector<double> values;
  bool is_given = false;  ///< an import's values, since the last run
};

/// A state's items as one text, and back.
std::string list_of(const State& state);
std::vector<Item> items_of(const std::string& list);

/// Which one; Error(state) that names those there are.
std::size_t find_item(const std::vector<Item>& items, const std::string& name, const char* intent);

/// Whether each process has values of its own.
bool is_spread(Location location);

}  // namespace delos::mpi
