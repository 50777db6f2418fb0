// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The passes behind measure_quality: triangles first, then edges and cells, which need the facets.
#include "core/parallel.hpp"
#include "geometry/ellipsoid.hpp"
#include "metrics/accumulate.hpp"
#include "metrics/quality.hpp"
#include "sizing/spacing.hpp"
#include "triangulation/mesh.hpp"

namespace delos::metrics {

/// Elements a block: its partial result (4 KB) stays small beside the block's own data.
inline constexpr std::int64_t kGrain = 16384;
/// What stands for an unbounded ratio of a triangle without area, so that no number is infinite.
inline constexpr double kUnbounded = 1e6;

/// What is measured.
struct Subject {
  const Ellipsoid& surface;
  const Mesh& mesh;
  const SpacingField* field = nullptr;  ///< one of the two, or none: not known
  const SideSpacing* side_spacing = nullptr;
  const MeshBorder* border = nullptr;

  bool knows_spacing() const {
    return field != nullptr || (side_spacing != nullptr && *side_spacing != nullptr);
  }
  /// A triangle between three cells.
  bool is_whole(Index tri) const {
    if (border == nullptr) return true;
    const auto& corner = mesh.triangle(tri).vertex;
    return std::find(corner.begin(), corner.end(), kNone) == corner.end();
  }
};

/// What the edges and the cells need of every triangle.
struct Facet {
  Vec3 ball_centre;
  double area;  ///< flat
};

inline constexpr double kNotMeasured = -1.0;

struct Workspace {
  std::vector<Facet> facets;        ///< [n_triangles]
  std::vector<double> area_length;  ///< [n_triangles] kNotMeasured where corners are missing
};

struct TriangleSums {
  Best area_length_min = Best::lowest(), angle_min = Best::lowest();
  Best angle_max = Best::highest(), radius_edge_max = Best::highest();
  double area_length = 0.0, deviation_deg = 0.0, radius_edge = 0.0;
  std::int64_t n_acute = 0, n_right = 0, n_degenerate = 0;
  std::int64_t n_cut = 0;  // miss corners
  Bins<100> area_length_bins{0.5, 1.0};
  Bins<180> angle_bins{0.0, 180.0};

  void add_angles(const std::array<double, 3>& angle_deg, Index tri) {
    for (const double angle : angle_deg) {
      angle_min.keep_lower({angle, tri});
      angle_max.keep_higher({angle, tri});
      deviation_deg += std::abs(angle - 60.0);
      angle_bins.add(angle);
    }
  }
  void merge(const TriangleSums& more) {
    area_length_min.keep_lower(more.area_length_min);
    angle_min.keep_lower(more.angle_min);
    angle_max.keep_higher(more.angle_max);
    radius_edge_max.keep_higher(more.radius_edge_max);
    area_length += more.area_length;
    deviation_deg += more.deviation_deg;
    radius_edge += more.radius_edge;
    n_acute += more.n_acute;
    n_right += more.n_right;
    n_degenerate += more.n_degenerate;
    n_cut += more.n_cut;
    area_length_bins.merge(more.area_length_bins);
    angle_bins.merge(more.angle_bins);
  }
};

struct EdgeSums {
  std::int64_t n = 0, n_dual = 0, n_non_delaunay = 0;  // n_dual: with both ends of the dual edge
  Best relative_min = Best::lowest(), relative_max = Best::highest();
  Best dual_ratio_min = Best::lowest(), stagger_max = Best::highest();
  Best grading_max = Best::highest();  // id = the smaller triangle
  Best length_min = Best::lowest(), length_max = Best::highest();
  Best spacing_min = Best::lowest(), spacing_max = Best::highest();
  double excess = 0.0, square_excess = 0.0;  // of the relative edge over 1
  double dual_ratio = 0.0, stagger = 0.0, length = 0.0;
  Bins<200> relative_bins{0.0, 2.0};

  void merge(const EdgeSums& more) {
    n += more.n;
    n_dual += more.n_dual;
    n_non_delaunay += more.n_non_delaunay;
    relative_min.keep_lower(more.relative_min);
    relative_max.keep_higher(more.relative_max);
    dual_ratio_min.keep_lower(more.dual_ratio_min);
    stagger_max.keep_higher(more.stagger_max);
    grading_max.keep_higher(more.grading_max);
    length_min.keep_lower(more.length_min);
    length_max.keep_higher(more.length_max);
    spacing_min.keep_lower(more.spacing_min);
    spacing_max.keep_higher(more.spacing_max);
    excess += more.excess;
    square_excess += more.square_excess;
    dual_ratio += more.dual_ratio;
    stagger += more.stagger;
    length += more.length;
    relative_bins.merge(more.relative_bins);
  }
};

struct CellSums {
  Best degree_min = Best::lowest(), degree_max = Best::highest();
  Best area_min = Best::lowest(), area_max = Best::highest();
  double area = 0.0;
  Bins<16> degree_bins{0.0, 16.0};

  void merge(const CellSums& more) {
    degree_min.keep_lower(more.degree_min);
    degree_max.keep_higher(more.degree_max);
    area_min.keep_lower(more.area_min);
    area_max.keep_higher(more.area_max);
    area += more.area;
    degree_bins.merge(more.degree_bins);
  }
};

/// Fills the workspace.
TriangleSums measure_triangles(parallel::Executor& exec, const Subject& subject, Workspace& work);
EdgeSums measure_edges(parallel::Executor& exec, const Subject& subject, const Workspace& work);
/// One side of a triangle, with a spacing that is known by side or not at all.
EdgeSums measure_side(const Subject& subject, const Workspace& work, Index tri, int k);
CellSums measure_cells(parallel::Executor& exec, const Subject& subject, const Workspace& work);

/// Sums of blocks, merged in block order: block(begin, end) -> Sums.
template <class Sums, class Block>
Sums sum_blocks(parallel::Executor& exec, std::int64_t n, Block&& block) {
  return parallel::reduce(exec, n, kGrain, Sums{}, block, [](Sums total, const Sums& more) {
    total.merge(more);
    return total;
  });
}

}  // namespace delos::metrics
