// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/delaunay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "core/error.hpp"
#include "geometry/point_order.hpp"
#include "geometry/predicates.hpp"

namespace delos {
namespace {

// Incremental insertion (Bowyer 1981, Watson 1981) along a Hilbert curve. Every triangle caches
// its dual vertex u, the plane of the triangle being u.x = 1, so that "is p beyond this
// triangle?" is one dot product with an error bound; the exact predicate takes what that leaves.

/// A point in insertion order.
struct alignas(32) Site {
  double x, y, z;
  Index id;  ///< index of the input point
  Vec3 position() const { return {x, y, z}; }
};

/// A side of a triangle: 4 * triangle + side.
using Side = std::uint32_t;
constexpr Side make_side(std::uint32_t tri, std::uint32_t side) { return 4 * tri + side; }

/// One cache line.
struct alignas(64) Cell {
  double u[3];              ///< dual vertex; 0 when rounding leaves none
  double bound;             ///< on the error of u.p - 1; infinite when u is 0
  std::uint32_t vertex[3];  ///< in insertion order
  Side neighbour[3];        ///< the same side, seen from the neighbour
  std::uint32_t visited;    ///< the insertion that last took it into its cavity
};
static_assert(sizeof(Cell) == 64);

constexpr std::uint32_t kNoCell = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t next(std::uint32_t k) { return k == 2 ? 0 : k + 1; }
constexpr std::uint32_t previous(std::uint32_t k) { return k == 0 ? 2 : k - 1; }

class Builder {
 public:
  Builder(parallel::Executor& exec, std::span<const Vec3> points);
  void build();
  Mesh mesh(parallel::Executor& exec) const;
  const DelaunayReport& report() const { return report_; }

 private:
  std::vector<std::uint32_t> spread_sites() const;
  std::uint32_t support(const Vec3& direction) const;
  void start(const std::vector<std::uint32_t>& spread);
  void enclose_origin();
  void insert(std::uint32_t p);
  void insert_by_scan(std::uint32_t p);
  void fill(std::uint32_t p, std::uint32_t seed);
  void find_cavity(std::uint32_t p, std::uint32_t seed);
  std::uint32_t climb(const Site& p, double& height);
  std::uint32_t walk(std::uint32_t p, std::uint32_t tri);
  double height(const Cell& cell, const Site& p) const {
    return (cell.u[0] * p.x + cell.u[1] * p.y + cell.u[2] * p.z) - 1;
  }
  bool conflicts(const Cell& cell, std::uint32_t p) {
    const double h = height(cell, sites_[p]);
    if (h > cell.bound) return true;
    if (h < -cell.bound) return false;
    return conflicts_exactly(cell, p);
  }
  bool conflicts_exactly(const Cell& cell, std::uint32_t p);
  void set_plane(Cell& cell, bool encloses_origin);
  int orientation(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return predicates::orient_origin(sites_[a].position(), sites_[b].position(),
                                     sites_[c].position());
  }
  predicates::Site site(std::uint32_t p) const { return {sites_[p].position(), sites_[p].id}; }
  [[noreturn]] void refuse(std::uint32_t p) const;

