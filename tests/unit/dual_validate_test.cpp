// SPDX-License-Identifier: BSD-3-Clause
#include "dual/validate.hpp"

#include <doctest/doctest.h>

#include <functional>

#include "dual/build.hpp"
#include "support/sample_meshes.hpp"

using namespace delos;

TEST_CASE("check_grid names the rule and the element that a change breaks") {
  parallel::Executor exec(1);
  Monitor monitor;
  Context context{exec, monitor};
  const Ellipsoid surface;
  const Grid right =
      build_grid(context, surface, LatitudeKind::geodetic, samples::shaken(surface, 2, 0.1, 7));
  REQUIRE(check_grid(context, right).empty());

  struct Damage {
    const char* rule;
    Index id;
    std::function<void(Grid&)> apply;
  };
  const std::vector<Damage> damages{
      {"sizes", 0, [](Grid& g) { g.edge_angle_rad.pop_back(); }},
      {"ids on edges", 4, [](Grid& g) { g.cells_on_edge[4][1] = 1000; }},
      {"ids on vertices", 6, [](Grid& g) { g.edges_on_vertex[6][2] = kNone; }},
      {"ids on vertices", 6,
       [](Grid& g) {
         g.cells_on_vertex[6] = {kNone, kNone, kNone};
       }},
      {"lists of a cell", 3, [](Grid& g) { g.cells_on_cell.row(3)[1] = kNone; }},
      {"lists of a vertex", 6, [](Grid& g) { g.cells_on_vertex[6][1] = kNone; }},
      {"lists of a cell", 0,
       [](Grid& g) { std::swap(g.edges_on_cell.values[0], g.edges_on_cell.values[1]); }},
      {"lists of a vertex", 9,
       [](Grid& g) { std::swap(g.cells_on_vertex[9][0], g.cells_on_vertex[9][1]); }},
      {"lower to its higher", 3,
       [](Grid& g) { std::swap(g.cells_on_edge[3][0], g.cells_on_edge[3][1]); }},
      {"edges on edges", 0,
       [](Grid& g) { std::swap(g.edges_on_edge.values[0], g.edges_on_edge.values[1]); }},
      {"cells lie on the surface", 2, [](Grid& g) { g.cell_lon_lat[2].lat_rad += 1e-9; }},
      {"edges lie on the surface", 2, [](Grid& g) { g.edge_lon_lat[2].lon_rad -= 7.0; }},
      {"vertices lie on the surface", 5, [](Grid& g) { g.vertex_position[5] *= 1.0 + 1e-9; }},
      {"as far from each", 5, [](Grid& g) { g.vertex_position[5] = g.cell_position[0]; }},
      {"two arcs cross", 8,
       [](Grid& g) {
         g.edge_position[8] = g.surface.project(g.edge_position[8] + Vec3(1e-6, 2e-6, 3e-6));
       }},
      {"turn left", 8,
       [](Grid& g) { std::swap(g.vertices_on_edge[8][0], g.vertices_on_edge[8][1]); }},
      {"angle of an edge", 8, [](Grid& g) { g.edge_angle_rad[8] += 1e-6; }},
      {"cell distances", 8, [](Grid& g) { g.cell_distance_m[8] *= 1.0 + 1e-6; }},
      {"vertex distances", 8, [](Grid& g) { g.vertex_distance_m[8] *= 1.0 + 1e-6; }},
      {"lies inside its triangle", 5,
       [](Grid& g) { g.vertex_position[5] = g.vertex_position[60]; }},
      {"kites are positive", 3, [](Grid& g) { g.kite_area_m2[3][1] = -g.kite_area_m2[3][1]; }},
      {"a kite is the area", 3, [](Grid& g) { g.kite_area_m2[3][1] *= 1.0 + 1e-6; }},
      {"kites of a vertex", 3, [](Grid& g) { g.triangle_area_m2[3] *= 1.0 + 1e-6; }},
      {"kites of a cell", 3, [](Grid& g) { g.cell_area_m2[3] *= 1.0 + 1e-6; }},
      {"area of a cell", 3, [](Grid& g) { g.cell_area_m2[3] = std::nan(""); }},
      {"cells sum", 0, [](Grid& g) { g.cell_area_m2[3] *= 1.0 + 1e-4; }},
      {"triangles sum", 0, [](Grid& g) { g.triangle_area_m2[3] *= 1.0 + 1e-4; }},
      {"weights are antisymmetric", 0, [](Grid& g) { g.weights_on_edge.values[0] += 1e-10; }},
      {"weights are antisymmetric", 0, [](Grid& g) { g.weights_on_edge.values[0] = std::nan(""); }},
      {"divergence on a vertex", kNone,
       [](Grid& g) {
         for (double& w : g.weights_on_edge.values) w = -w;
       }},
  };
  for (const Damage& damage : damages) {
    CAPTURE(damage.rule);
    Grid grid = right;
    damage.apply(grid);
    const auto broken = check_grid(context, grid);
    const auto found = std::find_if(broken.begin(), broken.end(), [&](const BrokenRule& rule) {
      return rule.rule.find(damage.rule) != std::string::npos;
    });
    REQUIRE(found != broken.end());
    CHECK(found->n_broken >= 1);
    CHECK(to_string(*found).find(damage.rule) != std::string::npos);
    if (damage.id != kNone) CHECK(std::count(found->ids.begin(), found->ids.end(), damage.id) == 1);
  }
}
