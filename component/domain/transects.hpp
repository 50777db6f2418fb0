// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Lines on the map as chains of cells.
#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "domain/mask.hpp"
#include "dual/grid.hpp"
#include "geometry/lines.hpp"

namespace delos::domain {

/// The cell whose centre is nearest to a surface point: its Voronoi cell. Walks over neighbours,
/// from the nearest of some hundred cells spread over the grid. On a grid with a border the walk
/// may end there, before a nearer cell behind a gap.
Index cell_at(const Grid& grid, const Vec3& point);

/// The cells that a line runs through, in the order in which it enters them, each once. They hang
/// together by edges: water in all of them joins the line's ends, and land in all of them parts its
/// sides. The line is followed in steps of a quarter of the cells' width. On a closed grid.
std::vector<Index> cells_along(const Grid& grid, const LonLatLine& line);

/// Two neighbouring cells, lower first.
using Link = std::array<Index, 2>;

/// The links whose centres the line parts, ascending: what would flow through it. `chain` is
/// cells_along of the line. A line between two cells' centres that ends on the link counts.
std::vector<Link> links_across(const Grid& grid, const LonLatLine& line,
                               const std::vector<Index>& chain);

/// A question about a cell.
using CellTest = std::function<bool(Index)>;

/// The fewest cells that lead from one of `from` to a goal: open ones, `most` at the most, and the
/// goal as the last. Nothing when there is no such way. Neighbours in the order of their lists.
std::optional<std::vector<Index>> shortest_way(
    const Grid& grid, const std::vector<Index>& from, const CellTest& is_goal,
    const CellTest& is_open, std::size_t most = std::numeric_limits<std::size_t>::max());

/// The chain led around the cells of `shut`, where a few cells of `sea` go around them: at most
/// four more than twice those that are in the way. Elsewhere it goes through. Where it begins or
/// ends in shut cells it becomes shorter;
/// one that is shut from end to end runs beside them.
std::vector<Index> led_around(const Grid& grid, const std::vector<Index>& chain, const Mask& shut,
                              const Mask& sea);

}  // namespace delos::domain
