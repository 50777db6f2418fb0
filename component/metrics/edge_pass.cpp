// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "geometry/predicates.hpp"
#include "metrics/passes.hpp"

namespace delos::metrics {
namespace {

// On an ellipsoid a side breaks the Delaunay property when the opposite vertex is inside the
// surface ball by more than this share of its squared radius; less is rounding of the centre.
constexpr double kBallTolerance = 1e-8;

// Side k of triangle `left`, from a to b, with its triangle on the left and the other on the right
// (kNone where a mesh without polygons ends).
struct Side {
  Index left, right;
  int k;
  Vec3 a, b, middle;  // middle: projected
  Index lower, higher;
};

Side side_of(const Subject& subject, Index tri, int k) {
  const Triangle& triangle = subject.mesh.triangle(tri);
  const Index from = triangle.vertex[at(next_corner(k))];
  const Index to = triangle.vertex[at(previous_corner(k))];
  const Vec3 a = subject.mesh.position(from), b = subject.mesh.position(to);
  return {tri,
          triangle.neighbour[at(k)],
          k,
          a,
          b,
          subject.surface.project(0.5 * (a + b)),
          std::min(from, to),
          std::max(from, to)};
}

// (r^2 - |d - c|^2) / r^2 for the ball around c through a, without cancellation.
double depth_in_ball(const Vec3& centre, const Vec3& a, const Vec3& d) {
  const Vec3 step = d - a;
  return -step.dot(step + 2.0 * (a - centre)) / (a - centre).squaredNorm();
}

bool breaks_delaunay(const Subject& subject, const Workspace& work, const Side& side) {
  if (!subject.is_whole(side.left) || !subject.is_whole(side.right)) return false;
  const Triangle& right = subject.mesh.triangle(side.right);
  const Vec3 c = subject.mesh.position(subject.mesh.triangle(side.left).vertex[at(side.k)]);
  const Vec3 d = subject.mesh.position(right.vertex[at(side_towards(right, side.left))]);
  if (subject.surface.is_sphere()) return predicates::orient3d(side.a, side.b, c, d) > 0;
  return std::max(depth_in_ball(work.facets[at(side.left)].ball_centre, side.a, d),
                  depth_in_ball(work.facets[at(side.right)].ball_centre, side.a, c)) >
         kBallTolerance;
}

void measure_dual_edge(const Subject& subject, const Workspace& work, const Side& side,
                       EdgeSums& sums) {
  const Facet& left = work.facets[at(side.left)];
  const Facet& right = work.facets[at(side.right)];
  const Vec3 along = side.b - side.a;
  const double inverse_length = 1.0 / std::max(along.norm(), 1.0 / kUnbounded / kUnbounded);
  const Vec3 dual = left.ball_centre - right.ball_centre;
  const Vec3 leftward = subject.surface.normal(side.middle).cross(along);
  const double length = leftward.dot(dual) < 0.0 ? -dual.norm() : dual.norm();
  const Vec3 dual_middle = subject.surface.project(0.5 * (left.ball_centre + right.ball_centre));
  const double ratio = length * inverse_length;
  const double stagger = (dual_middle - side.middle).norm() * inverse_length;
  sums.dual_ratio += ratio;
  sums.dual_ratio_min.keep_lower({ratio, side.lower, side.higher});
  sums.stagger += stagger;
  sums.stagger_max.keep_higher({stagger, side.lower, side.higher});
  ++sums.n_dual;

  if (!subject.is_whole(side.left) || !subject.is_whole(side.right)) return;
  const bool left_smaller = left.area < right.area;
  const double small = left_smaller ? left.area : right.area;
  const double large = left_smaller ? right.area : left.area;
  const double grading = large < kUnbounded * small ? large / small : kUnbounded;
  sums.grading_max.keep_higher({grading, left_smaller ? side.left : side.right});
}

void measure_relative_edge(const Side& side, double length, double spacing, EdgeSums& sums) {
  // A spacing that is not > 0 must not pass for a small number: it spoils the sums, which are
  // looked at afterwards.
  const double relative =
      spacing > 0.0 ? length / spacing : std::numeric_limits<double>::quiet_NaN();
  sums.spacing_min.keep_lower({spacing});
  sums.spacing_max.keep_higher({spacing});
  sums.excess += relative - 1.0;
  sums.square_excess += (relative - 1.0) * (relative - 1.0);
  sums.relative_min.keep_lower({relative, side.lower, side.higher});
  sums.relative_max.keep_higher({relative, side.lower, side.higher});
  if (std::isfinite(relative)) sums.relative_bins.add(relative);
}

void measure_edge(const Subject& subject, const Workspace& work, const Side& side, double spacing,
                  EdgeSums& sums) {
  const double length = (side.b - side.a).norm();
  ++sums.n;
  sums.length += length;
  sums.length_min.keep_lower({length});
  sums.length_max.keep_higher({length});
  if (subject.knows_spacing()) measure_relative_edge(side, length, spacing, sums);
  if (side.right == kNone) return;
  sums.n_non_delaunay += breaks_delaunay(subject, work, side);
  measure_dual_edge(subject, work, side, sums);
}

double given_spacing(const Subject& subject, Index tri, int k) {
  const bool is_given = subject.field == nullptr && subject.knows_spacing();
  return is_given ? (*subject.side_spacing)(tri, k) : 0.0;
}

// Whether the side is between two cells, and this its only or its lower triangle.
bool is_own_side(const Subject& subject, Index tri, int k) {
  const Triangle& triangle = subject.mesh.triangle(tri);
  const Index beyond = triangle.neighbour[at(k)];
  if (beyond != kNone) return beyond > tri;
  return subject.border != nullptr && triangle.vertex[at(next_corner(k))] != kNone &&
         triangle.vertex[at(previous_corner(k))] != kNone;
}

// The sides of the triangles [begin, end) whose lower triangle is there, with their spacing.
EdgeSums measure_edges_of(const Subject& subject, const Workspace& work, std::int64_t begin,
                          std::int64_t end) {
  std::vector<Side> sides;
  Array<Vertex> places;
  for (auto tri = static_cast<Index>(begin); tri < end; ++tri) {
    for (int k = 0; k < 3; ++k) {
      if (!is_own_side(subject, tri, k)) continue;
      sides.push_back(side_of(subject, tri, k));
      const Side& side = sides.back();
      places.push_back(
          {side.middle.x(), side.middle.y(), side.middle.z(), given_spacing(subject, tri, k)});
    }
  }
  if (subject.field != nullptr) subject.field->evaluate(places);
  EdgeSums sums;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    measure_edge(subject, work, sides[i], places[i].spacing, sums);
  }
  return sums;
}

}  // namespace

EdgeSums measure_edges(parallel::Executor& exec, const Subject& subject, const Workspace& work) {
  return sum_blocks<EdgeSums>(exec, subject.mesh.n_triangles(),
                              [&](std::int64_t begin, std::int64_t end) {
                                return measure_edges_of(subject, work, begin, end);
                              });
}

EdgeSums measure_side(const Subject& subject, const Workspace& work, Index tri, int k) {
  EdgeSums sums;
  measure_edge(subject, work, side_of(subject, tri, k), given_spacing(subject, tri, k), sums);
  return sums;
}

}  // namespace delos::metrics
