// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/seeds.hpp"

#include <array>
#include <cmath>

#include "core/elementary.hpp"
#include "core/error.hpp"

namespace delos {
namespace {

std::array<Vec3, 12> icosahedron_corners() {
  std::array<Vec3, 12> corners;
  corners[0] = {0, 0, 1};
  corners[11] = {0, 0, -1};
  const double z = std::sqrt(0.2);
  const double ring = 2 * z;  // cos(latitude) of both rings is twice the sine
  for (std::size_t k = 0; k < 5; ++k) {
    const auto upper = elementary::sincos(2 * kPi * static_cast<double>(k) / 5);
    const auto lower = elementary::sincos(2 * kPi * (static_cast<double>(k) + 0.5) / 5);
    corners[1 + k] = Vec3(ring * upper.cos, ring * upper.sin, z).normalized();
    corners[6 + k] = Vec3(ring * lower.cos, ring * lower.sin, -z).normalized();
  }
  return corners;
}

/// The 20 faces, counter-clockwise seen from outside.
std::array<std::array<std::size_t, 3>, 20> icosahedron_faces() {
  std::array<std::array<std::size_t, 3>, 20> faces{};
  for (std::size_t k = 0; k < 5; ++k) {
    const std::size_t next = (k + 1) % 5;
    faces[4 * k] = {0, 1 + k, 1 + next};
    faces[4 * k + 1] = {1 + k, 6 + k, 1 + next};
    faces[4 * k + 2] = {1 + next, 6 + k, 6 + next};
    faces[4 * k + 3] = {11, 6 + next, 6 + k};
  }
  return faces;
}

std::int64_t odd_part(std::int64_t n) {
  while (n % 2 == 0) n /= 2;
  return n;
}

/// The n + 1 points of the edge from a to b: odd part of n on the chord, then bisection.
std::vector<Vec3> edge_points(const Vec3& a, const Vec3& b, std::int64_t n) {
  std::vector<Vec3> points(static_cast<std::size_t>(n) + 1);
  const std::int64_t m = odd_part(n);
  const auto at = [&](std::int64_t i) -> Vec3& { return points[static_cast<std::size_t>(i)]; };
  for (std::int64_t i = 0; i <= m; ++i) {
    at(i * (n / m)) = (static_cast<double>(m - i) * a + static_cast<double>(i) * b).normalized();
  }
  at(0) = a;
  at(n) = b;
  for (std::int64_t step = n / m; step > 1; step /= 2) {
    for (std::int64_t i = step / 2; i < n; i += step) {
      at(i) = (at(i - step / 2) + at(i + step / 2)).normalized();
    }
  }
  return points;
}

/// The points of one face: (i, j) is i steps from corner 0 towards corner 1, j towards corner 2.
class FaceGrid {
 public:
  FaceGrid(std::int64_t n, const std::array<Vec3, 3>& corners)
      : n_(n), corners_(corners), points_(static_cast<std::size_t>((n + 1) * (n + 2) / 2)) {}

  Vec3& at(std::int64_t i, std::int64_t j) {
    return points_[static_cast<std::size_t>(j * (n_ + 1) - j * (j - 1) / 2 + i)];
  }

  /// Fills the interior; the border must be there.
  void fill() {
    const std::int64_t m = odd_part(n_);
    const std::int64_t first = n_ / m;
    for (std::int64_t j = 1; j < m; ++j) {
      for (std::int64_t i = 1; i + j < m; ++i) {
        at(i * first, j * first) =
            (static_cast<double>(m - i - j) * corners_[0] + static_cast<double>(i) * corners_[1] +
             static_cast<double>(j) * corners_[2])
                .normalized();
      }
    }
    for (std::int64_t half = first / 2; half >= 1; half /= 2) bisect(half);
  }

 private:
  void bisect(std::int64_t half) {
    for (std::int64_t j = half; j < n_; j += half) {
      for (std::int64_t i = half; i + j < n_; i += half) {
        const bool i_new = i / half % 2 == 1;
        const bool j_new = j / half % 2 == 1;
        if (!i_new && !j_new) continue;
        const std::int64_t di = i_new ? half : 0;
        const std::int64_t dj = j_new ? (i_new ? -half : half) : 0;
        at(i, j) = (at(i - di, j - dj) + at(i + di, j + dj)).normalized();
      }
    }
  }

