// SPDX-License-Identifier: BSD-3-Clause
#include "refine/front.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "refine/room.hpp"
#include "refine/star_lanes.hpp"
#include "refine/work_mesh.hpp"

namespace delos {
namespace {

// Figures below are the best of scans at 1e5 vertices over smooth and bumpy spacings.
constexpr double kLongestFront = 1.45;   // a side longer than this times h is no front
constexpr double kLowestApex = 0.5;      // least height of an off-centre over its side, times h
constexpr double kNearestCentre = 1e-3;  // a circumcentre nearer to the side (times h) is behind it
constexpr double kSameSpacing = 1e-3;    // relative difference not worth placing an apex again
constexpr double kNudgeReach = 1.3;      // cavity vertices nearer than this times h pull
constexpr double kNudgeGain = 2.0;       // over their number: the length of the spring step
constexpr double kNudgeLeast = 0.02;     // a shorter step (times h) is not worth a second cavity
constexpr double kFlattestBorder = 0.35;  // least height over a constraint side, times its length
constexpr int kMaxCentreSweeps = 12;      // sweeps of circumcentre insertion; 3 are the most seen

struct Candidate {
  Index triangle;
  std::uint32_t stamp;  // the triangle's when queued: a mismatch means that it is gone
};

Vec3 sub(const Vertex& a, const Vertex& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

}  // namespace

struct FrontWorkspace::Impl {
  WorkMesh mesh;
  Cavity cavity;
  std::vector<Candidate> queue;
  std::vector<Index> local_of_triangle;  // skeleton triangle -> local, valid for this tile's only
};

FrontWorkspace::FrontWorkspace() : impl_(std::make_unique<Impl>()) {}
FrontWorkspace::~FrontWorkspace() = default;
FrontWorkspace::FrontWorkspace(FrontWorkspace&&) noexcept = default;

void FrontWorkspace::reserve(double expected_vertices) {
  constexpr double kRoom = 1.05;  // tiles are within a few percent of what they expect
  const auto room = static_cast<std::size_t>(kRoom * expected_vertices);
  reserve_pages(impl_->mesh.vertices, room);
  reserve_pages(impl_->mesh.triangles, 2 * room);
}

namespace {

class TileFront {
 public:
  TileFront(const FrontInput& input, FrontWorkspace::Impl& scratch)
      : input_(input),
        mesh_(scratch.mesh),
        cavity_(scratch.cavity),
        queue_(scratch.queue),
        local_of_triangle_(scratch.local_of_triangle),
        bounds_{4.0 / 27.0 * input.options.size_ratio * input.options.size_ratio,
                4.0 * input.options.radius_edge * input.options.radius_edge} {}

  TileMesh run(std::size_t tile) {
    load(tile);
    for (Index tri = 0; tri < n_triangles(); ++tri) enqueue_if_bad(tri);
    drain();
    insert_centres();
    return take();
  }

 private:
  Index n_triangles() const { return static_cast<Index>(mesh_.triangles.size()); }
  void load(std::size_t tile);
  void load_triangles(std::size_t tile);
  void enqueue_if_bad(Index tri) {
    if (is_bad(mesh_.at(tri))) queue_.push_back({tri, mesh_.at(tri).stamp});
  }
  static bool is_bad(const WorkTriangle& tri) { return (tri.stamp & WorkTriangle::kOverSize) != 0; }
  bool is_front(Index link) const { return link < 0 || !is_bad(mesh_.at(triangle_of(link))); }

  void drain();
  void insert_centres();
  bool advance_front(Index tri);
  int frontal_side(const WorkTriangle& tri) const;
  double centre_distance(const WorkTriangle& tri, const Vec3& middle, const Vec3& inward) const;
  bool place_off_centre(const WorkTriangle& tri, std::size_t side, Vertex& p) const;
  bool find_nudged_cavity(Index tri, Vertex& p);
  bool nudge(Vertex& p) const;
  bool border_allows(const Vec3& p) const;
  void insert(const Vertex& p);
  void classify_star(Index centre);
  void queue_fronts();
  void flag(WorkTriangle& tri) const;
  TileMesh take();

