// SPDX-License-Identifier: BSD-3-Clause
#include "domain/ocean.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "domain/bodies.hpp"
#include "domain/passages.hpp"
#include "domain/tips.hpp"
#include "domain/transects.hpp"
#include "sizing/analytic.hpp"

namespace delos::domain {
namespace {

constexpr std::int64_t kOceanGrain = 4096;  // cells; tenths of a millisecond

struct Chain {
  const LonLatLine& line;
  std::vector<Index> cells;
};

std::vector<Chain> chains_of(const Grid& grid, const std::vector<LonLatLine>& lines) {
  std::vector<Chain> out;
  out.reserve(lines.size());
  for (const LonLatLine& line : lines) out.push_back({line, cells_along(grid, line)});
  return out;
}

std::vector<LineReport> set_cells(const std::vector<Chain>& chains, bool is_sea, Mask& sea) {
  std::vector<LineReport> reports;
  for (const Chain& chain : chains) {
    LineReport report;
    report.name = chain.line.name;
    report.n_cells = static_cast<std::int64_t>(chain.cells.size());
    for (const Index cell : chain.cells) {
      report.n_changed += (sea[at(cell)] != 0) != is_sea;
      sea[at(cell)] = is_sea;
    }
    reports.push_back(std::move(report));
  }
  return reports;
}

std::vector<std::vector<Index>> cells_of(const std::vector<Chain>& chains) {
  std::vector<std::vector<Index>> out;
  out.reserve(chains.size());
  for (const Chain& chain : chains) out.push_back(chain.cells);
  return out;
}

void judge_passages(const std::vector<Chain>& chains, const Mask& sea,
                    std::vector<LineReport>& reports) {
  for (std::size_t i = 0; i < chains.size(); ++i) {
    reports[i].holds = std::all_of(chains[i].cells.begin(), chains[i].cells.end(),
                                   [&](Index cell) { return sea[at(cell)] != 0; });
  }
}

void judge_blockages(const Grid& grid, const std::vector<Chain>& chains, const Mask& sea,
                     std::vector<LineReport>& reports) {
  const auto is_open = [&](const Link& link) {
    return sea[at(link[0])] != 0 && sea[at(link[1])] != 0;
  };
  for (std::size_t i = 0; i < chains.size(); ++i) {
    const std::vector<Link> links = links_across(grid, chains[i].line, chains[i].cells);
    reports[i].holds = std::none_of(links.begin(), links.end(), is_open);
  }
}

// Where a passage runs through cells of a blockage, the cells across the blockage's line are shut
// in their place; a link between two passage cells stays open.
void shut_beside_passages(const Grid& grid, const std::vector<Chain>& blockages,
                          const Mask& is_passage, Mask& sea, std::vector<LineReport>& reports) {
  for (std::size_t i = 0; i < blockages.size(); ++i) {
    const std::vector<Index>& cells = blockages[i].cells;
    reports[i].n_shared = std::count_if(cells.begin(), cells.end(),
                                        [&](Index cell) { return is_passage[at(cell)] != 0; });
    if (reports[i].n_shared == 0) continue;
    for (const auto& [a, b] : links_across(grid, blockages[i].line, cells)) {
      if (sea[at(a)] == 0 || sea[at(b)] == 0 || (is_passage[at(a)] && is_passage[at(b)])) continue;
      sea[at(is_passage[at(a)] != 0 ? b : a)] = 0;
      ++reports[i].n_changed;
    }
  }
}

Index named_body(const Grid& grid, const Bodies& bodies, const LonLat& point) {
  const Index cell = cell_at(grid, grid.surface.point(point, grid.latitude));
  const Index body = bodies.of_cell[at(cell)];
  DELOS_CHECK(
      body != kNone, ErrorKind::input, "the body of water at lon ", point.lon_rad * kDegPerRad,
      ", lat ", point.lat_rad * kDegPerRad, " deg is not there: cell ", cell,
      " is land. Give a point in open water, or lower the wet share that makes a cell sea.");
  return body;
}

std::vector<char> bodies_kept(const Grid& grid, const Bodies& bodies, const OceanOptions& options) {
  std::vector<char> is_kept(bodies.bodies.size(), options.bodies == BodyRule::all ? 1 : 0);
  if (options.bodies == BodyRule::largest) is_kept[at(largest_body(bodies))] = 1;
  if (options.bodies == BodyRule::named) {
    for (const LonLat& point : options.body_points) {
      is_kept[at(named_body(grid, bodies, point))] = 1;
    }
  }
  return is_kept;
}

// The cells of the bodies that are kept.
Mask kept_of(const Grid& grid, const OceanOptions& options, const Mask& sea) {
  const Bodies bodies = find_bodies(grid, sea);
  Mask kept(sea.size(), 0);
  if (bodies.bodies.empty()) return kept;
  const std::vector<char> is_kept = bodies_kept(grid, bodies, options);
  for (std::size_t cell = 0; cell < kept.size(); ++cell) {
    const Index body = bodies.of_cell[cell];
    kept[cell] = body != kNone && is_kept[at(body)] != 0;
  }
  return kept;
}

void keep_bodies(parallel::Executor& exec, const Grid& grid, const OceanOptions& options, Mask& sea,
                 OceanReport& report) {
  const Bodies bodies = find_bodies(grid, sea);
  DELOS_CHECK(!bodies.bodies.empty(), ErrorKind::input,
              "no cell of the grid is sea: check the sign of the elevation and the wet share that "
              "makes a cell sea.");
  const std::vector<char> is_kept = bodies_kept(grid, bodies, options);
  parallel::for_index(exec, grid.n_cells(), kOceanGrain, [&](std::int64_t cell) {
    const Index body = bodies.of_cell[at(cell)];
    sea[at(cell)] = body != kNone && is_kept[at(body)] != 0;
  });
  report.n_bodies = static_cast<std::int64_t>(bodies.bodies.size());
  for (std::size_t i = 0; i < is_kept.size(); ++i) {
    if (is_kept[i] != 0) {
      ++report.n_bodies_kept;
    } else {
      report.n_cells_of_other_bodies += bodies.bodies[i].n_cells;
    }
  }
}

void count_elements(parallel::Executor& exec, const Grid& ocean, OceanReport& report) {
  report.n_cells = ocean.n_cells();
  report.n_edges = ocean.n_edges();
  report.n_vertices = ocean.n_vertices();
  report.n_border_edges = std::count_if(ocean.cells_on_edge.begin(), ocean.cells_on_edge.end(),
                                        [](const auto& cells) { return cells[1] == kNone; });
  report.area_m2 = parallel::sum(exec, ocean.n_cells(), kOceanGrain,
                                 [&](std::int64_t cell) { return ocean.cell_area_m2[at(cell)]; });
}

}  // namespace

Ocean select_ocean(parallel::Executor& exec, const Grid& grid, const Array<double>& wet_fraction,
                   const OceanOptions& options) {
  Ocean out;
  OceanReport& report = out.report;
  std::vector<Chain> passages = chains_of(grid, options.passages);
  const std::vector<Chain> blockages = chains_of(grid, options.blockages);
  Mask sea = wet_cells(exec, wet_fraction, options.least_wet);
  if (options.tip_margin > 0.0) {
    report.n_tips_cleared = clear_tips(
        {wet_fraction, options.least_wet, options.tip_margin},
        [&](Index cell, std::vector<Index>& around) {
          const auto row = grid.cells_on_cell.row(cell);
          around.assign(row.begin(), row.end());
        },
        sea);
  }
  Mask is_shut(sea.size(), 0);
  set_cells(blockages, true, is_shut);
  report.blockages = set_cells(blockages, false, sea);
  for (Chain& passage : passages) passage.cells = led_around(grid, passage.cells, is_shut, sea);
  report.passages = set_cells(passages, true, sea);
  Mask is_passage(sea.size(), 0);
  set_cells(passages, true, is_passage);
  shut_beside_passages(grid, blockages, is_passage, sea, report.blockages);
  const Mask before = sea;
  report.pruned = prune(exec, grid, options.prune, is_passage, sea);
  report.n_cells_given_back =
      join_passages(grid, {before, [&](const Mask& mask) { return kept_of(grid, options, mask); }},
                    cells_of(passages), sea);
  keep_bodies(exec, grid, options, sea, report);
  judge_passages(passages, sea, report.passages);
  judge_blockages(grid, blockages, sea, report.blockages);
  report.coast = measure_coast(exec, grid, sea, wet_fraction, options.least_wet);
  out.culled = cull(exec, grid, order_cells(exec, grid, sea, options.order, options.n_parts));
  count_elements(exec, out.culled.grid, report);
  return out;
}

LatLonField elevation_of(parallel::Executor& exec, const PolygonSet& land, double resolution_rad) {
  DELOS_CHECK(!land.rings.empty(), ErrorKind::input, land.source,
              " holds no polygon: check the file and the feature's name");
  LatLonField field = unset_table(resolution_rad);
  const std::vector<char> inside = inside_polygons(exec, land, field);
  parallel::for_index(
      exec, static_cast<std::int64_t>(inside.size()), kOceanGrain,
      [&](std::int64_t i) { field.values[at(i)] = inside[at(i)] != 0 ? 1.0 : -1.0; });
  return field;
}

}  // namespace delos::domain