  std::uint32_t n_sites_;
  std::unique_ptr<Site[]> sites_;
  std::unique_ptr<Cell[]> cells_;
  std::uint32_t n_cells_ = 0;
  std::uint32_t last_ = 0;
  double largest_radius_ = 0;
  bool origin_inside_ = false;
  std::vector<char> inserted_;
  // Workspace of one insertion: the cavity's triangles, its border in counter-clockwise order
  // (the side seen from outside the cavity, and the vertex where it begins), the search stack.
  std::vector<std::uint32_t> cavity_;
  std::vector<Side> border_;
  std::vector<std::uint32_t> border_vertex_;
  std::vector<Side> stack_;
  DelaunayReport report_;
};

Builder::Builder(parallel::Executor& exec, std::span<const Vec3> points)
    : n_sites_(static_cast<std::uint32_t>(points.size())),
      sites_(std::make_unique_for_overwrite<Site[]>(points.size())),
      cells_(std::make_unique_for_overwrite<Cell[]>(2 * points.size())),
      inserted_(points.size(), 0) {
  constexpr std::int64_t kGrain = 16384;
  const std::vector<Index> order = hilbert_order(exec, points);
  parallel::for_index(exec, n_sites_, kGrain, [&](std::int64_t k) {
    const Index id = order[static_cast<std::size_t>(k)];
    const Vec3& p = points[static_cast<std::size_t>(id)];
    sites_[static_cast<std::size_t>(k)] = {p.x(), p.y(), p.z(), id};
  });
  for (const Vec3& p : points) largest_radius_ = std::max(largest_radius_, p.squaredNorm());
  largest_radius_ = std::sqrt(largest_radius_) * (1 + 1e-15);
}

void Builder::build() {
  start(spread_sites());
  enclose_origin();
  for (std::uint32_t p = 0; p < n_sites_; ++p) {
    if (!inserted_[p]) insert(p);
  }
}

std::uint32_t Builder::support(const Vec3& direction) const {
  std::uint32_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::uint32_t p = 0; p < n_sites_; ++p) {
    const double along = sites_[p].position().dot(direction);
    if (along > most) {
      most = along;
      best = p;
    }
  }
  return best;
}

/// Sites near the corners and face centres of a cube, without repetition, in a fixed order.
std::vector<std::uint32_t> Builder::spread_sites() const {
  constexpr std::uint32_t kSamples = 20000;  // enough to come near every direction
  const std::array<Vec3, 14> directions = {{{1, 1, 1},
                                            {1, -1, -1},
                                            {-1, 1, -1},
                                            {-1, -1, 1},
                                            {-1, -1, -1},
                                            {-1, 1, 1},
                                            {1, -1, 1},
                                            {1, 1, -1},
                                            {1, 0, 0},
                                            {-1, 0, 0},
                                            {0, 1, 0},
                                            {0, -1, 0},
                                            {0, 0, 1},
                                            {0, 0, -1}}};
  std::array<double, 14> most;
  most.fill(-std::numeric_limits<double>::infinity());
  std::array<std::uint32_t, 14> best{};
  const std::uint32_t step = std::max(1U, n_sites_ / kSamples);
  for (std::uint32_t p = 0; p < n_sites_; p += step) {
    for (std::size_t d = 0; d < directions.size(); ++d) {
      const double along = sites_[p].position().dot(directions[d].normalized());
      if (along > most[d]) {
        most[d] = along;
        best[d] = p;
      }
    }
  }
  std::vector<std::uint32_t> spread;
  for (const std::uint32_t p : best) {
    if (std::find(spread.begin(), spread.end(), p) == spread.end()) spread.push_back(p);
  }
  return spread;
}

/// The first tetrahedron, then the other spread sites.
void Builder::start(const std::vector<std::uint32_t>& spread) {
  std::vector<std::uint32_t> candidates = spread;
  for (std::uint32_t p = 0; p < n_sites_; ++p) candidates.push_back(p);
  const std::uint32_t a = candidates[0];
  std::array<std::uint32_t, 4> tetrahedron = {a, a, a, a};
  std::size_t found = 1;
  for (std::size_t i = 1; i < candidates.size() && found < 4; ++i) {
    const std::uint32_t p = candidates[i];
    const Vec3 b = sites_[tetrahedron[1]].position();
    const bool independent =
        found == 1 ? sites_[p].position() != sites_[a].position()
        : found == 2
            // A third point off the line: off some plane through the line.
            ? (b - sites_[a].position()).cross(sites_[p].position() - sites_[a].position()).norm() >
                  0
            : predicates::orient3d(sites_[a].position(), b, sites_[tetrahedron[2]].position(),
                                   sites_[p].position()) != 0;
    if (independent) tetrahedron[found++] = p;
  }
  DELOS_CHECK(found == 4, ErrorKind::input, "all ", n_sites_,
              " points lie in one plane: a closed surface needs points all around it.");
  auto& [q0, q1, q2, q3] = tetrahedron;
  if (predicates::orient3d(sites_[q0].position(), sites_[q1].position(), sites_[q2].position(),
                           sites_[q3].position()) > 0) {
    std::swap(q0, q1);
  }
  // q3 is now below (q0, q1, q2); the table lists the outward faces.
  const std::uint32_t faces[4][3] = {{q0, q1, q2}, {q0, q3, q1}, {q1, q3, q2}, {q2, q3, q0}};
  constexpr Side kLinks[4][3] = {{make_side(2, 1), make_side(3, 1), make_side(1, 1)},
                                 {make_side(2, 2), make_side(0, 2), make_side(3, 0)},
                                 {make_side(3, 2), make_side(0, 0), make_side(1, 0)},
                                 {make_side(1, 2), make_side(0, 1), make_side(2, 0)}};
  n_cells_ = 4;
  for (std::size_t t = 0; t < 4; ++t) {
    std::copy_n(faces[t], 3, cells_[t].vertex);
    std::copy_n(kLinks[t], 3, cells_[t].neighbour);
    cells_[t].visited = kNoCell;
    set_plane(cells_[t], false);
  }
  for (const std::uint32_t p : tetrahedron) inserted_[p] = 1;
  for (const std::uint32_t p : spread) {
    if (!inserted_[p]) insert_by_scan(p);
  }
}

/// Adds the farthest site beyond any face that has the origin outside or on its plane.
void Builder::enclose_origin() {
  for (std::uint32_t tri = 0; tri < n_cells_;) {
    const Cell& cell = cells_[tri];
    if (orientation(cell.vertex[0], cell.vertex[1], cell.vertex[2]) > 0) {
      ++tri;
      continue;
    }
    const Vec3 a = sites_[cell.vertex[0]].position();
    const Vec3 b = sites_[cell.vertex[1]].position();
    const Vec3 c = sites_[cell.vertex[2]].position();
    const Vec3 normal = (b - a).cross(c - a);
    const std::uint32_t p = support(normal);
    DELOS_CHECK(!inserted_[p] && predicates::orient3d(a, b, c, sites_[p].position()) > 0,
                ErrorKind::input, "all ", n_sites_,
                " points lie on one side of a plane through the ", "centre (its normal is ",
                normal.x() / normal.norm(), ", ", normal.y() / normal.norm(), ", ",
                normal.z() / normal.norm(), "; points ", sites_[cell.vertex[0]].id, ", ",
                sites_[cell.vertex[1]].id, " and ", sites_[cell.vertex[2]].id,
                " come nearest): a closed surface needs points all around it.");
    insert_by_scan(p);
    tri = 0;
  }
  origin_inside_ = true;
  for (std::uint32_t tri = 0; tri < n_cells_; ++tri) set_plane(cells_[tri], true);
}

/// Insertion while the hull may not enclose the origin: every triangle is looked at.
void Builder::insert_by_scan(std::uint32_t p) {
  for (std::uint32_t tri = 0; tri < n_cells_; ++tri) {
    if (!conflicts(cells_[tri], p)) continue;
    fill(p, tri);
    return;
  }
  // Inside the hull so far, or on it: a point of a convex surface is so only by rounding or while
  // its neighbours are missing. The main pass comes back to it.
}

/// Normal over its distance from the origin, and the error bound of u.p - 1 for |p| up to the
/// largest radius R. With eps = 2^-53: the normal's components carry 4 eps of their permanents,
/// whose vector is below sqrt(2) |b - a| |c - a| and meets |p - a| <= 2 R: 11.4 eps K R with
/// K = (|b - a|^2 + |c - a|^2) / (2 n.a); the dot products, the quotient and the product by it
/// add 8 eps R sum|u_i|. Rounded up to 14 and 9, with 1.2e-16 for eps.
void Builder::set_plane(Cell& cell, bool encloses_origin) {
  constexpr double kEps = 1.2e-16;
  const Site& a = sites_[cell.vertex[0]];
  const Site& b = sites_[cell.vertex[1]];
  const Site& c = sites_[cell.vertex[2]];
  const double bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
  const double cx = c.x - a.x, cy = c.y - a.y, cz = c.z - a.z;
  const double nx = by * cz - bz * cy;
  const double ny = bz * cx - bx * cz;
  const double nz = bx * cy - by * cx;
  const double r = 1 / ((nx * a.x + ny * a.y) + nz * a.z);
  const double squares = (bx * bx + by * by + bz * bz) + (cx * cx + cy * cy + cz * cz);
  cell.u[0] = nx * r;
  cell.u[1] = ny * r;
  cell.u[2] = nz * r;
  const double size = std::abs(cell.u[0]) + std::abs(cell.u[1]) + std::abs(cell.u[2]);
  cell.bound = kEps * largest_radius_ * (9 * size + 7 * squares * r);
  // Below 1/4 the relative error of n.a is too, so that n.a > 0 for certain.
  if (encloses_origin && r > 0 && cell.bound < 0.25) return;
  cell.u[0] = cell.u[1] = cell.u[2] = 0;
  cell.bound = std::numeric_limits<double>::infinity();
}

bool Builder::conflicts_exactly(const Cell& cell, std::uint32_t p) {
  ++report_.n_exact;
  for (const std::uint32_t v : cell.vertex) {
    DELOS_CHECK(sites_[v].position() != sites_[p].position(), ErrorKind::input, "points ",
                std::min(sites_[v].id, sites_[p].id), " and ", std::max(sites_[v].id, sites_[p].id),
                " are the same point (", sites_[p].x, ", ", sites_[p].y, ", ", sites_[p].z,
                "): remove one of them.");
  }
  return predicates::in_circle_exact(site(cell.vertex[0]), site(cell.vertex[1]),
                                     site(cell.vertex[2]), site(p));
}

/// A triangle that p is beyond for certain, h > bound, on the way up the heights u.p - 1; else the
/// one where the way ends: where p sees through the hull, unless planes coincide.
std::uint32_t Builder::climb(const Site& p, double& h) {
  std::uint32_t tri = last_;
  h = height(cells_[tri], p);
  while (!(h > cells_[tri].bound)) {
    ++report_.n_walk_steps;
    const Cell& cell = cells_[tri];
    const std::uint32_t n0 = cell.neighbour[0] >> 2;
    const std::uint32_t n1 = cell.neighbour[1] >> 2;
    const std::uint32_t n2 = cell.neighbour[2] >> 2;
    const double h0 = height(cells_[n0], p);
    const double h1 = height(cells_[n1], p);
    const double h2 = height(cells_[n2], p);
    std::uint32_t best = tri;
    if (h0 > h) {
      h = h0;
      best = n0;
    }
    if (h1 > h) {
      h = h1;
      best = n1;
    }
    if (h2 > h) {
      h = h2;
      best = n2;
    }
    if (best == tri) break;
    tri = best;
  }
  return tri;
}

/// The triangle whose cone from the origin holds p, by exact orientation. The triangles are those
/// of a convex hull, on which this walk can't cycle.
std::uint32_t Builder::walk(std::uint32_t p, std::uint32_t tri) {
  ++report_.n_orientation_walks;
  for (std::uint32_t step = 0; step <= n_cells_; ++step) {
    const Cell& cell = cells_[tri];
    std::uint32_t towards = kNoCell;
    for (std::uint32_t k = 0; k < 3 && towards == kNoCell; ++k) {
      if (orientation(cell.vertex[next(k)], cell.vertex[previous(k)], p) < 0) {
        towards = cell.neighbour[k] >> 2;
      }
    }
    if (towards == kNoCell) return tri;
    tri = towards;
  }
  refuse(p);
}

void Builder::refuse(std::uint32_t p) const {
  std::uint32_t nearest = kNoCell;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t q = 0; q < n_sites_; ++q) {
    const double distance = (sites_[q].position() - sites_[p].position()).norm();
    if (q != p && distance < least) {
      least = distance;
      nearest = q;
    }
  }
  throw Error(
      ErrorKind::input,
      text("point ", sites_[p].id, " lies inside the hull of its neighbours; the nearest is ",
           "point ", sites_[nearest].id, " at a distance of ", least,
           " radii: points must be on a convex surface and farther apart than rounding."));
}