  const FrontInput& input_;
  WorkMesh& mesh_;
  Cavity& cavity_;
  std::vector<Candidate>& queue_;
  std::vector<Index>& local_of_triangle_;
  std::vector<Index> skeleton_vertices_;
  const BoundFactors bounds_;
};

void TileFront::load(std::size_t tile) {
  const Skeleton& skeleton = input_.skeleton;
  skeleton_vertices_.clear();
  for (const Index tri : skeleton.tile_triangles[tile]) {
    for (const Index v : skeleton.mesh.triangle(tri).vertex) skeleton_vertices_.push_back(v);
  }
  // Ascending, so that ties broken by local ids are broken as by the final ids.
  std::sort(skeleton_vertices_.begin(), skeleton_vertices_.end());
  skeleton_vertices_.erase(std::unique(skeleton_vertices_.begin(), skeleton_vertices_.end()),
                           skeleton_vertices_.end());
  mesh_.vertices.clear();
  for (const Index v : skeleton_vertices_) {
    mesh_.vertices.push_back(skeleton.mesh.vertices[static_cast<std::size_t>(v)]);
  }
  queue_.clear();
  mesh_.ball_surface =
      input_.surface.radii().minCoeff() < kFlattestForPlanes ? &input_.surface : nullptr;
  const bool has_line =
      !skeleton_vertices_.empty() && skeleton.mesh.fixed.has_vertex(skeleton_vertices_.front());
  mesh_.star_surface = has_line ? &input_.surface : mesh_.ball_surface;
  load_triangles(tile);
}

void TileFront::load_triangles(std::size_t tile) {
  const Skeleton& skeleton = input_.skeleton;
  const std::vector<Index>& ids = skeleton.tile_triangles[tile];
  const std::vector<Index>& border = skeleton.tile_half_segments[tile];
  local_of_triangle_.resize(skeleton.mesh.triangles.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    local_of_triangle_[static_cast<std::size_t>(ids[i])] = static_cast<Index>(i);
  }
  std::vector<std::pair<Index, Index>> slot_of_half;  // sorted by half-segment
  for (std::size_t slot = 0; slot < border.size(); ++slot) {
    slot_of_half.emplace_back(border[slot], static_cast<Index>(slot));
  }
  std::sort(slot_of_half.begin(), slot_of_half.end());
  mesh_.border_links.assign(border.size(), kNone);
  mesh_.triangles.assign(ids.size(), {});
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Triangle& source = skeleton.mesh.triangle(ids[i]);
    WorkTriangle& tri = mesh_.triangles[i];
    for (std::size_t k = 0; k < 3; ++k) {
      tri.vertex[k] = static_cast<Index>(
          std::lower_bound(skeleton_vertices_.begin(), skeleton_vertices_.end(), source.vertex[k]) -
          skeleton_vertices_.begin());
      const Index half = input_.half_segment[3 * static_cast<std::size_t>(ids[i]) + k];
      if (half == kNone) {
        const Index other = source.neighbour[k];
        tri.link[k] = 4 * local_of_triangle_[static_cast<std::size_t>(other)] +
                      side_towards(skeleton.mesh.triangle(other), ids[i]);
      } else {
        const auto found = std::lower_bound(slot_of_half.begin(), slot_of_half.end(),
                                            std::pair<Index, Index>(half, 0));
        tri.link[k] = ~found->second;
        mesh_.border_links[static_cast<std::size_t>(found->second)] =
            4 * static_cast<Index>(i) + static_cast<Index>(k);
      }
    }
    tri.stamp = 0;
    mesh_.cache_circle(tri);
    flag(tri);
  }
}

// Sets the stamp's flags. Both bounds compare squares, with R^2 = product / (4 |cross|^2).
void TileFront::flag(WorkTriangle& tri) const {
  const Vertex& a = mesh_.vertex(tri.vertex[0]);
  const Vertex& b = mesh_.vertex(tri.vertex[1]);
  const Vertex& c = mesh_.vertex(tri.vertex[2]);
  const Vec3 ab = sub(b, a), ac = sub(c, a), bc = sub(c, b);
  const double h = a.spacing + b.spacing + c.spacing;
  const double bb = ab.squaredNorm(), cc = ac.squaredNorm(), aa = bc.squaredNorm();
  const double product = aa * bb * cc, cross = ab.cross(ac).squaredNorm();
  if (product > bounds_.size * h * h * cross) tri.stamp |= WorkTriangle::kOverSize;
  if (product > bounds_.edge * std::min({aa, bb, cc}) * cross) {
    tri.stamp |= WorkTriangle::kOverRadiusEdge;
  }
}

// First in, first out: fronts advance evenly from all sides.
void TileFront::drain() {
  for (std::size_t head = 0; head < queue_.size(); ++head) {
    const Candidate next = queue_[head];
    if (mesh_.at(next.triangle).stamp == next.stamp) advance_front(next.triangle);
  }
  queue_.clear();
}

// The fallback that keeps the termination proof of Delaunay refinement: what has no front left
// gets its circumcentre, and the fronts that this opens are drained.
void TileFront::insert_centres() {
  bool has_inserted = true;
  for (int sweep = 0; has_inserted && sweep < kMaxCentreSweeps; ++sweep) {
    has_inserted = false;
    for (Index tri = 0; tri < n_triangles(); ++tri) {
      if (!is_bad(mesh_.at(tri))) continue;
      const auto& v = mesh_.at(tri).vertex;
      const Vec3 p =
          input_.surface.ball_centre(mesh_.vertex(v[0]).position(), mesh_.vertex(v[1]).position(),
                                     mesh_.vertex(v[2]).position());
      if (!mesh_.conflicts(mesh_.at(tri), p) || !mesh_.find_cavity(tri, p, cavity_) ||
          !border_allows(p)) {
        continue;
      }
      insert({p.x(), p.y(), p.z(), input_.spacing.at(p.x(), p.y(), p.z())});
      has_inserted = true;
      drain();
    }
  }
}

bool TileFront::advance_front(Index tri) {
  const int side = frontal_side(mesh_.at(tri));
  if (side < 0) return false;
  Vertex p;
  if (!place_off_centre(mesh_.at(tri), static_cast<std::size_t>(side), p)) return false;
  if (!find_nudged_cavity(tri, p) || !border_allows(p.position())) return false;
  insert(p);
  return true;
}

// The shortest side that an accepted triangle or the tile's border is behind; -1 when none.
int TileFront::frontal_side(const WorkTriangle& tri) const {
  const std::array<const Vertex*, 3> v = {
      &mesh_.vertex(tri.vertex[0]), &mesh_.vertex(tri.vertex[1]), &mesh_.vertex(tri.vertex[2])};
  const double h = (v[0]->spacing + v[1]->spacing + v[2]->spacing) * (kLongestFront / 3.0);
  double shortest = h * h;
  int side = -1;
  for (int k = 0; k < 3; ++k) {
    const Vec3 edge = sub(*v[static_cast<std::size_t>(previous_corner(k))],
                          *v[static_cast<std::size_t>(next_corner(k))]);
    const double square = edge.squaredNorm();
    if (square < shortest && is_front(tri.link[static_cast<std::size_t>(k)])) {
      shortest = square;
      side = k;
    }
  }
  return side;
}

// How far inward of the side's middle the centre of the surface Delaunay ball lies, measured in
// the tangent plane there: where the line of points equidistant from the corners, through the
// circumcentre and along the normal, meets that plane. Infinite when it does so beyond the horizon.
double TileFront::centre_distance(const WorkTriangle& tri, const Vec3& middle,
                                  const Vec3& inward) const {
  const Vertex& a = mesh_.vertex(tri.vertex[0]);
  if (mesh_.ball_surface != nullptr) {
    const Vec3 centre(tri.plane[0], tri.plane[1], tri.plane[2]);
    return centre.dot(middle) > 0.0 ? (centre - middle).dot(inward)
                                    : std::numeric_limits<double>::infinity();
  }
  const Vec3 u = sub(mesh_.vertex(tri.vertex[1]), a), v = sub(mesh_.vertex(tri.vertex[2]), a);
  const Vec3 n = u.cross(v);
  const Vec3 upward = middle.cwiseProduct(input_.surface.inverse_square());
  const double along = n.dot(upward);
  if (!(along > 0.0)) return std::numeric_limits<double>::infinity();
  if (input_.surface.is_sphere()) return n.dot(inward) / along;  // that line meets the centre
  const Vec3 centre = a.position() + (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) /
                                         (2.0 * n.squaredNorm());
  const Vec3 offset = centre - middle;
  return offset.dot(inward) - n.dot(inward) * (offset.dot(upward) / along);
}

// The apex of the isosceles triangle of the wanted size over the side, placed along the surface
// (in the plane of the triangle it would be wrong: ahead of the front triangles are huge and
// tilted), and never beyond the circumcentre.
bool TileFront::place_off_centre(const WorkTriangle& tri, std::size_t side, Vertex& p) const {
  const Ellipsoid& surface = input_.surface;
  const int k = static_cast<int>(side);
  const Vertex& a = mesh_.vertex(tri.vertex[static_cast<std::size_t>(next_corner(k))]);
  const Vertex& b = mesh_.vertex(tri.vertex[static_cast<std::size_t>(previous_corner(k))]);
  const Vec3 edge = sub(b, a);
  const double quarter_square = 0.25 * edge.squaredNorm();
  const Vec3 middle = 0.5 * (a.position() + b.position());
  Vec3 inward = middle.cwiseProduct(surface.inverse_square()).cross(edge);
  inward *= 1.0 / std::sqrt(inward.squaredNorm());
  const double h_side = 0.5 * (a.spacing + b.spacing);
  const double farthest = centre_distance(tri, middle, inward);
  if (farthest < kNearestCentre * h_side) return false;
  const auto apex = [&](double h) {
    const double height =
        std::sqrt(std::max(h * h - quarter_square, kLowestApex * kLowestApex * h * h));
    return surface.project(middle + std::min(height, farthest) * inward);
  };
  Vec3 q = apex(h_side);
  p.spacing = input_.spacing.at(q.x(), q.y(), q.z());
  if (std::abs(p.spacing - h_side) > kSameSpacing * h_side) q = apex(0.5 * (h_side + p.spacing));
  p.x = q.x();
  p.y = q.y();
  p.z = q.z();
  return true;
}

// Finds the cavity of p, moves p by one spring step against the cavity's near vertices, and finds
// the cavity of the new place. The single largest gain in quality of the front.
bool TileFront::find_nudged_cavity(Index tri, Vertex& p) {
  const auto find = [&](const Vertex& q) {
    return mesh_.conflicts(mesh_.at(tri), q.position()) &&
           mesh_.find_cavity(tri, q.position(), cavity_);
  };
  if (!find(p)) return false;
  Vertex moved = p;
  if (!nudge(moved)) return true;
  if (find(moved)) {
    p = moved;
    return true;
  }
  return find(p);
}

bool TileFront::nudge(Vertex& p) const {
  const double reach = kNudgeReach * p.spacing;
  Vec3 force(0, 0, 0);
  int n_near = 0;
  for (std::size_t i = 0; i < cavity_.size(); ++i) {
    const Vertex& v = mesh_.vertex(cavity_.start[i]);
    const Vec3 offset = sub(v, p);
    const double square = offset.squaredNorm();
    if (square < reach * reach) {
      force += (1.0 - 0.5 * (p.spacing + v.spacing) / std::sqrt(square)) * offset;
      ++n_near;
    }
  }
  const double least = kNudgeLeast * p.spacing;
  if (n_near <= 2 || force.squaredNorm() <= least * least) return false;
  const Vec3 q = input_.surface.project(p.position() + (kNudgeGain / n_near) * force);
  p.x = q.x();
  p.y = q.y();
  p.z = q.z();
  return true;
}

// A new triangle on a constraint side must lie inside the tile and not be flat.
bool TileFront::border_allows(const Vec3& p) const {
  for (std::size_t i = 0; i < cavity_.size(); ++i) {
    if (cavity_.link[i] >= 0) continue;
    const Vertex& u = mesh_.vertex(cavity_.start[i]);
    const Vertex& v = mesh_.vertex(cavity_.start[i + 1]);
    const Vec3 edge = sub(v, u);
    const double height_times_length = edge.cross(p - u.position()).dot(p);
    if (height_times_length < kFlattestBorder * edge.squaredNorm()) return false;
  }
  return true;
}

void TileFront::insert(const Vertex& p) {
  const auto id = static_cast<Index>(mesh_.vertices.size());
  mesh_.vertices.push_back(p);
  mesh_.fill_cavity(cavity_, id);
  classify_star(id);
  queue_fronts();
}

void TileFront::classify_star(Index centre) {
  const Vertex p = mesh_.vertex(centre);
  StarLanes star;
  CircleLanes circle;
  for (std::size_t first = 0; first < cavity_.size(); first += kLanes) {
    const std::size_t n = std::min(kLanes, cavity_.size() - first);
    for (std::size_t i = 0; i <= kLanes; ++i) {
      const Vertex& v = mesh_.vertex(cavity_.start[first + std::min(i, n)]);
      star.x[i] = v.x - p.x;
      star.y[i] = v.y - p.y;
      star.z[i] = v.z - p.z;
      star.spacing[i] = v.spacing;
    }
    flag_lanes(p, bounds_, star, circle);
    if (mesh_.ball_surface == nullptr) {
      plane_lanes(p, star, circle);
    } else {
      ball_lanes(p, mesh_.ball_surface->inverse_square(), star, circle);
    }
    for (std::size_t i = 0; i < n; ++i) {
      WorkTriangle& tri = mesh_.at(cavity_.triangles[first + i]);
      tri.plane = {circle.x[i], circle.y[i], circle.z[i]};
      tri.bound = circle.bound[i];
      if (circle.size_excess[i] > 0.0) tri.stamp |= WorkTriangle::kOverSize;
      if (circle.edge_excess[i] > 0.0) tri.stamp |= WorkTriangle::kOverRadiusEdge;
    }
  }
}

// Queues every bad triangle that the new star gives a front: those of the star next to a good one,
// and those outside next to a good one of the star.
void TileFront::queue_fronts() {
  const std::size_t n = cavity_.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Index id = cavity_.triangles[i];
    const WorkTriangle& tri = mesh_.at(id);
    if (is_bad(tri)) {
      if (is_front(tri.link[0]) || is_front(tri.link[1]) || is_front(tri.link[2])) {
        queue_.push_back({id, tri.stamp});
      }
    } else if (tri.link[0] >= 0) {
      enqueue_if_bad(triangle_of(tri.link[0]));
    }
  }
}

TileMesh TileFront::take() {
  TileMesh out;
  out.skeleton_vertices = std::move(skeleton_vertices_);
  out.inserted.assign(
      mesh_.vertices.begin() + static_cast<std::ptrdiff_t>(out.skeleton_vertices.size()),
      mesh_.vertices.end());
  out.triangles.reserve(mesh_.triangles.size());
  for (const WorkTriangle& tri : mesh_.triangles) {
    if ((tri.stamp & WorkTriangle::kOffBounds) != 0) {
      out.off_bounds.push_back(static_cast<Index>(out.triangles.size()));
    }
    Triangle t{tri.vertex, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      t.neighbour[k] = tri.link[k] < 0 ? kNone : triangle_of(tri.link[k]);
    }
    out.triangles.push_back(t);
  }
  for (const Index link : mesh_.border_links) {
    out.border.push_back({triangle_of(link), static_cast<int>(side_of(link))});
  }
  return out;
}

}  // namespace

TileMesh refine_tile(const FrontInput& input, std::size_t tile, FrontWorkspace& workspace) {
  return TileFront(input, workspace.impl()).run(tile);
}

}  // namespace delos
