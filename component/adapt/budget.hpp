// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// How many vertices a remesh comes to, foretold before it is done, and a spacing that gives another
// number by changing what is made anew alone.
#include <optional>

#include "adapt/remesh.hpp"
#include "core/array.hpp"
#include "dual/grid.hpp"

namespace delos {

/// What a mesh of a plan whose region passes is made for: the wanted spacing where its share is 1,
/// that of the old mesh, `before`, where it is 0, and between them as much of each. On the nodes of
/// the table of `wanted`.
SpacingField followed_spacing(parallel::Executor& exec, const Grid& grid, const Region& region,
                              const SpacingField& before, const SpacingField& wanted);

/// Where a plan makes a mesh anew: the share of each node's surroundings, 0 to 1, on the nodes of
/// the table of `spacing` (of a constant, one of 1 degree). `grid` is the dual of the plan's mesh.
LatLonField share_made_anew(parallel::Executor& exec, const Grid& grid, const Region& region,
                            const SpacingField& spacing);

/// The spacing times 1 + (factor - 1) share, node by node: unchanged where nothing is made anew.
SpacingField scaled_where_anew(parallel::Executor& exec, const Ellipsoid& surface,
                               const SpacingField& spacing, const LatLonField& share,
                               double factor);

/// The number of vertices of a remesh by a plan. A vertex that goes stood for an area in which the
/// new spacing has room for (old / new spacing)^2 vertices; that the mesh of now has a few more or
/// less than its spacing let expect is in it, since the next one has alike. The same bits for any
/// number of threads.
class CountForecast {
 public:
  CountForecast(parallel::Executor& exec, const RemeshInput& input, const RemeshPlan& plan);

  /// From now on the factor acts as in scaled_where_anew(); before, on all that is made anew.
  void restrict_to(const Ellipsoid& surface, const SpacingField& spacing, const LatLonField& share);

  /// With the spacing there times `factor`.
  double at(double factor) const;
  /// The factor for a count, within `most` and 1 / most; none when it lies beyond.
  std::optional<double> factor_for(double count, double most) const;

 private:
  parallel::Executor& exec_;
  double n_kept_ = 0.0;
  Array<Vertex> places_;  ///< of the vertices that go, with the new spacing
  Array<double> room_;    ///< (old / new spacing)^2 of each
  Array<double> share_;   ///< how much of the factor acts on it; empty: all
};

}  // namespace delos
