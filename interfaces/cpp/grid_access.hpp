// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How the adapters make a Grid.
#include <memory>
#include <utility>

#include "delos/grid.hpp"
#include "lifecycle/generate.hpp"

namespace delos::api {

struct Grid::Impl {
  Impl(std::shared_ptr<const Product> of_grid, std::int64_t number)
      : owner(std::move(of_grid)), product(*owner), generation(number) {}
  std::shared_ptr<const Product> owner;
  const Product& product;  // with its dual
  std::int64_t generation;
  std::int64_t max_edges = 0;
  Quality quality{};
  Certificate certificate{};
  std::string report, report_json;
};

struct GridAccess {
  static Grid make(std::shared_ptr<const Product> product, std::int64_t generation);
  static const Product& product(const Grid& grid) { return grid.impl_->product; }
};

}  // namespace delos::api
