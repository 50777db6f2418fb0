// SPDX-License-Identifier: BSD-3-Clause
#include "domain/limited_area.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "domain/bodies.hpp"

namespace delos::domain {
namespace {

// The neighbours of `front` without a ring get the next one.
std::vector<Index> next_ring(const Grid& grid, const std::vector<Index>& front, int ring,
                             Array<std::int32_t>& ring_of) {
  std::vector<Index> found;
  for (const Index cell : front) {
    for (const Index other : grid.cells_on_cell.row(cell)) {
      if (other == kNone || ring_of[at(other)] != kNone) continue;
      ring_of[at(other)] = ring;
      found.push_back(other);
    }
  }
  return found;
}

Mask turned(const Mask& mask) {
  Mask out(mask.size());
  std::transform(mask.begin(), mask.end(), out.begin(), [](std::uint8_t in) { return 1 - in; });
  return out;
}

// Hanging cells are bays of what they hang on.
void drop_hanging(parallel::Executor& exec, const Grid& grid, const Mask& keep, Mask& mask) {
  PruneOptions bays;
  bays.bays = true;
  prune(exec, grid, bays, keep, mask);
}

Mask even_inside(parallel::Executor& exec, const Grid& grid, std::span<const char> inside) {
  Mask mask(inside.size());
  std::transform(inside.begin(), inside.end(), mask.begin(),
                 [](char in) { return static_cast<std::uint8_t>(in != 0 ? 1 : 0); });
  const Mask none(mask.size(), 0);
  drop_hanging(exec, grid, none, mask);
  Mask outside = turned(mask);
  drop_hanging(exec, grid, none, outside);
  return turned(outside);
}

// The last ring without its hanging cells.
void trim_border(parallel::Executor& exec, const Grid& grid, int last_ring,
                 Array<std::int32_t>& ring_of) {
  Mask keep(ring_of.size()), mask(ring_of.size());
  for (std::size_t cell = 0; cell < mask.size(); ++cell) {
    mask[cell] = ring_of[cell] != kNone ? 1 : 0;
    keep[cell] = mask[cell] != 0 && ring_of[cell] < last_ring ? 1 : 0;
  }
  drop_hanging(exec, grid, keep, mask);
  for (std::size_t cell = 0; cell < mask.size(); ++cell) {
    if (mask[cell] == 0) ring_of[cell] = kNone;
  }
}

}  // namespace

LimitedArea limited_area(parallel::Executor& exec, const Grid& grid, std::span<const char> inside,
                         const RingWidths& widths) {
  DELOS_CHECK(static_cast<std::int64_t>(inside.size()) == grid.n_cells(), ErrorKind::internal,
              "the mask of the region has ", inside.size(), " entries for ", grid.n_cells(),
              " cells.");
  const Mask even = even_inside(exec, grid, inside);
  LimitedArea out;
  out.ring.assign(even.size(), kNone);
  std::vector<Index> front;
  for (std::size_t cell = 0; cell < even.size(); ++cell) {
    if (even[cell] == 0) continue;
    out.ring[cell] = 0;
    front.push_back(static_cast<Index>(cell));
  }
  DELOS_CHECK(
      !front.empty(), ErrorKind::input,
      "the region (key `region`) is smaller than a few cells: of the ", grid.n_cells(),
      " cells of the grid ", std::count(inside.begin(), inside.end(), 1),
      " have their centres in it, which no more than single edges join. Make it larger, or the "
      "spacing finer.");
  for (int ring = 1; ring <= widths.total(); ++ring) {
    front = next_ring(grid, front, ring, out.ring);
    DELOS_CHECK(!front.empty(), ErrorKind::input, "the region leaves no room for ring ", ring,
                " of the ", widths.total(), " around it. Make it smaller, or the spacing finer.");
  }
  if (widths.total() > 0) trim_border(exec, grid, widths.total(), out.ring);
  out.n_cells.assign(at(widths.total() + 1), 0);
  Mask area(even.size(), 0);
  for (std::size_t cell = 0; cell < even.size(); ++cell) {
    if (out.ring[cell] == kNone) continue;
    ++out.n_cells[at(out.ring[cell])];
    area[cell] = 1;
  }
  out.n_parts = static_cast<std::int64_t>(find_bodies(grid, area).bodies.size());
  return out;
}

}  // namespace delos::domain