void Builder::insert(std::uint32_t p) {
  double h = 0;
  std::uint32_t tri = climb(sites_[p], h);
  if (!(h > cells_[tri].bound)) {
    // On the plane of the triangle within rounding: coplanar triangles may have stopped the climb.
    tri = walk(p, tri);
    conflicts(cells_[tri], p);  // Throws for a duplicate; the triangle is taken out either way.
  }
  fill(p, tri);
}

/// The triangles connected to the seed that p is beyond; depth first with the sides in
/// counter-clockwise order, so that the border comes out in order. No vertex of a convex surface
/// is swallowed, so the triangles form a tree; meeting one twice tells of a point inside the hull.
void Builder::find_cavity(std::uint32_t p, std::uint32_t seed) {
  cavity_.assign(1, seed);
  border_.clear();
  border_vertex_.clear();
  const Cell& first = cells_[seed];
  cells_[seed].visited = p;
  stack_.assign({first.neighbour[1], first.neighbour[0], first.neighbour[2]});
  while (!stack_.empty()) {
    const Side side = stack_.back();
    stack_.pop_back();
    Cell& cell = cells_[side >> 2];
    const std::uint32_t k = side & 3U;
    if (cell.visited == p) refuse(p);
    if (conflicts(cell, p)) {
      cell.visited = p;
      cavity_.push_back(side >> 2);
      stack_.push_back(cell.neighbour[previous(k)]);
      stack_.push_back(cell.neighbour[next(k)]);
    } else {
      border_.push_back(side);
      border_vertex_.push_back(cell.vertex[previous(k)]);
    }
  }
}

