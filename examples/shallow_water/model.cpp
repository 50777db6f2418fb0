// SPDX-License-Identifier: BSD-3-Clause
#include "model.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace shallow_water {
namespace {

constexpr std::size_t kGrain = 2048;  // elements a task: some 50 us, far above a task's own cost

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

template <class Body>
void for_each(std::size_t n, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, kGrain), [&body](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
  });
}

void check_size(const char* what, std::size_t found, std::int64_t expected) {
  if (found == at(expected)) return;
  throw delos::Error(delos::ErrorKind::input, std::string(what) + " has " + std::to_string(found) +
                                                  " values; this grid has " +
                                                  std::to_string(expected) + " places for it.");
}

}  // namespace

void CompensatedSum::add(double term) {
  const double total = sum_ + term;
  lost_ += std::fabs(sum_) >= std::fabs(term) ? (sum_ - total) + term : (term - total) + sum_;
  sum_ = total;
}

Model::Tables::Tables(const delos::Grid& grid)
    : cell_offsets(grid.cell_offsets()),
      edge_offsets(grid.edge_offsets()),
      edges_on_cell(grid.edges_on_cell()),
      vertices_on_cell(grid.vertices_on_cell()),
      cells_on_edge(grid.cells_on_edge()),
      vertices_on_edge(grid.vertices_on_edge()),
      cells_on_vertex(grid.cells_on_vertex()),
      edges_on_vertex(grid.edges_on_vertex()),
      edges_on_edge(grid.edges_on_edge()),
      weights_on_edge(grid.weights_on_edge()),
      cell_area_m2(grid.cell_area_m2()),
      triangle_area_m2(grid.triangle_area_m2()),
      kite_area_m2(grid.kite_area_m2()),
      cell_distance_m(grid.cell_distance_m()),
      vertex_distance_m(grid.vertex_distance_m()) {
  for (auto* const table : {&outflow, &kinetic, &kite_share}) table->resize(edges_on_cell.size());
  for (auto* const table : {&circulation, &kite_part}) table->resize(edges_on_vertex.size());
  stagger_m.resize(cell_distance_m.size());
  for_each(stagger_m.size(), [&, this](std::size_t edge) { prepare_edge(edge, grid); });
  for_each(cell_area_m2.size(), [this](std::size_t cell) { prepare_cell(cell); });
  for_each(triangle_area_m2.size(), [this](std::size_t vertex) { prepare_vertex(vertex); });
}

void Model::Tables::prepare_edge(std::size_t edge, const delos::Grid& grid) {
  const auto middle = grid.edge_position().subspan(3 * edge, 3);
  const auto right = grid.vertex_position().subspan(3 * at(vertices_on_edge[2 * edge]), 3);
  const auto left = grid.vertex_position().subspan(3 * at(vertices_on_edge[2 * edge + 1]), 3);
  double along = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    along += (0.5 * (left[i] + right[i]) - middle[i]) * (left[i] - right[i]);
  }
  stagger_m[edge] = grid.scale_m() * grid.scale_m() * along / vertex_distance_m[edge];
}

void Model::Tables::prepare_cell(std::size_t cell) {
  const double area_m2 = cell_area_m2[cell];
  for (auto j = at(cell_offsets[cell]); j < at(cell_offsets[cell + 1]); ++j) {
    const auto edge = at(edges_on_cell[j]);
    const double side_m = vertex_distance_m[edge];
    outflow[j] = (at(cells_on_edge[2 * edge]) == cell ? side_m : -side_m) / area_m2;
    kinetic[j] = 0.25 * side_m * cell_distance_m[edge] / area_m2;
    const auto vertex = at(vertices_on_cell[j]);
    for (std::size_t k = 3 * vertex; k < 3 * vertex + 3; ++k) {
      if (at(cells_on_vertex[k]) == cell) kite_share[j] = kite_area_m2[k] / area_m2;
    }
  }
}

