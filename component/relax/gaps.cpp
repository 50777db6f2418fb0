// SPDX-License-Identifier: BSD-3-Clause
#include "relax/gaps.hpp"

#include <algorithm>
#include <functional>

namespace delos {

bool fill_gaps(Mesh& mesh, TriangleAtVertex& at_vertex, RelaxPart& part, MeshEdits& edits) {
  const std::size_t n_dead = edits.dead_vertices.size();
  if (!std::all_of(part.is_free.end() - static_cast<std::ptrdiff_t>(n_dead), part.is_free.end(),
                   [](char is_free) { return is_free != 0; })) {
    return false;
  }
  // The highest first: what lies behind a gap is then alive.
  std::sort(edits.dead_vertices.begin(), edits.dead_vertices.end(), std::greater<>());
  for (const Index gap : edits.dead_vertices) {
    const Index last = mesh.n_vertices() - 1;
    if (gap != last) {
      const Index first = at_vertex[at(last)];
      Index tri = first;
      do {
        Triangle& t = mesh.triangle(tri);
        const int k = corner_at(t, last);
        tri = t.neighbour[at(next_corner(k))];
        std::replace(t.vertex.begin(), t.vertex.end(), last, gap);
      } while (tri != first);
      mesh.vertices[at(gap)] = mesh.vertices.back();
      at_vertex[at(gap)] = first;
    }
    mesh.vertices.pop_back();
    at_vertex.pop_back();
  }
  part.is_free.resize(mesh.vertices.size());
  std::sort(edits.dead_triangles.begin(), edits.dead_triangles.end(), std::greater<>());
  for (const Index gap : edits.dead_triangles) {
    const Index last = mesh.n_triangles() - 1;
    if (gap != last) {
      const Triangle moved = mesh.triangles.back();
      for (const Index n : moved.neighbour) {
        auto& around = mesh.triangle(n).neighbour;
        std::replace(around.begin(), around.end(), last, gap);
      }
      for (const Index v : moved.vertex) at_vertex[at(v)] = gap;
      mesh.triangle(gap) = moved;
    }
    mesh.triangles.pop_back();
  }
  return true;
}

void compact_part(parallel::Executor& exec, Mesh& mesh, RelaxPart& part, MeshEdits& edits) {
  std::sort(edits.dead_vertices.begin(), edits.dead_vertices.end());
  auto next = edits.dead_vertices.begin();
  std::size_t to = 0;
  for (std::size_t v = 0; v < part.is_free.size(); ++v) {
    if (next != edits.dead_vertices.end() && at(*next) == v) {
      ++next;
    } else {
      part.is_free[to++] = part.is_free[v];
    }
  }
  part.is_free.resize(to);
  compact(exec, mesh, edits);
}

}  // namespace delos
