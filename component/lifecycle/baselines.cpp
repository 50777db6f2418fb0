// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/baselines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "triangulation/delaunay.hpp"
#include "triangulation/flip.hpp"

namespace delos {
namespace {

/// Points (a, b, n - a - b) / n of a triangle's barycentric lattice, row a of n - a + 1 points.
struct Lattice {
  std::int64_t n;
  std::vector<Vec3> points;

  explicit Lattice(std::int64_t n_sides)
      : n(n_sides), points(static_cast<std::size_t>((n_sides + 1) * (n_sides + 2) / 2)) {}
  Vec3& at(std::int64_t a, std::int64_t b) {
    return points[static_cast<std::size_t>(a * (n + 1) - a * (a - 1) / 2 + b)];
  }
};

Lattice flat_lattice(const std::array<Vec3, 3>& corners, std::int64_t n) {
  Lattice out(n);
  for (std::int64_t a = 0; a <= n; ++a) {
    for (std::int64_t b = 0; a + b <= n; ++b) {
      out.at(a, b) = (static_cast<double>(a) * corners[0] + static_cast<double>(b) * corners[1] +
                      static_cast<double>(n - a - b) * corners[2])
                         .normalized();
    }
  }
  return out;
}

/// Twice as many subdivisions: the points there are, and the middles of the arcs between them.
Lattice bisected(Lattice& coarse) {
  Lattice out(2 * coarse.n);
  for (std::int64_t a = 0; a <= out.n; ++a) {
    for (std::int64_t b = 0; a + b <= out.n; ++b) {
      const std::int64_t half_a = a / 2;
      const std::int64_t half_b = b / 2;
      const bool a_is_odd = a % 2 == 1;
      const bool b_is_odd = b % 2 == 1;
      if (!a_is_odd && !b_is_odd) {
        out.at(a, b) = coarse.at(half_a, half_b);
      } else {
        // Exactly two of (a, b, c) are odd; the arc runs from one to the other of them.
        const Vec3& from =
            coarse.at(half_a + (a_is_odd ? 1 : 0), half_b + (b_is_odd && !a_is_odd ? 1 : 0));
        const Vec3& to = coarse.at(half_a, half_b + (a_is_odd && b_is_odd ? 1 : 0));
        out.at(a, b) = (from + to).normalized();
      }
    }
  }
  return out;
}

/// The lattice of a spherical triangle: bisected as often as n is even (which keeps the cells most
/// alike), after a flat division into the odd rest of n.
Lattice face_lattice(const std::array<Vec3, 3>& corners, std::int64_t n) {
  std::int64_t odd = n;
  while (odd % 2 == 0) odd /= 2;
  Lattice lattice = flat_lattice(corners, odd);
  while (lattice.n < n) lattice = bisected(lattice);
  return lattice;
}

std::array<Vec3, 12> icosahedron_corners() {
  const double golden = (1.0 + std::sqrt(5.0)) / 2.0;
  std::array<Vec3, 12> out;
  std::size_t i = 0;
  for (const double s : {-1.0, 1.0}) {
    for (const double t : {-golden, golden}) {
      out[i++] = Vec3(0.0, s, t).normalized();
      out[i++] = Vec3(s, t, 0.0).normalized();
      out[i++] = Vec3(t, 0.0, s).normalized();
    }
  }
  return out;
}

/// 12 corners, 30 edges, 20 faces; each point once.
std::vector<Vec3> icosahedral_points(std::int64_t n) {
  const std::array<Vec3, 12> corners = icosahedron_corners();
  // Corners are 63.4, 116.6 or 180 degrees apart.
  const auto are_joined = [&](std::size_t i, std::size_t j) {
    return corners[i].dot(corners[j]) > 0.0;
  };
  std::vector<Vec3> points(corners.begin(), corners.end());
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = i + 1; j < 12; ++j) {
      if (!are_joined(i, j)) continue;
      Lattice edge = face_lattice({corners[i], corners[j], corners[i]}, n);
      for (std::int64_t a = 1; a < n; ++a) points.push_back(edge.at(a, n - a));
      for (std::size_t k = j + 1; k < 12; ++k) {
        if (!are_joined(i, k) || !are_joined(j, k)) continue;
        Lattice face = face_lattice({corners[i], corners[j], corners[k]}, n);
        for (std::int64_t a = 1; a < n; ++a) {
          for (std::int64_t b = 1; a + b < n; ++b) points.push_back(face.at(a, b));
        }
      }
    }
  }
  return points;
}

/// Nodes of equal angles on the faces of the cube (Ronchi et al. 1996,
/// doi:10.1006/jcph.1996.0047).
std::vector<Vec3> cubed_sphere_points(std::int64_t n) {
  std::vector<double> tangent(static_cast<std::size_t>(n) + 1);
  for (std::int64_t i = 0; 2 * i <= n; ++i) {
    const double angle = kPi / 4.0 * (2.0 * static_cast<double>(i) / static_cast<double>(n) - 1.0);
    const elementary::SinCos turn = elementary::sincos(angle);
    const double value = i == 0 ? -1.0 : 2 * i == n ? 0.0 : turn.sin / turn.cos;
    tangent[static_cast<std::size_t>(i)] = value;
    tangent[static_cast<std::size_t>(n - i)] = 0.0 - value;
  }
  const auto is_end = [n](std::int64_t i) { return i == 0 || i == n; };
  std::vector<Vec3> points;
  for (std::int64_t i = 0; i <= n; ++i) {
    for (std::int64_t j = 0; j <= n; ++j) {
      const std::int64_t step = is_end(i) || is_end(j) ? 1 : n;
      for (std::int64_t k = 0; k <= n; k += step) {
        points.push_back(Vec3(tangent[static_cast<std::size_t>(i)],
                              tangent[static_cast<std::size_t>(j)],
                              tangent[static_cast<std::size_t>(k)])
                             .normalized());
      }
    }
  }
  return points;
}

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
  constexpr double kMaxVertices = 7e8;  // 32-bit ids of edges and triangles
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
  std::vector<Vec3> points = generator == Generator::icosahedral
                                 ? icosahedral_points(subdivisions)
                                 : cubed_sphere_points(subdivisions);
  DELOS_ASSERT(static_cast<std::int64_t>(points.size()) ==
               baseline_vertices(generator, subdivisions));
  for (Vec3& point : points) point = surface.project(point);
  Mesh mesh = delaunay(context.exec, points);
  if (!surface.is_sphere()) restore_delaunay_everywhere(context.exec, mesh, surface);
  return mesh;
}

}  // namespace delos