void Model::Tables::prepare_vertex(std::size_t vertex) {
  const double area_m2 = triangle_area_m2[vertex];
  for (std::size_t k = 3 * vertex; k < 3 * vertex + 3; ++k) {
    // Who walks along the normal has vertex [1] of the edge on the left, and goes around it.
    const auto edge = at(edges_on_vertex[k]);
    const double walk_m = cell_distance_m[edge];
    circulation[k] = (at(vertices_on_edge[2 * edge + 1]) == vertex ? walk_m : -walk_m) / area_m2;
    kite_part[k] = kite_area_m2[k] / area_m2;
  }
}

void Model::start(const delos::Grid& grid, std::vector<double> ground_m, Flow flow) {
  const auto radii_m = grid.radii_m();
  if (radii_m[0] != radii_m[1] || radii_m[1] != radii_m[2]) {
    throw delos::Error(delos::ErrorKind::input,
                       "the model flows on a sphere; this surface has "
                       "three radii. Take surface.shape: sphere.");
  }
  check_size("ground_m", ground_m.size(), grid.n_cells());
  check_size("depth_m", flow.depth_m.size(), grid.n_cells());
  check_size("normal_m_s", flow.normal_m_s.size(), grid.n_edges());
  grid_.emplace(grid);
  tables_.emplace(grid);
  ground_m_ = std::move(ground_m);
  flow_ = std::move(flow);
  for (auto* const of_cells : {&cell_q_, &bernoulli_}) of_cells->resize(at(grid.n_cells()));
  for (auto* const of_edges : {&flux_, &edge_q_, &tangential_, &lean_m_, &leaning_})
    of_edges->resize(at(grid.n_edges()));
  vertex_q_.resize(at(grid.n_vertices()));
  coriolis_s_.resize(at(grid.n_vertices()));
  const auto position = grid.vertex_position();
  for (std::size_t vertex = 0; vertex < coriolis_s_.size(); ++vertex) {
    coriolis_s_[vertex] = 2.0 * physics_.rotation_rad_s * position[3 * vertex + 2];
  }
}

const delos::Grid& Model::grid() const {
  if (!grid_) throw delos::Error(delos::ErrorKind::state, "the model has no grid before start().");
  return *grid_;
}

double Model::step_s(double courant) const {
  const Tables& tables = *tables_;
  double least_s = std::numeric_limits<double>::infinity();
  for (std::size_t edge = 0; edge < flux_.size(); ++edge) {
    const double depth_m = std::max(flow_.depth_m[at(tables.cells_on_edge[2 * edge])],
                                    flow_.depth_m[at(tables.cells_on_edge[2 * edge + 1])]);
    const double speed_m_s =
        std::sqrt(physics_.gravity_m_s2 * depth_m) + std::fabs(flow_.normal_m_s[edge]);
    least_s = std::min(least_s, tables.cell_distance_m[edge] / speed_m_s);
  }
  return courant * least_s;
}

void Model::advance(double step_s) {
  // The classical Runge-Kutta scheme of fourth order.
  const std::array<Advance, 4> stages = {Advance{step_s / 2.0, step_s / 6.0},
                                         Advance{step_s / 2.0, step_s / 3.0},
                                         Advance{step_s, step_s / 3.0}, Advance{0.0, step_s / 6.0}};
  begin_ = flow_;
  stage_ = flow_;
  for (const Advance& by : stages) {
    fill_flux();
    fill_vertex_q();
    advance_depth(by);
    fill_edge_q(step_s);
    advance_velocity(by);
  }
}

double Model::across(std::size_t edge, const std::vector<double>& along) const {
  double sum = 0.0;
  for (auto k = at(tables_->edge_offsets[edge]); k < at(tables_->edge_offsets[edge + 1]); ++k) {
    sum += tables_->weights_on_edge[k] * along[at(tables_->edges_on_edge[k])];
  }
  return sum;
}

