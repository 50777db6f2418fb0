// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <cmath>

#include "core/elementary.hpp"
#include "metrics/passes.hpp"

namespace delos::metrics {
namespace {

// Cosines below this are of angles that rounding makes right, acute or obtuse: the circumcentre
// is on the side to 1e-9 of its length.
constexpr double kRightCosine = 1e-9;

Vec3 ball_centre(const Ellipsoid& surface, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 centre = surface.ball_centre(a, b, c);
  return centre.allFinite() && centre.squaredNorm() > 0.0 ? centre : surface.project(a);
}

void measure_triangle(const Subject& subject, Index tri, Workspace& work, TriangleSums& sums) {
  if (!subject.is_whole(tri)) {
    work.facets[at(tri)] = {subject.border->centre[at(tri)], 0.0};
    work.area_length[at(tri)] = kNotMeasured;
    ++sums.n_cut;
    return;
  }
  const auto& corner = subject.mesh.triangle(tri).vertex;
  const Vec3 a = subject.mesh.position(corner[0]);
  const Vec3 b = subject.mesh.position(corner[1]);
  const Vec3 c = subject.mesh.position(corner[2]);
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const Vec3 normal = ab.cross(-ca);
  const double twice_area = normal.norm();
  const std::array<double, 3> square{ab.squaredNorm(), bc.squaredNorm(), ca.squaredNorm()};
  work.facets[at(tri)] = {ball_centre(subject.surface, a, b, c), 0.5 * twice_area};

  if (!(twice_area > 0.0)) {
    ++sums.n_degenerate;
    work.area_length[at(tri)] = 0.0;
    sums.area_length_min.keep_lower({0.0, tri});
    sums.radius_edge_max.keep_higher({kUnbounded, tri});
    sums.radius_edge += kUnbounded;
    sums.area_length_bins.add(0.0);
    sums.add_angles({0.0, 0.0, 180.0}, tri);
    return;
  }
  const bool faces_outward = normal.dot(a) > 0.0;
  sums.n_degenerate += !faces_outward;
  const double area_length =
      2.0 * std::sqrt(3.0) * twice_area / (square[0] + square[1] + square[2]);
  const double shortest = *std::min_element(square.begin(), square.end());
  const double radius_edge =
      std::min(kUnbounded, std::sqrt(square[0] * square[1]) * std::sqrt(square[2] / shortest) /
                               (2.0 * twice_area));
  work.area_length[at(tri)] = area_length;
  sums.area_length += area_length;
  sums.area_length_min.keep_lower({area_length, tri});
  sums.area_length_bins.add(area_length);
  sums.radius_edge += radius_edge;
  sums.radius_edge_max.keep_higher({radius_edge, tri});

  // Times the lengths of the two sides.
  const std::array<double, 3> cosine{-ab.dot(ca), -bc.dot(ab), -ca.dot(bc)};
  const double first = elementary::atan2(twice_area, cosine[0]) * kDegPerRad;
  const double second = elementary::atan2(twice_area, cosine[1]) * kDegPerRad;
  sums.add_angles({first, second, std::max(0.0, 180.0 - first - second)}, tri);
  const double smallest = *std::min_element(cosine.begin(), cosine.end());
  sums.n_acute += faces_outward && smallest > 0.0;
  sums.n_right += std::abs(smallest) <= kRightCosine * std::max({square[0], square[1], square[2]});
}

}  // namespace

TriangleSums measure_triangles(parallel::Executor& exec, const Subject& subject, Workspace& work) {
  work.facets.resize(subject.mesh.triangles.size());
  work.area_length.resize(subject.mesh.triangles.size());
  return sum_blocks<TriangleSums>(
      exec, subject.mesh.n_triangles(), [&](std::int64_t begin, std::int64_t end) {
        TriangleSums sums;
        for (std::int64_t tri = begin; tri < end; ++tri) {
          measure_triangle(subject, static_cast<Index>(tri), work, sums);
        }
        return sums;
      });
}

}  // namespace delos::metrics
