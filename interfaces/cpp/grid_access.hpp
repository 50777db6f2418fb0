// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How the adapters make a Grid.
#include <utility>

#include "delos/grid.hpp"
#include "lifecycle/generate.hpp"

namespace delos::api {

struct Grid::Impl {
  Product product;  // with its dual
  std::int64_t generation = 1;
  std::int64_t max_edges = 0;
  Quality quality{};
  Certificate certificate{};
  std::string report, report_json;
};

struct GridAccess {
  static Grid make(Product product);
};

}  // namespace delos::api
