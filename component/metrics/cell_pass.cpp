// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/passes.hpp"

namespace delos::metrics {
namespace {

void add_cell(Index vertex, int degree, double area, CellSums& sums) {
  sums.area += area;
  sums.area_min.keep_lower({area, vertex});
  sums.area_max.keep_higher({area, vertex});
  sums.degree_min.keep_lower({static_cast<double>(degree), vertex});
  sums.degree_max.keep_higher({static_cast<double>(degree), vertex});
  sums.degree_bins.add(degree);
}

// Degree of a vertex and the area of its Voronoi cell: the fan of the ball centres around it,
// signed.
void measure_cell(const Subject& subject, const Workspace& work, Index vertex, Index first,
                  CellSums& sums) {
  const Vec3 generator = subject.mesh.position(vertex);
  double area = 0.0;
  int degree = 0;
  Index tri = first;
  do {
    const Triangle& triangle = subject.mesh.triangle(tri);
    const Index next = triangle.neighbour[at(next_corner(corner_at(triangle, vertex)))];
    area += subject.surface.triangle_area(generator, work.facets[at(tri)].ball_centre,
                                          work.facets[at(next)].ball_centre);
    ++degree;
    tri = next;
  } while (tri != first);
  add_cell(vertex, degree, area, sums);
}

// The same where no walk leads around a cell at the border.
void measure_polygon(const Subject& subject, const Workspace& work, Index vertex, CellSums& sums) {
  const auto corners = subject.border->polygons->row(vertex);
  const Vec3 generator = subject.mesh.position(vertex);
  double area = 0.0;
  for (std::size_t j = 0; j < corners.size(); ++j) {
    const Index next = corners[j + 1 == corners.size() ? 0 : j + 1];
    area += subject.surface.triangle_area(generator, work.facets[at(corners[j])].ball_centre,
                                          work.facets[at(next)].ball_centre);
  }
  add_cell(vertex, static_cast<int>(corners.size()), area, sums);
}

}  // namespace

CellSums measure_cells(parallel::Executor& exec, const Subject& subject, const Workspace& work) {
  if (subject.border != nullptr) {
    return sum_blocks<CellSums>(
        exec, subject.mesh.n_vertices(), [&](std::int64_t begin, std::int64_t end) {
          CellSums sums;
          for (std::int64_t vertex = begin; vertex < end; ++vertex) {
            measure_polygon(subject, work, static_cast<Index>(vertex), sums);
          }
          return sums;
        });
  }
  const std::vector<Index> first = triangle_at_vertex(subject.mesh);
  return sum_blocks<CellSums>(
      exec, subject.mesh.n_vertices(), [&](std::int64_t begin, std::int64_t end) {
        CellSums sums;
        for (std::int64_t vertex = begin; vertex < end; ++vertex) {
          measure_cell(subject, work, static_cast<Index>(vertex), first[at(vertex)], sums);
        }
        return sums;
      });
}

}  // namespace delos::metrics
