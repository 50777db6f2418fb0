// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/face_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "dual/polygons.hpp"

namespace delos {
namespace {

// Ids of the nodes that cells have, in the order of the file; kNone for others.
std::vector<Index> used_nodes(const FaceMesh& faces) {
  std::vector<Index> new_id(faces.node.size(), kNone);
  for (const Index node : faces.nodes_on_face.values) new_id[at(node)] = 0;
  Index n = 0;
  for (Index& id : new_id) {
    if (id != kNone) id = n++;
  }
  return new_id;
}

bool is_clockwise(const CellPolygons& cells, std::int64_t cell) {
  const auto row = cells.corners_on_cell.row(cell);
  double turn = 0.0;
  for (std::size_t j = 0; j < row.size(); ++j) {
    const Vec3& before = cells.corner[at(row[j == 0 ? row.size() - 1 : j - 1])];
    turn += before.cross(cells.corner[at(row[j])]).dot(cells.centre[at(cell)]);
  }
  return turn < 0.0;
}

using NodePair = std::array<Index, 2>;

NodePair in_order(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

void take_edge_spacing(const UgridMesh& file, const std::vector<Index>& new_id, Grid& grid) {
  std::vector<std::pair<NodePair, double>> known;
  for (std::size_t i = 0; i < file.nodes_on_edge.size(); ++i) {
    const auto [a, b] = file.nodes_on_edge[i];
    known.push_back({in_order(new_id[at(a)], new_id[at(b)]), file.edge_spacing_m[i]});
  }
  std::sort(known.begin(), known.end());
  grid.edge_spacing_m.resize(grid.vertices_on_edge.size());
  for (std::size_t edge = 0; edge < grid.vertices_on_edge.size(); ++edge) {
    const auto [a, b] = grid.vertices_on_edge[edge];
    const NodePair wanted = in_order(a, b);
    const auto found = std::lower_bound(
        known.begin(), known.end(), wanted,
        [](const auto& entry, const NodePair& nodes) { return entry.first < nodes; });
    const bool is_known = found != known.end() && found->first == wanted;
    DELOS_CHECK(is_known && std::isfinite(found->second) && found->second > 0.0, ErrorKind::input,
                "delos_edge_spacing has no value > 0 for an edge of cell ",
                grid.cells_on_edge[edge][0] + 1, " (from 1). The file is damaged.");
    grid.edge_spacing_m[edge] = found->second;
  }
}

}  // namespace

FaceGrid face_grid(parallel::Executor& exec, const Ellipsoid& surface, const FaceMesh& faces,
                   const UgridMesh* edges) {
  const std::vector<Index> new_id = used_nodes(faces);
  CellPolygons cells{surface, faces.latitude, {}, {}, faces.nodes_on_face};
  for (const LonLat& place : faces.face_centre) {
    cells.centre.push_back(surface.point(place, faces.latitude));
  }
  for (std::size_t node = 0; node < new_id.size(); ++node) {
    if (new_id[node] != kNone)
      cells.corner.push_back(surface.point(faces.node[node], faces.latitude));
  }
  for (Index& node : cells.corners_on_cell.values) node = new_id[at(node)];
  FaceGrid out;
  for (std::int64_t cell = 0; cell < cells.corners_on_cell.offsets.n_rows(); ++cell) {
    if (!is_clockwise(cells, cell)) continue;
    std::ranges::reverse(cells.corners_on_cell.row(cell));
    ++out.n_turned;
  }
  out.grid = grid_of_polygons(exec, cells);
  out.grid.cell_ring.assign(faces.face_ring.begin(), faces.face_ring.end());
  if (edges != nullptr && !edges->edge_spacing_m.empty()) {
    take_edge_spacing(*edges, new_id, out.grid);
  }
  return out;
}

}  // namespace delos
