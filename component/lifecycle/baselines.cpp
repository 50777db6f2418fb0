// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/baselines.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "triangulation/delaunay.hpp"
#include "triangulation/flip.hpp"
#include "triangulation/seeds.hpp"

namespace delos {
namespace {

constexpr std::int64_t cells_per_square(Generator generator) {
  return generator == Generator::icosahedral ? 10 : 6;
}

}  // namespace

std::int64_t baseline_vertices(Generator generator, std::int64_t subdivisions) {
  return cells_per_square(generator) * subdivisions * subdivisions + 2;
}

double baseline_spacing_m(Generator generator, const Ellipsoid& surface,
                          std::int64_t subdivisions) {
  const auto n_vertices = static_cast<double>(baseline_vertices(generator, subdivisions));
  return surface.scale_m() * std::sqrt(2.0 * surface.area() / (std::sqrt(3.0) * n_vertices));
}

std::int64_t baseline_subdivisions(Generator generator, const Ellipsoid& surface,
                                   double spacing_m) {
  const double spacing = spacing_m / surface.scale_m();
  const double n_vertices = 2.0 * surface.area() / (std::sqrt(3.0) * spacing * spacing);
  constexpr double kMaxVertices = 2.9e8;  // what both point sets reach
  DELOS_CHECK(n_vertices < kMaxVertices, ErrorKind::resource, "a spacing of ", spacing_m,
              " m asks for ", n_vertices, " cells; at most ", kMaxVertices,
              " fit. Use a larger spacing.");
  const double subdivisions =
      std::sqrt(n_vertices / static_cast<double>(cells_per_square(generator)));
  return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::floor(subdivisions + 0.5)));
}

Mesh build_baseline(Context& context, Generator generator, const Ellipsoid& surface,
                    std::int64_t subdivisions) {
  DELOS_ASSERT(generator != Generator::frontal && subdivisions >= 1);
  const std::vector<Vec3> points = generator == Generator::icosahedral
                                       ? icosahedral_points(subdivisions, surface)
                                       : cubed_sphere_points(subdivisions, surface);
  Mesh mesh = delaunay(context.exec, points);
  if (!surface.is_sphere()) restore_delaunay_everywhere(context.exec, mesh, surface);
  return mesh;
}

}  // namespace delos
