// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/region.hpp"

#include <algorithm>

#include "domain/limited_area.hpp"
#include "domain/order.hpp"

namespace delos {
namespace {

domain::Mask has_ring(const Grid& grid) {
  domain::Mask out(grid.cell_ring.size());
  std::transform(grid.cell_ring.begin(), grid.cell_ring.end(), out.begin(), [](std::int32_t ring) {
    return static_cast<std::uint8_t>(ring != kNone ? 1 : 0);
  });
  return out;
}

void warn_of(const Context& context, const domain::LimitedArea& area) {
  std::int64_t n_in_rings = 0;
  for (std::size_t ring = 1; ring < area.n_cells.size(); ++ring) n_in_rings += area.n_cells[ring];
  if (area.n_cells[0] < n_in_rings) {
    context.monitor.log(LogLevel::warning,
                        text("the region has ", area.n_cells[0], " cells inside and ", n_in_rings,
                             " in the rings around it: it is small for its spacing."));
  }
  if (area.n_parts > 1) {
    context.monitor.log(LogLevel::warning,
                        text("the region is in ", area.n_parts, " parts that no cell joins."));
  }
}

}  // namespace

void mark_region(Context& context, const RegionSource& source, Grid& grid) {
  std::vector<char> inside = inside_region(context.exec, *source.inputs.region, grid.cell_lon_lat);
  // Rounding decides on which side of the outline its own vertices are.
  for (Index cell = 0; source.outline != nullptr && cell < grid.n_cells(); ++cell) {
    if (source.outline->has_vertex(cell)) inside[static_cast<std::size_t>(cell)] = 1;
  }
  domain::LimitedArea area =
      domain::limited_area(context.exec, grid, inside, source.settings.region->rings);
  warn_of(context, area);
  grid.cell_ring = std::move(area.ring);
}

DomainIds cull_to_region(Context& context, Grid& grid) {
  const std::vector<Index> cells =
      domain::order_cells(context.exec, grid, has_ring(grid), domain::CellOrder::hilbert);
  return cull_to_cells(context, cells, grid);
}

void tell_of_region(Context& context, const Settings& settings, const Grid& grid,
                    std::int64_t n_made, Report& report) {
  const domain::RingWidths& rings = settings.region->rings;
  std::int64_t n_inside = 0, n_relaxation = 0;
  for (const std::int32_t ring : grid.cell_ring) {
    n_inside += ring == 0 ? 1 : 0;
    n_relaxation += ring > 0 && ring <= rings.relaxation ? 1 : 0;
  }
  double area_m2 = 0.0;
  for (const double area : grid.cell_area_m2) area_m2 += area;
  const std::int64_t n_specified = grid.n_cells() - n_inside - n_relaxation;
  context.monitor.log(LogLevel::info,
                      text("region: ", grid.n_cells(), " of ", n_made, " cells, ", n_inside,
                           " inside, ", n_relaxation, " and ", n_specified, " in the rings"));
  report.sections.push_back({"region",
                             {{"n_cells", grid.n_cells()},
                              {"n_inside", n_inside},
                              {"n_relaxation", n_relaxation},
                              {"n_specified", n_specified},
                              {"n_cells_made", n_made},
                              {"area_m2", area_m2}}});
}

}  // namespace delos
