// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The rotating shallow-water equations on a C-grid: the mimetic scheme TRiSK (Ringler et al. 2010,
// doi:10.1016/j.jcp.2009.12.007), energy conserving in space, with RK4 in time. One thing is new:
// the kinetic energy of a cell, sum of dc dv u^2 / 4, is not that of a uniform wind where dual
// edges have their middles elsewhere than edges; dv s u v / 2 more makes it so, s the distance
// between the middles and v the tangential velocity.
#include <cstddef>
#include <cstdint>
#include <delos/delos.hpp>
#include <optional>
#include <span>
#include <vector>

namespace shallow_water {

struct Physics {
  double gravity_m_s2 = 9.80616;
  double rotation_rad_s = 7.292e-5;
  /// Anticipation of potential vorticity, in steps (Sadourny & Basdevant 1985): with 0 the scheme
  /// lets it pile up at the scale of the grid, 0.5 takes away what does. Energy is kept with any.
  double anticipation = 0.0;
};

/// What the equations advance.
struct Flow {
  std::vector<double> depth_m;     ///< [n_cells] of the fluid
  std::vector<double> normal_m_s;  ///< [n_edges] velocity along the edge's normal
};

/// Integrals over the sphere, by compensated sums, for density 1.
struct Totals {
  double mass = 0.0;                 ///< m3
  double energy = 0.0;               ///< m5/s2, kinetic and potential, heights from 0 m
  double potential_enstrophy = 0.0;  ///< m/s2, of depth q^2 / 2
};

/// Sum that keeps what rounding loses (Neumaier 1974).
class CompensatedSum {
 public:
  void add(double term);
  double value() const { return sum_ + lost_; }

 private:
  double sum_ = 0.0, lost_ = 0.0;
};

/// The same bits for any number of threads: every loop gathers.
class Model {
 public:
  explicit Model(const Physics& physics) : physics_(physics) {}

  /// Goes on from this flow on this grid of a sphere, over ground of these heights [n_cells].
  /// Error(input) unless it is one and everything has its size.
  void start(const delos::Grid& grid, std::vector<double> ground_m, Flow flow);
  /// `courant` times the time that a wave on top of the flow takes from cell to cell, the least
  /// of all edges.
  double step_s(double courant) const;
  void advance(double step_s);

  /// Error(state) before start.
  const delos::Grid& grid() const;
  const Flow& flow() const { return flow_; }
  const std::vector<double>& ground_m() const { return ground_m_; }
  Totals totals() const;
  /// [n_vertices] relative vorticity in 1/s, of the triangles.
  std::vector<double> vertex_vorticity() const;
  /// [n_cells] the mean of the triangles', by kites.
  std::vector<double> vorticity() const;

 private:
  // The grid's own arrays, and what is made of them once.
  struct Tables {
    explicit Tables(const delos::Grid& grid);
    std::span<const std::int64_t> cell_offsets, edge_offsets;
    std::span<const std::int32_t> edges_on_cell, vertices_on_cell, cells_on_edge, vertices_on_edge;
    std::span<const std::int32_t> cells_on_vertex, edges_on_vertex, edges_on_edge;
    std::span<const double> weights_on_edge, cell_area_m2, triangle_area_m2, kite_area_m2;
    std::span<const double> cell_distance_m, vertex_distance_m;
    std::vector<double> outflow;      // [2 n_edges] of a cell: outward sign * side / area, 1/m
    std::vector<double> kinetic;      // [2 n_edges] a quarter of the edge's dc * dv / area
    std::vector<double> kite_share;   // [2 n_edges] kite at the cell's vertex j / area
    std::vector<double> circulation;  // [n_vertices, 3] counter-clockwise sign * dc / area, 1/m
    std::vector<double> kite_part;    // [n_vertices, 3] kite / triangle
    std::vector<double> stagger_m;    // [n_edges] where the dual edge has its middle, to the left
    void prepare_edge(std::size_t edge, const delos::Grid& grid);
    void prepare_cell(std::size_t cell);
    void prepare_vertex(std::size_t vertex);
  };
  // Where a stage's slope is taken to: the next stage, and its share of the step's end.
  struct Advance {
    double stage_s, end_s;
  };

  double vertex_vorticity(std::size_t vertex, const Flow& flow) const;
  double vertex_depth_m(std::size_t vertex, const Flow& flow) const;
  // 90 degrees left of the normal, from the values along the normals around.
  double across(std::size_t edge, const std::vector<double>& along) const;
  void fill_flux();
  void fill_vertex_q();
  void advance_depth(const Advance& by);
  void fill_edge_q(double step_s);
  void advance_velocity(const Advance& by);

  Physics physics_;
  std::optional<delos::Grid> grid_;
  std::optional<Tables> tables_;
  std::vector<double> ground_m_;
  std::vector<double> coriolis_s_;  // [n_vertices]
  Flow flow_;                       // while stages run: the sum towards the step's end

  // Scratch.
  Flow begin_, stage_;
  std::vector<double> flux_;      // [n_edges] depth * velocity
  std::vector<double> vertex_q_;  // potential vorticity (f + vorticity) / depth
  std::vector<double> cell_q_, edge_q_;
  std::vector<double> tangential_;        // [n_edges] velocity to the left of the normal
  std::vector<double> lean_m_, leaning_;  // [n_edges] what the stagger adds to the flux
  std::vector<double> bernoulli_;         // [n_cells] kinetic energy + gravity * height
};

}  // namespace shallow_water