  std::int64_t n_;
  std::array<Vec3, 3> corners_;
  std::vector<Vec3> points_;
};

/// The unit points of the icosahedral grid: corners, edges from the lower to the higher corner,
/// faces.
std::vector<Vec3> icosahedral_directions(std::int64_t n) {
  const auto corners = icosahedron_corners();
  const auto faces = icosahedron_faces();
  std::vector<Vec3> points(corners.begin(), corners.end());
  points.reserve(static_cast<std::size_t>(10 * n * n + 2));
  std::array<std::array<std::vector<Vec3>, 12>, 12> edges;
  for (const auto& face : faces) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = face[k];
      const std::size_t b = face[(k + 1) % 3];
      if (a > b) continue;  // every edge is met once in each direction
      edges[a][b] = edge_points(corners[a], corners[b], n);
      points.insert(points.end(), edges[a][b].begin() + 1, edges[a][b].end() - 1);
    }
  }
  const auto on_edge = [&](std::size_t a, std::size_t b, std::int64_t i) {
    return a < b ? edges[a][b][static_cast<std::size_t>(i)]
                 : edges[b][a][static_cast<std::size_t>(n - i)];
  };
  for (const auto& face : faces) {
    FaceGrid grid(n, {corners[face[0]], corners[face[1]], corners[face[2]]});
    for (std::int64_t i = 0; i <= n; ++i) {
      grid.at(i, 0) = on_edge(face[0], face[1], i);
      grid.at(0, i) = on_edge(face[0], face[2], i);
      grid.at(n - i, i) = on_edge(face[1], face[2], i);
    }
    grid.fill();
    for (std::int64_t j = 1; j < n; ++j) {
      for (std::int64_t i = 1; i + j < n; ++i) points.push_back(grid.at(i, j));
    }
  }
  return points;
}

void check_range(const char* what, std::int64_t n, std::int64_t least, std::int64_t most) {
  DELOS_CHECK(n >= least && n <= most, ErrorKind::config, what, " = ", n, ": must be from ", least,
              " to ", most, ".");
}

void project_all(std::vector<Vec3>& points, const Ellipsoid& surface) {
  for (Vec3& p : points) p = surface.project(p);
}

}  // namespace

std::vector<Vec3> icosahedral_points(std::int64_t n, const Ellipsoid& surface) {
  check_range("subdivisions of the icosahedron", n, 1, 7000);
  std::vector<Vec3> points = icosahedral_directions(n);
  project_all(points, surface);
  return points;
}

std::vector<Vec3> cubed_sphere_points(std::int64_t n, const Ellipsoid& surface) {
  check_range("subdivisions of the cubed sphere", n, 1, 9000);
  // tan(angle) at the n + 1 equal angles from -45 to 45 degrees, antisymmetric to the last bit.
  std::vector<double> tangent(static_cast<std::size_t>(n) + 1, 0);
  for (std::int64_t i = 0; 2 * i < n; ++i) {
    const auto angle =
        elementary::sincos(0.25 * kPi * static_cast<double>(n - 2 * i) / static_cast<double>(n));
    const double t = i == 0 ? 1 : angle.sin / angle.cos;
    tangent[static_cast<std::size_t>(i)] = -t;
    tangent[static_cast<std::size_t>(n - i)] = t;
  }
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(6 * n * n + 2));
  const auto add = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    points.push_back(surface.project(Vec3(tangent[static_cast<std::size_t>(i)],
                                          tangent[static_cast<std::size_t>(j)],
                                          tangent[static_cast<std::size_t>(k)])));
  };
  for (std::int64_t k = 0; k <= n; ++k) {
    for (std::int64_t j = 0; j <= n; ++j) {
      // Whole rows on the cube's surface, else their two ends.
      const bool whole = k == 0 || k == n || j == 0 || j == n;
      for (std::int64_t i = 0; i <= n; i += whole ? 1 : n) add(i, j, k);
    }
  }
  return points;
}

std::vector<Vec3> fibonacci_points(std::int64_t n, const Ellipsoid& surface) {
  check_range("points of the spiral", n, 4, 500000000);
  constexpr double kInverseGoldenRatio = 0.61803398874989484820;
  std::vector<Vec3> points(static_cast<std::size_t>(n));
  for (std::int64_t i = 0; i < n; ++i) {
    const double z = 1 - static_cast<double>(2 * i + 1) / static_cast<double>(n);
    const double turns = static_cast<double>(i) * kInverseGoldenRatio;
    const auto lon = elementary::sincos(2 * kPi * (turns - std::floor(turns)));
    const double ring = std::sqrt((1 - z) * (1 + z));
    points[static_cast<std::size_t>(i)] = surface.project(Vec3(ring * lon.cos, ring * lon.sin, z));
  }
  return points;
}

}  // namespace delos
