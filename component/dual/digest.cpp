// SPDX-License-Identifier: BSD-3-Clause
#include "dual/digest.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
#include <vector>

#include "core/hash.hpp"

namespace delos {
namespace {

using Bytes = std::span<const std::byte>;

template <class T>
Bytes bytes(std::span<const T> values) {
  static_assert(std::endian::native == std::endian::little, "digests are over little-endian bytes");
  return std::as_bytes(values);
}

template <class T>
Bytes bytes(const Array<T>& values) {
  return bytes(std::span<const T>(values));
}

/// Nothing where the rows are those of a table that was counted before.
Bytes bytes(const RowOffsets& rows, const RowOffsets& before) {
  return rows == before ? Bytes() : bytes(rows.positions());
}

std::vector<Bytes> arrays_of(const Grid& grid) {
  const RowOffsets none, &of_cell = grid.edges_on_cell.offsets,
                         &of_edge = grid.edges_on_edge.offsets;
  return {bytes(grid.cell_position),
          bytes(grid.edge_position),
          bytes(grid.vertex_position),
          bytes(grid.cell_lon_lat),
          bytes(grid.edge_lon_lat),
          bytes(grid.vertex_lon_lat),
          bytes(of_cell, none),
          bytes(grid.edges_on_cell.values),
          bytes(grid.vertices_on_cell.offsets, of_cell),
          bytes(grid.vertices_on_cell.values),
          bytes(grid.cells_on_cell.offsets, of_cell),
          bytes(grid.cells_on_cell.values),
          bytes(grid.cells_on_edge),
          bytes(grid.vertices_on_edge),
          bytes(grid.cells_on_vertex),
          bytes(grid.edges_on_vertex),
          bytes(of_edge, none),
          bytes(grid.edges_on_edge.values),
          bytes(grid.cell_area_m2),
          bytes(grid.triangle_area_m2),
          bytes(grid.kite_area_m2),
          bytes(grid.cell_distance_m),
          bytes(grid.vertex_distance_m),
          bytes(grid.edge_angle_rad),
          bytes(grid.weights_on_edge.offsets, of_edge),
          bytes(grid.weights_on_edge.values),
          bytes(grid.cell_spacing_m)};
}

}  // namespace

std::string digest(parallel::Executor& exec, const Grid& grid) {
  constexpr std::size_t kLeafBytes = std::size_t{1} << 20;  // about 0.6 ms; part of the answer
  std::vector<Bytes> arrays = arrays_of(grid);
  if (!grid.cell_ring.empty()) arrays.push_back(bytes(grid.cell_ring));  // regional grids alone
  std::vector<Bytes> leaves;
  for (const Bytes array : arrays) {
    for (std::size_t begin = 0; begin < array.size(); begin += kLeafBytes) {
      leaves.push_back(array.subspan(begin, std::min(kLeafBytes, array.size() - begin)));
    }
  }
  std::vector<std::string> digests(leaves.size());
  parallel::for_index(exec, static_cast<std::int64_t>(leaves.size()), 1, [&](std::int64_t i) {
    Digest leaf;
    leaf.add(leaves[static_cast<std::size_t>(i)]);
    digests[static_cast<std::size_t>(i)] = leaf.hex();
  });

  Digest all;
  const Vec3 radii_m = grid.surface.scale_m() * grid.surface.radii();
  all.add(radii_m.data(), sizeof(Vec3));
  all.add(grid.surface.centre_m().data(), sizeof(Vec3));
  for (const Bytes array : arrays) {
    const std::uint64_t n = array.size();
    all.add(&n, sizeof n);
  }
  for (const std::string& leaf : digests) all.add(leaf.data(), leaf.size());
  return all.hex();
}

std::string digest(const Grid& grid) {
  parallel::Executor one(1);
  return digest(one, grid);
}

}  // namespace delos
