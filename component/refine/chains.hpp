// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Chains of vertices along the arcs of given lines, at equal h-mass.
#include <functional>
#include <span>
#include <vector>

#include "refine/line_network.hpp"
#include "triangulation/mesh.hpp"

namespace delos {

struct Chain {
  std::vector<Index> points;  ///< ids in ChainSet::vertices, from node to node
  Index line;                 ///< the given line that it is a part of
};

struct ChainSet {
  Array<Vertex> vertices;      ///< the network's nodes, then what lies along its arcs
  std::vector<char> is_sharp;  ///< of the nodes
  std::vector<Chain> chains;   ///< one an arc

  Index n_nodes() const { return static_cast<Index>(is_sharp.size()); }
  /// All edges as ends of a mesh whose first vertices these are.
  FixedEdges fixed_edges() const;
};

ChainSet make_chains(const Ellipsoid& surface, const SpacingField& spacing,
                     const LineNetwork& network);

/// Halves every edge that `is_missing(a, b)` names, and returns how many. Next to a node where arcs
/// meet at a small angle the new vertex goes where a power of two lies between a third and two
/// thirds of the edge, so that all arcs there are cut at the same distances and need not cut each
/// other again and again (concentric shells: Ruppert 1995, doi:10.1006/jagm.1995.1021).
std::size_t halve_edges(const Ellipsoid& surface, const SpacingField& spacing,
                        const std::function<bool(Index, Index)>& is_missing, ChainSet& chains);

/// Error(input) when a side of the Delaunay mesh, whose first vertices are the chains', joins two
/// that are too near to each other and on no neighbouring chains. The nearest vertex is always a
/// neighbour in that mesh.
void check_distances(const Ellipsoid& surface, const LineNetwork& network, const ChainSet& chains,
                     const Mesh& mesh);

/// Where [0, n] is cut into pieces of equal mass, as near to one each as a whole number of pieces
/// allows; mass[i]: up to i, ascending from 0.
std::vector<double> equal_mass_cuts(std::span<const double> mass);

}  // namespace delos
