// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One table into a netCDF file, block after block, converted beside the writing.
#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "io/blocks.hpp"
#include "io/netcdf.hpp"

namespace delos {

/// Which variable, and its shape: [rows] when width is 0, else [rows, width].
struct RowTable {
  netcdf::VariableId variable;
  std::int64_t rows = 0;
  std::size_t width = 0;
};

/// fill(row, values) sets the `width` values (one, when width is 0) of each row.
template <class T, class Fill>
void put_rows(parallel::Executor& exec, netcdf::Writer& file, const RowTable& table, Fill&& fill) {
  constexpr std::int64_t kBlockRows = 65536;  // a few megabytes
  const std::size_t width = std::max<std::size_t>(table.width, 1);
  const auto rows_of = [&](std::int64_t k) {
    return std::min(kBlockRows, table.rows - k * kBlockRows);
  };
  const auto convert = [&](std::vector<T>& block, std::int64_t k) {
    block.resize(static_cast<std::size_t>(rows_of(k)) * width);
    parallel::for_index(exec, rows_of(k), kConvertGrain, [&](std::int64_t row) {
      fill(k * kBlockRows + row,
           std::span(block).subspan(static_cast<std::size_t>(row) * width, width));
    });
  };
  const auto put = [&](const std::vector<T>& block, std::int64_t k) {
    const std::array<std::size_t, 2> start = {static_cast<std::size_t>(k * kBlockRows), 0};
    const std::array<std::size_t, 2> count = {static_cast<std::size_t>(rows_of(k)), width};
    const std::size_t rank = table.width == 0 ? 1 : 2;
    file.put_block(table.variable, std::span(start).first(rank), std::span(count).first(rank),
                   std::span<const T>(block));
  };
  stream_blocks<std::vector<T>>(exec, (table.rows + kBlockRows - 1) / kBlockRows, convert, put);
}

}  // namespace delos
