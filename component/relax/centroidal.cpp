// SPDX-License-Identifier: BSD-3-Clause
#include "relax/centroidal.hpp"

#include <algorithm>
#include <array>

namespace delos {
namespace {

constexpr std::size_t kRowWidth = NeighbourRows::kWidth;

double density(double spacing) {
  const double per_area = 1.0 / (spacing * spacing);
  return per_area * per_area;
}

// A cell's corner, from the generator, and the density there.
struct Corner {
  Vec3 place;
  double density;
};

struct Centroids {
  const Ellipsoid& surface;
  double momentum;

  Vec3 step(const Array<Vertex>& vertices, const NeighbourRows& rows, Index place) const {
    const auto vertex = static_cast<std::size_t>(rows.vertex_at(place));
    return cell_centroid(surface, vertices, rows, place) - vertices[vertex].position();
  }
};

}  // namespace

Vec3 cell_centroid(const Ellipsoid& surface, const Array<Vertex>& vertices,
                   const NeighbourRows& rows, Index place) {
  const Index vertex = rows.vertex_at(place);
  const Vertex& p = vertices[static_cast<std::size_t>(vertex)];
  const Vec3 origin = p.position();
  const auto& row = rows.row(place);
  if (row[kRowWidth - 1] != vertex && rows.overflow_of(vertex) != nullptr) return p.position();
  const auto n = static_cast<std::size_t>(std::find(row.begin(), row.end(), vertex) - row.begin());
  std::array<Corner, kRowWidth> corners;
  for (std::size_t j = 0; j < n; ++j) {
    const Vertex& a = vertices[static_cast<std::size_t>(row[j])];
    const Vertex& b = vertices[static_cast<std::size_t>(row[j + 1 == n ? 0 : j + 1])];
    corners[j] = {surface.ball_centre(origin, a.position(), b.position()) - origin,
                  density((p.spacing + a.spacing + b.spacing) / 3.0)};
  }
  // Over a triangle the mean of x times a linear density r is (sum of r_i) (sum of x_i) / 12 and
  // (sum of r_i x_i) / 12; the generator, where x is 0, has a part in the density alone.
  const Vec3 up = surface.normal(origin);
  const double at_generator = density(p.spacing);
  Vec3 moment(0, 0, 0);
  double mass = 0.0;
  for (std::size_t j = 0; j < n; ++j) {
    const Corner& a = corners[j];
    const Corner& b = corners[j + 1 == n ? 0 : j + 1];
    const double twice_area = a.place.cross(b.place).dot(up);
    const double sum = at_generator + a.density + b.density;
    mass += 4.0 * twice_area * sum;
    moment += twice_area * ((sum + a.density) * a.place + (sum + b.density) * b.place);
  }
  return origin + moment / mass;
}

double centroidal_momentum(int n_rounds) { return std::max(0.0, 1.0 - 10.0 / n_rounds); }

void centroidal_round(parallel::Executor& exec, const Target& target, double momentum,
                      Moving& moving, Mesh& mesh) {
  move_round(exec, target, Centroids{target.surface, momentum}, moving, mesh);
}

}  // namespace delos
