// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The wanted spacing at the edges of a grid: what its certificate is about, beside the arrays.
#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "geometry/ellipsoid.hpp"
#include "metrics/quality.hpp"
#include "sizing/spacing.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

using EdgeList = std::span<const std::array<Index, 2>>;

/// A spacing field where it lives.
struct SpacingOnSurface {
  const Ellipsoid& surface;
  const SpacingField& field;
  std::span<const Vertex> cells;  ///< on that surface
};

/// The field at the projected middle of the two cells of every edge, times unit(middle): the
/// metres of a scaled length there.
Array<double> spacing_at_edges(parallel::Executor& exec, const SpacingOnSurface& spacing,
                               EdgeList cells_on_edge,
                               const std::function<double(const Vec3&)>& unit);

/// How the two ends of an edge in a file are named.
enum class EdgeEnds { vertices, triangles };

/// What a file says about its edges, in any order.
struct FileEdges {
  EdgeList edges;
  EdgeEnds ends;
  std::span<const double> spacing_m;
};

/// The spacing (scaled) by side of the mesh's triangles; owns what it needs. Error(input), naming
/// the edge, when the mesh has a side that is not in the list or a value is not > 0.
SideSpacing spacing_by_side(const Mesh& mesh, const FileEdges& file, double scale_m);

}  // namespace delos
