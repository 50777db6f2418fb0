// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/quality.hpp"

#include <algorithm>
#include <cmath>

#include "metrics/passes.hpp"

namespace delos {
namespace {

using metrics::Best;
using metrics::Subject;

// Turns the winners of the passes into places a person can find.
struct Places {
  const Subject& subject;
  LatitudeKind latitude;

  Extreme at_cell(const Best& best, double unit = 1.0) const {
    return extreme({best.value * unit, best.id, best.other}, Element::cell,
                   subject.mesh.position(best.id));
  }
  Extreme at_edge(const Best& best) const {
    return extreme(best, Element::edge,
                   subject.mesh.position(best.id) + subject.mesh.position(best.other));
  }
  Extreme at_triangle(const Best& best) const {
    const auto& corner = subject.mesh.triangle(best.id).vertex;
    return extreme(best, Element::triangle,
                   subject.mesh.position(corner[0]) + subject.mesh.position(corner[1]) +
                       subject.mesh.position(corner[2]));
  }

 private:
  Extreme extreme(const Best& best, Element element, const Vec3& towards) const {
    const Vec3 place = subject.surface.project(towards);
    return {best.value, best.id, best.other, subject.surface.lon_lat(place, latitude), element};
  }
};

constexpr std::int64_t kVertexGrain = 65536;  // a fraction of a millisecond
// Far above what single precision leaves; what is further off is no point of the surface.
constexpr double kSurfaceTolerance = 1e-3;

// Before anything is looked up at the vertices.
void check_vertices(parallel::Executor& exec, const Subject& subject) {
  DELOS_CHECK(subject.border != nullptr ||
                  (subject.mesh.n_vertices() >= 4 && subject.mesh.n_triangles() >= 4),
              ErrorKind::internal, "a mesh of ", subject.mesh.n_vertices(), " vertices and ",
              subject.mesh.n_triangles(), " triangles has no quality: a closed surface has 4.");
  const auto is_off = [&](std::int64_t vertex) {
    const Vec3 p = subject.mesh.position(static_cast<Index>(vertex));
    return !(std::abs(p.cwiseProduct(subject.surface.inverse_square()).dot(p) - 1.0) <
             kSurfaceTolerance);
  };
  const auto off = parallel::collect<std::int64_t>(
      exec, subject.mesh.n_vertices(), kVertexGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<std::int64_t>& found) {
        for (std::int64_t vertex = begin; vertex < end; ++vertex) {
          if (is_off(vertex)) found.push_back(vertex);
        }
      });
  if (off.empty()) return;
  const Vec3 p = subject.mesh.position(static_cast<Index>(off.front()));
  throw Error(ErrorKind::internal,
              text("cell ", off.front(), " (from 0) is at (", p.x(), ", ", p.y(), ", ", p.z(),
                   ") radii: no point of the surface, so there is no quality. ", off.size(),
                   " cells are so; look where they come from."));
}

// A sum is finite only if every one of its terms is: one look finds what comparisons pass over.
void check_finite(const char* measure, double sum) {
  DELOS_CHECK(std::isfinite(sum), ErrorKind::internal, "the sum of ", measure, " over the mesh is ",
              sum,
              ": at some element it is no number. Look for equal or opposite neighbours and, for "
              "relative_edge, for a wanted spacing that is not > 0.");
}

template <int N>
Histogram histogram(const metrics::Bins<N>& bins) {
  return {bins.lower, bins.upper, {bins.counts.begin(), bins.counts.end()}};
}

// The value that a fraction of the others stay below, linear between neighbours of the sorted list.
double percentile(std::vector<double>& values, double fraction) {
  const double position = fraction * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::ptrdiff_t>(position);
  std::nth_element(values.begin(), values.begin() + below, values.end());
  const double low = values[at(below)];
  if (at(below) + 1 == values.size()) return low;
  const double high = *std::min_element(values.begin() + below + 1, values.end());
  return low + (position - static_cast<double>(below)) * (high - low);
}

void check_sides_by_side(bool is_enough, const Subject& subject) {
  DELOS_CHECK(is_enough, ErrorKind::input, "a grid of ", subject.mesh.n_vertices(),
              " cells with a border has no two triangles side by side, so there is nothing to "
              "certify. Choose a larger region or domain, or a smaller spacing.");
}

void fill_triangles(const metrics::TriangleSums& sums, const Places& places, Quality& quality) {
  quality.n_triangles = places.subject.mesh.n_triangles() - sums.n_cut;
  quality.n_border_vertices = sums.n_cut;
  check_sides_by_side(quality.n_triangles > 0, places.subject);
  const auto n = static_cast<double>(quality.n_triangles);
  check_finite("area_length", sums.area_length);
  check_finite("the angles", sums.deviation_deg);
  check_finite("radius_edge", sums.radius_edge);
  quality.n_degenerate = sums.n_degenerate;
  quality.area_length_min = places.at_triangle(sums.area_length_min);
  quality.area_length_mean = sums.area_length / n;
  quality.angle_min_deg = places.at_triangle(sums.angle_min);
  quality.angle_max_deg = places.at_triangle(sums.angle_max);
  quality.angle_mad_deg = sums.deviation_deg / (3.0 * n);
  quality.radius_edge_max = places.at_triangle(sums.radius_edge_max);
  quality.radius_edge_mean = sums.radius_edge / n;
  quality.well_centred = static_cast<double>(sums.n_acute) / n;
  quality.n_obtuse = quality.n_triangles - sums.n_acute;
  quality.n_right = sums.n_right;
  quality.area_length = histogram(sums.area_length_bins);
  quality.angle_deg = histogram(sums.angle_bins);
}

void fill_spacing(const metrics::EdgeSums& sums, const Places& places, Quality& quality) {
  check_finite("relative_edge", sums.square_excess);
  const auto n = static_cast<double>(sums.n);
  const double metres = places.subject.surface.scale_m();
  const double excess = sums.excess / n;
  quality.knows_spacing = true;
  quality.relative_edge_min = places.at_edge(sums.relative_min);
  quality.relative_edge_max = places.at_edge(sums.relative_max);
  quality.relative_edge_mean = 1.0 + excess;
  quality.relative_edge_std = std::sqrt(std::max(0.0, sums.square_excess / n - excess * excess));
  quality.spacing_min_m = sums.spacing_min.value * metres;
  quality.spacing_max_m = sums.spacing_max.value * metres;
}

void fill_edges(const metrics::EdgeSums& sums, const Places& places, Quality& quality) {
  check_finite("the edges' lengths", sums.length);
  check_finite("dual_ratio", sums.dual_ratio);
  check_finite("stagger", sums.stagger);
  check_sides_by_side(sums.n_dual > 0 && sums.grading_max.id != kNone, places.subject);
  const auto n = static_cast<double>(sums.n), n_dual = static_cast<double>(sums.n_dual);
  const double metres = places.subject.surface.scale_m();
  quality.n_edges = sums.n;
  quality.n_non_delaunay = sums.n_non_delaunay;
  quality.grading_max = places.at_triangle(sums.grading_max);
  if (places.subject.knows_spacing()) fill_spacing(sums, places, quality);
  quality.dual_ratio_min = places.at_edge(sums.dual_ratio_min);
  quality.dual_ratio_mean = sums.dual_ratio / n_dual;
  quality.stagger_max = places.at_edge(sums.stagger_max);
  quality.stagger_mean = sums.stagger / n_dual;
  quality.edge_length_min_m = sums.length_min.value * metres;
  quality.edge_length_mean_m = sums.length / n * metres;
  quality.edge_length_max_m = sums.length_max.value * metres;
  quality.relative_edge = histogram(sums.relative_bins);
}

void fill_cells(const metrics::CellSums& sums, const Places& places, Quality& quality) {
  const auto n = static_cast<double>(quality.n_vertices);
  const Ellipsoid& surface = places.subject.surface;
  const double square_metres = surface.scale_m() * surface.scale_m();
  const auto& count = sums.degree_bins.counts;
  check_finite("the cells' areas", sums.area);
  quality.n_degree_5 = count[5];
  quality.n_degree_6 = count[6];
  quality.n_degree_7 = count[7];
  quality.n_degree_other = quality.n_vertices - count[5] - count[6] - count[7];
  quality.degree_5 = static_cast<double>(quality.n_degree_5) / n;
  quality.degree_6 = static_cast<double>(quality.n_degree_6) / n;
  quality.degree_7 = static_cast<double>(quality.n_degree_7) / n;
  quality.degree_other = static_cast<double>(quality.n_degree_other) / n;
  quality.degree_min = places.at_cell(sums.degree_min);
  quality.degree_max = places.at_cell(sums.degree_max);
  quality.cell_area_min_m2 = places.at_cell(sums.area_min, square_metres);
  quality.cell_area_max_m2 = places.at_cell(sums.area_max, square_metres);
  quality.total_area_m2 = sums.area * square_metres;
  quality.n_border_edges =
      places.subject.border == nullptr
          ? 0
          : places.subject.border->polygons->offsets.n_values() - 2 * quality.n_edges;
  if (!quality.has_border()) {
    quality.total_area_error = std::abs(sums.area / surface.area() - 1.0);
  }
  quality.degree = histogram(sums.degree_bins);
}

Quality measure(parallel::Executor& exec, const Subject& subject, LatitudeKind latitude) {
  check_vertices(exec, subject);
  const Places places{subject, latitude};
  Quality quality;
  quality.n_vertices = subject.mesh.n_vertices();
  metrics::Workspace work;
  fill_triangles(metrics::measure_triangles(exec, subject, work), places, quality);
  if (subject.border != nullptr) std::erase(work.area_length, metrics::kNotMeasured);
  quality.area_length_p01 = percentile(work.area_length, 0.01);
  fill_edges(metrics::measure_edges(exec, subject, work), places, quality);
  if (subject.border == nullptr || subject.border->polygons != nullptr) {
    fill_cells(metrics::measure_cells(exec, subject, work), places, quality);
  }
  quality.euler = quality.n_vertices - (quality.n_edges + quality.n_border_edges) +
                  quality.n_triangles + quality.n_border_vertices;
  return quality;
}

}  // namespace

Quality measure_quality(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
                        const Mesh& mesh, LatitudeKind latitude) {
  return measure(context.exec, {surface, mesh, &spacing}, latitude);
}

Quality measure_quality(Context& context, const Ellipsoid& surface, const SideSpacing& spacing,
                        const Mesh& mesh, LatitudeKind latitude) {
  return measure(context.exec, {surface, mesh, nullptr, &spacing}, latitude);
}

Quality measure_quality(Context& context, const CertifiedMesh& subject) {
  return measure(context.exec,
                 {subject.surface, subject.mesh, nullptr, &subject.spacing, subject.border},
                 subject.latitude);
}

}  // namespace delos