// The flux is what the energy's derivative by the velocity is, so that energy is kept: depth *
// velocity of the published kinetic energy, and what follows from the part that the stagger adds.
void Model::fill_flux() {
  const Tables& tables = *tables_;
  for_each(flux_.size(), [&, this](std::size_t edge) {
    tangential_[edge] = across(edge, stage_.normal_m_s);
    const double fall_m = stage_.depth_m[at(tables.cells_on_edge[2 * edge])] -
                          stage_.depth_m[at(tables.cells_on_edge[2 * edge + 1])];
    lean_m_[edge] = 0.5 * tables.stagger_m[edge] / tables.cell_distance_m[edge] * fall_m;
    leaning_[edge] = lean_m_[edge] * stage_.normal_m_s[edge];
  });
  for_each(flux_.size(), [&, this](std::size_t edge) {
    const double depth_m = 0.5 * (stage_.depth_m[at(tables.cells_on_edge[2 * edge])] +
                                  stage_.depth_m[at(tables.cells_on_edge[2 * edge + 1])]);
    flux_[edge] = depth_m * stage_.normal_m_s[edge] + lean_m_[edge] * tangential_[edge] -
                  across(edge, leaning_);
  });
}

double Model::vertex_vorticity(std::size_t vertex, const Flow& flow) const {
  double sum = 0.0;
  for (std::size_t k = 3 * vertex; k < 3 * vertex + 3; ++k) {
    sum += tables_->circulation[k] * flow.normal_m_s[at(tables_->edges_on_vertex[k])];
  }
  return sum;
}

double Model::vertex_depth_m(std::size_t vertex, const Flow& flow) const {
  double sum_m = 0.0;
  for (std::size_t k = 3 * vertex; k < 3 * vertex + 3; ++k) {
    sum_m += tables_->kite_part[k] * flow.depth_m[at(tables_->cells_on_vertex[k])];
  }
  return sum_m;
}

void Model::fill_vertex_q() {
  for_each(vertex_q_.size(), [this](std::size_t vertex) {
    vertex_q_[vertex] =
        (coriolis_s_[vertex] + vertex_vorticity(vertex, stage_)) / vertex_depth_m(vertex, stage_);
  });
}

// Also what the velocity needs from the cells of this stage, before the depth leaves it.
void Model::advance_depth(const Advance& by) {
  const Tables& tables = *tables_;
  for_each(cell_q_.size(), [&, this](std::size_t cell) {
    double outflow = 0.0, kinetic = 0.0, q = 0.0;
    for (auto j = at(tables.cell_offsets[cell]); j < at(tables.cell_offsets[cell + 1]); ++j) {
      const auto edge = at(tables.edges_on_cell[j]);
      outflow += tables.outflow[j] * flux_[edge];
      kinetic += tables.kinetic[j] * stage_.normal_m_s[edge] * stage_.normal_m_s[edge] +
                 0.5 * tables.outflow[j] * tables.stagger_m[edge] * stage_.normal_m_s[edge] *
                     tangential_[edge];
      q += tables.kite_share[j] * vertex_q_[at(tables.vertices_on_cell[j])];
    }
    cell_q_[cell] = q;
    bernoulli_[cell] = kinetic + physics_.gravity_m_s2 * (stage_.depth_m[cell] + ground_m_[cell]);
    flow_.depth_m[cell] -= by.end_s * outflow;
    stage_.depth_m[cell] = begin_.depth_m[cell] - by.stage_s * outflow;
  });
}

void Model::fill_edge_q(double step_s) {
  const Tables& tables = *tables_;
  const double ahead_s = physics_.anticipation * step_s;
  for_each(edge_q_.size(), [&, this](std::size_t edge) {
    const auto right = at(tables.vertices_on_edge[2 * edge]);
    const auto left = at(tables.vertices_on_edge[2 * edge + 1]);
    edge_q_[edge] = 0.5 * (vertex_q_[right] + vertex_q_[left]);
    if (ahead_s == 0.0) return;
    const double along = (vertex_q_[left] - vertex_q_[right]) / tables.vertex_distance_m[edge];
    const double across = (cell_q_[at(tables.cells_on_edge[2 * edge + 1])] -
                           cell_q_[at(tables.cells_on_edge[2 * edge])]) /
                          tables.cell_distance_m[edge];
    edge_q_[edge] -= ahead_s * (tangential_[edge] * along + stage_.normal_m_s[edge] * across);
  });
}

