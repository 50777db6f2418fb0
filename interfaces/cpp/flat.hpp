// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The engine's rows as the plain numbers that hosts get.
#include <span>
#include <type_traits>

#include "core/array.hpp"

namespace delos::api {

/// Rows of plain numbers seen as the numbers; not copied.
template <class Number, class Row>
std::span<const Number> flat(std::span<const Row> rows) {
  static_assert(std::is_standard_layout_v<Row> && sizeof(Row) % sizeof(Number) == 0);
  return {reinterpret_cast<const Number*>(rows.data()), rows.size_bytes() / sizeof(Number)};
}

template <class Number, class Row>
std::span<const Number> flat(const Array<Row>& rows) {
  return flat<Number>(std::span<const Row>(rows));
}

}  // namespace delos::api
