// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/edge_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "core/error.hpp"

namespace delos {
namespace {

constexpr std::int64_t kEdgeGrain = 4096;  // about 0.1 ms of look-ups

std::array<Index, 2> sorted(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

std::array<Index, 2> ends_of(const Mesh& mesh, Index tri, int k, EdgeEnds ends) {
  const Triangle& triangle = mesh.triangle(tri);
  return ends == EdgeEnds::vertices
             ? sorted(triangle.vertex[at(next_corner(k))], triangle.vertex[at(previous_corner(k))])
             : sorted(tri, triangle.neighbour[at(k)]);
}

/// Whether the side is not of two cells, so that the file has no edge for it, or one of no spacing.
bool is_at_border(const Mesh& mesh, Index tri, int k, EdgeEnds ends) {
  const Triangle& triangle = mesh.triangle(tri);
  if (ends == EdgeEnds::triangles) return triangle.neighbour[at(k)] == kNone;
  return triangle.vertex[at(next_corner(k))] == kNone ||
         triangle.vertex[at(previous_corner(k))] == kNone;
}

}  // namespace

Array<double> spacing_at_edges(parallel::Executor& exec, const SpacingOnSurface& spacing,
                               EdgeList cells_on_edge,
                               const std::function<double(const Vec3&)>& unit) {
  Array<double> out(cells_on_edge.size());
  const auto n_edges = static_cast<std::int64_t>(out.size());
  parallel::for_range(exec, n_edges, kEdgeGrain, [&](std::int64_t begin, std::int64_t end) {
    std::vector<Vertex> middles(at(end - begin));
    for (std::int64_t edge = begin; edge < end; ++edge) {
      const auto [a, b] = cells_on_edge[at(edge)];
      const Vec3 middle = spacing.surface.project(spacing.cells[at(a)].position() +
                                                  spacing.cells[at(b)].position());
      middles[at(edge - begin)] = {middle.x(), middle.y(), middle.z(), 0.0};
    }
    spacing.field.evaluate(middles);
    for (std::int64_t edge = begin; edge < end; ++edge) {
      const Vertex& middle = middles[at(edge - begin)];
      out[at(edge)] = middle.spacing * unit(middle.position());
    }
  });
  return out;
}

SideSpacing spacing_by_side(const Mesh& mesh, const FileEdges& file, double scale_m) {
  const EdgeList edges = file.edges;
  std::vector<std::size_t> order(edges.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto key = [&](std::size_t edge) { return sorted(edges[edge][0], edges[edge][1]); };
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  auto by_side = std::make_shared<std::vector<std::array<double, 3>>>(mesh.triangles.size());
  for (Index tri = 0; tri < mesh.n_triangles(); ++tri) {
    for (int k = 0; k < 3; ++k) {
      if (is_at_border(mesh, tri, k, file.ends)) continue;
      const auto wanted = ends_of(mesh, tri, k, file.ends);
      const auto found =
          std::lower_bound(order.begin(), order.end(), wanted,
                           [&](std::size_t edge, const auto& ids) { return key(edge) < ids; });
      DELOS_CHECK(found != order.end() && key(*found) == wanted, ErrorKind::input, "the edge of ",
                  file.ends == EdgeEnds::vertices ? "cells " : "triangles ", wanted[0] + 1, " and ",
                  wanted[1] + 1, " (from 1) is not in the list of edges. The file is damaged.");
      const double spacing_m = file.spacing_m[*found];
      DELOS_CHECK(std::isfinite(spacing_m) && spacing_m > 0.0, ErrorKind::input,
                  "delos_edge_spacing is ", spacing_m, " at edge ", *found + 1,
                  " (from 1): must be > 0. The file is damaged.");
      (*by_side)[at(tri)][at(k)] = spacing_m / scale_m;
    }
  }
  return [by_side](Index tri, int k) { return (*by_side)[at(tri)][at(k)]; };
}

}  // namespace delos
