// SPDX-License-Identifier: BSD-3-Clause
#include "domain/limited_area.hpp"

#include "core/error.hpp"

namespace delos::domain {
namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

// The neighbours of `front` without a ring get the next one.
std::vector<Index> next_ring(const Grid& grid, const std::vector<Index>& front, int ring,
                             std::vector<std::int32_t>& ring_of) {
  std::vector<Index> found;
  for (const Index cell : front) {
    for (const Index other : grid.cells_on_cell.row(cell)) {
      if (other == kNone || ring_of[at(other)] >= 0) continue;
      ring_of[at(other)] = ring;
      found.push_back(other);
    }
  }
  return found;
}

}  // namespace

LimitedArea limited_area(const Grid& grid, std::span<const char> inside) {
  DELOS_CHECK(static_cast<std::int64_t>(inside.size()) == grid.n_cells(), ErrorKind::internal,
              "the mask of the region has ", inside.size(), " entries for ", grid.n_cells(),
              " cells.");
  std::vector<std::int32_t> ring_of(inside.size(), -1);
  std::vector<Index> front;
  for (std::size_t cell = 0; cell < inside.size(); ++cell) {
    if (inside[cell] == 0) continue;
    ring_of[cell] = 0;
    front.push_back(static_cast<Index>(cell));
  }
  DELOS_CHECK(!front.empty(), ErrorKind::input,
              "no cell has its centre in the region. Make it larger, or the spacing finer.");
  for (int ring = 1; ring <= kBoundaryRings; ++ring) {
    front = next_ring(grid, front, ring, ring_of);
    DELOS_CHECK(!front.empty(), ErrorKind::input, "the region leaves no room for ring ", ring,
                " of the ", kBoundaryRings, " around it. Make it smaller, or the spacing finer.");
  }
  LimitedArea out;
  for (std::size_t cell = 0; cell < ring_of.size(); ++cell) {
    if (ring_of[cell] < 0) continue;
    out.cells.push_back(static_cast<Index>(cell));
    out.ring.push_back(ring_of[cell]);
    ++out.n_cells[at(ring_of[cell])];
  }
  return out;
}

}  // namespace delos::domain
