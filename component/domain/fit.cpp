// SPDX-License-Identifier: BSD-3-Clause
#include "domain/fit.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "domain/cell_means.hpp"
#include "domain/tips.hpp"

namespace delos::domain {
namespace {

// Of the angles of a triangle at a vertex that moves, and of its sides over the spacing: what is
// left to the certificate's 90 degrees and 0.65 keeps edges and staggers sound.
constexpr double kLeastCosine = 0.13917310096006544;  // 82 degrees
constexpr double kMostCosine = 0.78801075360672196;   // 38 degrees
constexpr double kLeastSide = 0.75, kMostSide = 1.35;
// Of the way to where an edge would lie on the coast: both its cells move, and each has several.
constexpr double kFitDamping = 0.7;
// Cells across the coast part to so many spacings, by so much of what is missing: the farther they
// are apart, the nearer are the two rows of corners between them, and the smoother is the coast.
// What is wanted lies below kMostSide; more has a smoother coast that lies farther off (README).
constexpr double kAcross = 1.3, kPartingShare = 0.25;
constexpr int kStepHalvings = 3;  // of a step that is too long

class CoastFit {
 public:
  CoastFit(Context& context, const SeaToFit& sea, const FitOptions& options, Mesh& mesh)
      : context_(context),
        sea_(sea),
        options_(options),
        mesh_(mesh),
        triangle_at_(triangle_at_vertex(context.exec, mesh)),
        has_moved_(mesh.vertices.size(), 0) {
    std::vector<Index> all(mesh.vertices.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>(i);
    wet_.resize(all.size());
    look_at(all);
  }

  FitReport run() {
    FitReport report;
    std::vector<Index> coast = coastal(), nearby = ring_of(coast);
    report.misplaced_before_m2 = misplaced_m2(coast);
    for (int round = 0; round < options_.rounds; ++round) {
      for (const Index vertex : coast) move(vertex, shift_of(vertex));
      for (const Index vertex : nearby) move(vertex, towards_middle(vertex));
      std::vector<Index> changed = coast;
      changed.insert(changed.end(), nearby.begin(), nearby.end());
      look_at(changed);
      coast = coastal();
      nearby = ring_of(coast);
      context_.monitor.check_cancelled();
    }
    report.misplaced_after_m2 = misplaced_m2(coast);
    report.n_moved = std::count(has_moved_.begin(), has_moved_.end(), 1);
    return report;
  }

 private:
  template <class Visit>
  void neighbours(Index vertex, const Visit& visit) const {
    for_each_neighbour(mesh_, triangle_at_[at(vertex)], vertex, visit);
  }

  // visit(a, b) for the sides of its triangles that lie opposite to a vertex.
  template <class Visit>
  void opposite_sides(Index vertex, const Visit& visit) const {
    Index before = kNone, first = kNone;
    neighbours(vertex, [&](Index other) {
      if (before == kNone) {
        first = other;
      } else {
        visit(before, other);
      }
      before = other;
    });
    visit(before, first);
  }

  double spacing_between(Index a, Index b) const {
    return 0.5 * (mesh_.vertices[at(a)].spacing + mesh_.vertices[at(b)].spacing);
  }

  bool is_sea(Index vertex) const { return is_sea_[at(vertex)] != 0; }

  // As the ocean will be selected.
  void judge() {
    is_sea_ = wet_cells(context_.exec, wet_, sea_.least_wet);
    const auto neighbours_of = [&](Index cell, std::vector<Index>& around) {
      around.clear();
      neighbours(cell, [&](Index other) { around.push_back(other); });
    };
    clear_tips({wet_, sea_.least_wet, sea_.tip_margin}, neighbours_of, is_sea_);
  }

  // Wet shares of these cells as they are now.
  void look_at(const std::vector<Index>& cells) {
    Grid grid;
    grid.surface = options_.surface;
    grid.latitude = options_.latitude;
    Array<std::int64_t> offsets(1, 0);
    for (const Index cell : cells) {
      grid.cell_position.push_back(mesh_.position(cell));
      Index tri = triangle_at_[at(cell)];
      do {
        const auto& [a, b, c] = mesh_.triangle(tri).vertex;
        grid.vertices_on_cell.values.push_back(static_cast<Index>(grid.vertex_position.size()));
        grid.vertex_position.push_back(
            options_.surface.ball_centre(mesh_.position(a), mesh_.position(b), mesh_.position(c)));
        const auto corner = at(next_corner(own_corner_at(mesh_.triangle(tri), cell)));
        tri = mesh_.triangle(tri).neighbour[corner];
      } while (tri != triangle_at_[at(cell)]);
      offsets.push_back(static_cast<std::int64_t>(grid.vertices_on_cell.values.size()));
    }
    grid.vertices_on_cell.offsets = RowOffsets(std::move(offsets));
    const CellMeans means = mean_over_cells(context_, grid, sea_.elevation_m, sea_.sea_level_m);
    for (std::size_t i = 0; i < cells.size(); ++i) wet_[at(cells[i])] = means.wet_fraction[i];
    judge();
  }

  // Vertices with a neighbour across the coast, ascending.
  std::vector<Index> coastal() const {
    std::vector<Index> out;
    for (Index vertex = 0; vertex < mesh_.n_vertices(); ++vertex) {
      bool is_coastal = false;
      neighbours(vertex, [&](Index other) { is_coastal |= is_sea(other) != is_sea(vertex); });
      if (is_coastal) out.push_back(vertex);
    }
    return out;
  }

  // The vertices next to these and not among them, ascending.
  std::vector<Index> ring_of(const std::vector<Index>& vertices) const {
    std::vector<Index> out;
    for (const Index vertex : vertices) {
      neighbours(vertex, [&](Index other) {
        if (!std::binary_search(vertices.begin(), vertices.end(), other)) out.push_back(other);
      });
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  }

  // Where the coast is straight, the edge to a neighbour across it lies too far in the sea by what
  // their wet shares are above one, times their distance. Away from it, too, where it is near.
  Vec3 shift_of(Index vertex) const {
    Vec3 sum = Vec3::Zero();
    int n = 0;
    neighbours(vertex, [&](Index other) {
      if (is_sea(other) == is_sea(vertex)) return;
      const Vec3 across = mesh_.position(other) - mesh_.position(vertex);
      const double to_land = is_sea(vertex) ? 1.0 : -1.0;
      const double wanted = kAcross * spacing_between(vertex, other);
      sum += to_land * (wet_[at(vertex)] + wet_[at(other)] - 1.0) * across;
      sum -= kPartingShare * (wanted / across.norm() - 1.0) * across;
      ++n;
    });
    return n == 0 ? sum : Vec3(kFitDamping / n * sum);
  }

  Vec3 towards_middle(Index vertex) const {
    Vec3 sum = Vec3::Zero();
    int n = 0;
    neighbours(vertex, [&](Index other) {
      sum += mesh_.position(other) - mesh_.position(vertex);
      ++n;
    });
    return 0.5 / n * sum;
  }

  // The least margin of the triangles at a vertex: cosines of angles and sides, each over what it
  // must be; 1 is enough.
  double margin(Index vertex) const {
    double least = 1.0;
    const Vertex& here = mesh_.vertices[at(vertex)];
    const auto judge = [&](Index a, Index b) {
      const Vec3 p = mesh_.position(a) - here.position(), q = mesh_.position(b) - here.position();
      const Vec3 r = q - p;
      const double pp = p.norm(), qq = q.norm(), rr = r.norm();
      const auto [low, high] =
          std::minmax({p.dot(q) / (pp * qq), -p.dot(r) / (pp * rr), q.dot(r) / (qq * rr)});
      const double side = pp / spacing_between(vertex, a);
      least = std::min({least, low / kLeastCosine, (1.0 - high) / (1.0 - kMostCosine),
                        side / kLeastSide, kMostSide / side});
    };
    opposite_sides(vertex, judge);
    return least;
  }

  // As far as the triangles at the vertex stay as good as they must be, or as they were.
  void move(Index vertex, Vec3 shift) {
    if (mesh_.fixed.has_vertex(vertex)) return;
    Vertex& here = mesh_.vertices[at(vertex)];
    const Vertex old = here;
    const double needed = margin(vertex);
    for (int halving = 0; halving <= kStepHalvings; ++halving, shift *= 0.5) {
      const Vec3 p = options_.surface.project(old.position() + shift);
      here = {p.x(), p.y(), p.z(), old.spacing};
      if (margin(vertex) >= needed) {
        has_moved_[at(vertex)] = 1;
        return;
      }
    }
    here = old;
  }

  double misplaced_m2(const std::vector<Index>& coast) const {
    const double scale = options_.surface.scale_m();
    double sum = 0.0;
    for (const Index vertex : coast) {
      const double wet = wet_[at(vertex)];
      sum += (is_sea(vertex) ? 1.0 - wet : wet) * star_area(vertex) * scale * scale;
    }
    return sum;
  }

  // A third of the triangles at a vertex: its cell's area but for a few per cent.
  double star_area(Index vertex) const {
    Vec3 sum = Vec3::Zero();
    const Vec3 here = mesh_.position(vertex);
    const auto add = [&](Index a, Index b) {
      sum += (mesh_.position(a) - here).cross(mesh_.position(b) - here);
    };
    opposite_sides(vertex, add);
    return sum.norm() / 6.0;
  }

  Context& context_;
  const SeaToFit& sea_;
  const FitOptions& options_;
  Mesh& mesh_;
  std::vector<Index> triangle_at_;
  std::vector<char> has_moved_;
  Array<double> wet_;
  Mask is_sea_;
};

}  // namespace

FitReport fit_to_coast(Context& context, const SeaToFit& sea, const FitOptions& options,
                       Mesh& mesh) {
  return CoastFit(context, sea, options, mesh).run();
}

}  // namespace delos::domain