/// Replaces the cavity of p by the fan from p to its border.
void Builder::fill(std::uint32_t p, std::uint32_t seed) {
  find_cavity(p, seed);
  const std::size_t n = border_.size();
  report_.n_removed += static_cast<std::int64_t>(cavity_.size());
  cavity_.push_back(n_cells_);
  cavity_.push_back(n_cells_ + 1);
  n_cells_ += 2;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t tri = cavity_[i];
    const std::size_t after = i + 1 < n ? i + 1 : 0;
    const std::size_t before = i > 0 ? i - 1 : n - 1;
    Cell& cell = cells_[tri];
    cell.vertex[0] = p;
    cell.vertex[1] = border_vertex_[i];
    cell.vertex[2] = border_vertex_[after];
    cell.neighbour[0] = border_[i];
    cell.neighbour[1] = make_side(cavity_[after], 2);
    cell.neighbour[2] = make_side(cavity_[before], 1);
    cell.visited = kNoCell;
    cells_[border_[i] >> 2].neighbour[border_[i] & 3U] = make_side(tri, 0);
    set_plane(cell, origin_inside_);
    if (origin_inside_ && std::isinf(cell.bound) &&
        orientation(p, cell.vertex[1], cell.vertex[2]) <= 0) {
      refuse(p);
    }
  }
  last_ = cavity_[n - 1];
  inserted_[p] = 1;
}