void Model::advance_velocity(const Advance& by) {
  const Tables& tables = *tables_;
  for_each(flux_.size(), [&, this](std::size_t edge) {
    // The mean of both edges' q makes the work of this force vanish, as the weights are
    // antisymmetric (Ringler et al. 2010).
    double turn = 0.0;
    for (auto k = at(tables.edge_offsets[edge]); k < at(tables.edge_offsets[edge + 1]); ++k) {
      const auto other = at(tables.edges_on_edge[k]);
      turn += tables.weights_on_edge[k] * flux_[other] * (edge_q_[edge] + edge_q_[other]);
    }
    const double rise = bernoulli_[at(tables.cells_on_edge[2 * edge + 1])] -
                        bernoulli_[at(tables.cells_on_edge[2 * edge])];
    const double slope_m_s2 = 0.5 * turn - rise / tables.cell_distance_m[edge];
    flow_.normal_m_s[edge] += by.end_s * slope_m_s2;
    stage_.normal_m_s[edge] = begin_.normal_m_s[edge] + by.stage_s * slope_m_s2;
  });
}

Totals Model::totals() const {
  const Tables& tables = *tables_;
  CompensatedSum mass, energy, enstrophy;
  for (std::size_t cell = 0; cell < flow_.depth_m.size(); ++cell) {
    const double depth_m = flow_.depth_m[cell], area_m2 = tables.cell_area_m2[cell];
    mass.add(area_m2 * depth_m);
    energy.add(area_m2 * physics_.gravity_m_s2 * depth_m * (0.5 * depth_m + ground_m_[cell]));
  }
  for (std::size_t edge = 0; edge < flow_.normal_m_s.size(); ++edge) {
    const double two_depths_m = flow_.depth_m[at(tables.cells_on_edge[2 * edge])] +
                                flow_.depth_m[at(tables.cells_on_edge[2 * edge + 1])];
    energy.add(0.25 * tables.cell_distance_m[edge] * tables.vertex_distance_m[edge] * two_depths_m *
               flow_.normal_m_s[edge] * flow_.normal_m_s[edge]);
    const double fall_m = flow_.depth_m[at(tables.cells_on_edge[2 * edge])] -
                          flow_.depth_m[at(tables.cells_on_edge[2 * edge + 1])];
    energy.add(0.5 * tables.vertex_distance_m[edge] * tables.stagger_m[edge] * fall_m *
               flow_.normal_m_s[edge] * across(edge, flow_.normal_m_s));
  }
  for (std::size_t vertex = 0; vertex < coriolis_s_.size(); ++vertex) {
    const double absolute = coriolis_s_[vertex] + vertex_vorticity(vertex, flow_);
    enstrophy.add(0.5 * tables.triangle_area_m2[vertex] * absolute * absolute /
                  vertex_depth_m(vertex, flow_));
  }
  return {mass.value(), energy.value(), enstrophy.value()};
}

std::vector<double> Model::vertex_vorticity() const {
  std::vector<double> of_vertices(vertex_q_.size());
  for_each(of_vertices.size(), [&, this](std::size_t vertex) {
    of_vertices[vertex] = vertex_vorticity(vertex, flow_);
  });
  return of_vertices;
}

std::vector<double> Model::vorticity() const {
  const Tables& tables = *tables_;
  const std::vector<double> of_vertices = vertex_vorticity();
  std::vector<double> of_cells(flow_.depth_m.size());
  for_each(of_cells.size(), [&](std::size_t cell) {
    for (auto j = at(tables.cell_offsets[cell]); j < at(tables.cell_offsets[cell + 1]); ++j) {
      of_cells[cell] += tables.kite_share[j] * of_vertices[at(tables.vertices_on_cell[j])];
    }
  });
  return of_cells;
}

}  // namespace shallow_water