Mesh Builder::mesh(parallel::Executor& exec) const {
  constexpr std::int64_t kGrain = 16384;
  Mesh mesh;
  mesh.vertices.resize(n_sites_);
  mesh.triangles.resize(n_cells_);
  parallel::for_index(exec, n_sites_, kGrain, [&](std::int64_t k) {
    const Site& s = sites_[static_cast<std::size_t>(k)];
    mesh.vertices[static_cast<std::size_t>(s.id)] = {s.x, s.y, s.z, 0};
  });
  parallel::for_index(exec, n_cells_, kGrain, [&](std::int64_t tri) {
    const Cell& cell = cells_[static_cast<std::size_t>(tri)];
    Triangle& out = mesh.triangles[static_cast<std::size_t>(tri)];
    for (std::size_t k = 0; k < 3; ++k) {
      out.vertex[k] = sites_[cell.vertex[k]].id;
      out.neighbour[k] = static_cast<Index>(cell.neighbour[k] >> 2);
    }
  });
  return mesh;
}

void check_points(std::span<const Vec3> points) {
  constexpr std::size_t kMostPoints = 500000000;
  DELOS_CHECK(points.size() >= 4, ErrorKind::input, points.size(),
              " points: a closed triangulation needs at least 4.");
  DELOS_CHECK(points.size() <= kMostPoints, ErrorKind::resource, points.size(), " points: at most ",
              kMostPoints, " fit the 32-bit ids.");
  for (std::size_t i = 0; i < points.size(); ++i) {
    DELOS_CHECK(points[i].allFinite(), ErrorKind::input, "point ", i, " is (", points[i].x(), ", ",
                points[i].y(), ", ", points[i].z(), "): coordinates must be finite.");
  }
}

}  // namespace

Mesh delaunay(parallel::Executor& exec, std::span<const Vec3> points, DelaunayReport* report) {
  check_points(points);
  Builder builder(exec, points);
  builder.build();
  if (report != nullptr) *report = builder.report();
  return builder.mesh(exec);
}

}  // namespace delos
