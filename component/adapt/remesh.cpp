// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/remesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "adapt/join.hpp"
#include "metrics/certificate.hpp"
#include "triangulation/flip.hpp"

namespace delos {
namespace {

constexpr std::int64_t kScanGrain = 16384;  // items a task: some ten microseconds
constexpr int kReleaseRings = 2;            // around a triangle that misses the certificate

Remeshed unchanged(const Mesh& mesh) {
  Remeshed out{mesh, std::vector<Index>(mesh.vertices.size())};
  std::iota(out.new_id.begin(), out.new_id.end(), 0);
  return out;
}

Remeshed rebuild(Context& context, const RemeshInput& input, const RemeshOptions& options,
                 RemeshReport& report) {
  RefineReport refined;
  Remeshed out{refine(context, input.surface, input.spacing, options.refine, refined),
               std::vector<Index>(input.mesh.vertices.size(), kNone)};
  report.relax = relax(context, input.surface, input.spacing, options.relax, out.mesh);
  report.n_kept = 0;
  report.n_removed = input.mesh.n_vertices();
  report.n_inserted = out.mesh.n_vertices();
  report.changed_area = 1.0;
  return out;
}

// Which vertices of the joined mesh may move, and the spacing that these are to have.
std::vector<char> set_free(parallel::Executor& exec, const SpacingField& spacing,
                           const Region& region, Joined& joined) {
  std::vector<char> is_free(joined.mesh.vertices.size(), 0);
  std::fill(is_free.begin() + joined.first_inserted, is_free.end(), 1);
  parallel::for_index(exec, static_cast<std::int64_t>(region.change.size()), kScanGrain,
                      [&](std::int64_t v) {
                        if (region.change[at(v)] == Change::keep) return;
                        const Index id = joined.new_id[at(v)];
                        if (id == kNone) return;
                        is_free[at(id)] = 1;
                        Vertex& vertex = joined.mesh.vertices[at(id)];
                        vertex.spacing = spacing.at(vertex.x, vertex.y, vertex.z);
                      });
  return is_free;
}

// Triangles that miss the certificate.
struct Missed {
  std::vector<Index> triangles;
  std::int64_t n_obtuse = 0, n_short = 0;
};

struct Verdict {
  bool is_obtuse = false, is_short = false;
};

// The side opposite to a corner: its square and, as a vertex whose spacing is to be looked up, its
// middle.
struct Side {
  double square;
  Vertex middle;
};

Side side_of(const Mesh& mesh, const Triangle& t, std::size_t k) {
  const Vec3 from = mesh.position(t.vertex[(k + 1) % 3]), to = mesh.position(t.vertex[(k + 2) % 3]);
  const Vec3 middle = 0.5 * (from + to);
  return {(to - from).squaredNorm(), {middle.x(), middle.y(), middle.z(), 0.0}};
}

bool is_short(double square, double spacing) {
  const double least = kRelativeEdgeBound * spacing;
  return square < least * least;
}

bool is_obtuse(const Mesh& mesh, const Triangle& t) {
  std::array<Vec3, 3> p;
  std::array<Vec3, 3> side;
  for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.position(t.vertex[k]);
  for (std::size_t k = 0; k < 3; ++k) side[k] = p[(k + 2) % 3] - p[(k + 1) % 3];
  // The angle between two sides is obtuse where, head to tail, their product is not negative.
  return std::max({side[0].dot(side[1]), side[1].dot(side[2]), side[2].dot(side[0])}) >= 0.0;
}

struct Found {
  Index triangle;
  Verdict verdict;
};

// Judges triangles of a part. Their sides are looked up together, and once for the two triangles
// that share one.
class Judge {
 public:
  Judge(const SpacingField& spacing, const Mesh& mesh, const RelaxPart& part,
        std::vector<Found>& found)
      : spacing_(spacing), mesh_(mesh), part_(part), found_(found) {}
  ~Judge() { look_up(); }
  Judge(const Judge&) = delete;
  Judge& operator=(const Judge&) = delete;

  void judge(Index tri) {
    const Triangle& t = mesh_.triangle(tri);
    if (is_obtuse(mesh_, t)) found_.push_back({tri, {true, false}});
    for (std::size_t k = 0; k < 3; ++k) {
      const Index other = t.neighbour[k];
      const bool is_beside = !has_free_corner(other);
      if (is_beside || tri < other) add_side(tri, other, k);
      if (is_beside) judge_beside(other);
    }
  }

 private:
  bool has_free_corner(Index tri) const {
    const auto& v = mesh_.triangle(tri).vertex;
    return std::any_of(v.begin(), v.end(), [&](Index i) { return part_.is_free[at(i)] != 0; });
  }
  // Where a hole is narrow its filling has triangles without a free corner, too.
  void judge_beside(Index tri) {
    const Triangle& t = mesh_.triangle(tri);
    if (is_obtuse(mesh_, t)) found_.push_back({tri, {true, false}});
    for (std::size_t k = 0; k < 3; ++k) add_side(tri, tri, k);
  }
  void add_side(Index tri, Index other, std::size_t k) {
    const Side side = side_of(mesh_, mesh_.triangle(tri), k);
    middles_[n_] = side.middle;
    sides_[n_] = {tri, other, side.square};
    if (++n_ == kBatch) look_up();
  }
  void look_up() {
    spacing_.evaluate(std::span(middles_).first(n_));
    for (std::size_t i = 0; i < n_; ++i) {
      if (!is_short(sides_[i].square, middles_[i].spacing)) continue;
      for (const Index tri : {sides_[i].triangle, sides_[i].other}) {
        found_.push_back({tri, {false, true}});
      }
    }
    n_ = 0;
  }

  static constexpr std::size_t kBatch = 256;  // what a lookup takes at once
  struct OfTwo {
    Index triangle, other;
    double square;
  };
  const SpacingField& spacing_;
  const Mesh& mesh_;
  const RelaxPart& part_;
  std::vector<Found>& found_;
  std::array<Vertex, kBatch> middles_;
  std::array<OfTwo, kBatch> sides_;
  std::size_t n_ = 0;
};

// Of the part, and of the triangles beside it.
Missed find_missed(parallel::Executor& exec, const SpacingField& spacing, const Mesh& mesh,
                   const RelaxPart& part) {
  auto all = parallel::collect<Found>(
      exec, static_cast<std::int64_t>(part.triangles.size()), kScanGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<Found>& found) {
        Judge judge(spacing, mesh, part, found);
        for (std::int64_t i = begin; i < end; ++i) judge.judge(part.triangles[at(i)]);
      });
  std::sort(all.begin(), all.end(),
            [](const Found& a, const Found& b) { return a.triangle < b.triangle; });
  Missed out;
  for (std::size_t i = 0; i < all.size();) {
    const Index tri = all[i].triangle;
    Verdict verdict;
    for (; i < all.size() && all[i].triangle == tri; ++i) {
      verdict.is_obtuse |= all[i].verdict.is_obtuse;
      verdict.is_short |= all[i].verdict.is_short;
    }
    out.triangles.push_back(tri);
    out.n_obtuse += verdict.is_obtuse ? 1 : 0;
    out.n_short += verdict.is_short ? 1 : 0;
  }
  return out;
}

double area(const Mesh& mesh, const std::vector<Index>& triangles) {
  double total = 0.0;
  for (const Index tri : triangles) {
    const auto& v = mesh.triangle(tri).vertex;
    const Vec3 a = mesh.position(v[0]);
    total += 0.5 * (mesh.position(v[1]) - a).cross(mesh.position(v[2]) - a).norm();
  }
  return total;
}

// A local remesh from the region to the relaxed mesh.
class LocalRemesh {
 public:
  LocalRemesh(Context& context, const RemeshInput& input, const RemeshOptions& options,
              const Region& region, RemeshReport& report)
      : context_(context), input_(input), options_(options), region_(region), report_(report) {}

  Remeshed run(const OldMesh& old);

 private:
  void fill(const OldMesh& old);
  std::vector<Index> free_triangles(Index first_filling, std::vector<Index> flipped) const;
  bool release(const Missed& missed);
  // visit(old id, id), ascending; it may set that vertex free.
  template <class Visit>
  void for_each_kept(const Visit& visit);
  Remeshed finish();

  Context& context_;
  const RemeshInput& input_;
  const RemeshOptions& options_;
  const Region& region_;
  RemeshReport& report_;
  Mesh mesh_;
  RelaxPart part_;
  Index n_survivors_ = 0;  // of the old vertices, when the holes were emptied
  // By old vertex: whether it is not free. Nothing changes the order of those that are not.
  std::vector<char> is_kept_;
};

void LocalRemesh::fill(const OldMesh& old) {
  const Phase phase(context_.monitor, "refine", region_.n_removed);
  const std::vector<Hole> holes = make_holes(context_, input_.surface, old, region_);
  const std::vector<TileMesh> fillings =
      fill_holes(context_, {input_.surface, input_.spacing, options_.refine, old, region_}, holes);
  Joined joined = join(context_.exec, old, holes, fillings);
  report_.n_regions = static_cast<std::int64_t>(holes.size());
  n_survivors_ = joined.first_inserted;
  report_.n_removed = old.mesh.n_vertices() - joined.first_inserted;
  std::vector<char> is_free = set_free(context_.exec, input_.spacing, region_, joined);
  // On an ellipsoid the hull predicate of the tile kernel differs a little from the surface
  // Delaunay triangulation everywhere.
  std::vector<Index> suspects = std::move(joined.hole_sides);
  if (!input_.surface.is_sphere()) {
    suspects.resize(at(joined.mesh.n_triangles() - joined.first_filling));
    std::iota(suspects.begin(), suspects.end(), joined.first_filling);
  }
  mesh_ = std::move(joined.mesh);
  std::vector<Index> flipped;
  restore_delaunay_around(context_.exec, mesh_, input_.surface, suspects, &flipped);
  for (const Index tri : flipped) {
    for (const Index v : mesh_.triangle(tri).vertex) joined.at_vertex[at(v)] = tri;
  }
  part_ = {std::move(is_free), {}, std::move(joined.at_vertex)};
  part_.triangles = free_triangles(joined.first_filling, std::move(flipped));
  is_kept_.resize(region_.change.size());
  for (std::size_t v = 0; v < is_kept_.size(); ++v) {
    is_kept_[v] = region_.change[v] == Change::keep ? 1 : 0;
  }
}

// triangles_of_free(), but where no old vertex moves all are fillings or were flipped.
std::vector<Index> LocalRemesh::free_triangles(Index first_filling,
                                               std::vector<Index> flipped) const {
  if (region_.n_moving > 0) return triangles_of_free(context_.exec, mesh_, part_.is_free);
  std::vector<Index> out = std::move(flipped);
  std::erase_if(out, [&](Index tri) { return tri >= first_filling; });
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  for (Index tri = first_filling; tri < mesh_.n_triangles(); ++tri) out.push_back(tri);
  std::erase_if(out, [&](Index tri) {
    const auto& corners = mesh_.triangle(tri).vertex;
    return std::none_of(corners.begin(), corners.end(),
                        [&](Index v) { return part_.is_free[at(v)] != 0; });
  });
  return out;
}

// Sets the vertices around the triangles free; false when there is none that may be.
bool LocalRemesh::release(const Missed& missed) {
  part_.at_vertex = triangle_at_vertex(context_.exec, mesh_);
  const std::vector<Index>& at_vertex = part_.at_vertex;
  std::vector<char>& is_free = part_.is_free;
  std::vector<Index> near;
  for (const Index tri : missed.triangles) {
    const auto& v = mesh_.triangle(tri).vertex;
    near.insert(near.end(), v.begin(), v.end());
  }
  for (int ring = 0; ring < kReleaseRings; ++ring) {
    const std::size_t end = near.size();
    for (std::size_t i = 0; i < end; ++i) {
      const Index vertex = near[i];
      for_each_neighbour(mesh_, at_vertex[at(vertex)], vertex,
                         [&](Index neighbour) { near.push_back(neighbour); });
    }
    std::sort(near.begin(), near.end());
    near.erase(std::unique(near.begin(), near.end()), near.end());
  }
  bool has_released = false;
  for_each_kept([&](Index old_id, Index v) {
    if (region_.is_barred[at(old_id)] != 0 || !std::binary_search(near.begin(), near.end(), v)) {
      return;
    }
    has_released = true;
    is_kept_[at(old_id)] = 0;
    is_free[at(v)] = 1;
    Vertex& vertex = mesh_.vertices[at(v)];
    vertex.spacing = input_.spacing.at(vertex.x, vertex.y, vertex.z);
  });
  return has_released;
}

Remeshed LocalRemesh::run(const OldMesh& old) {
  fill(old);
  const Target target{input_.surface, input_.spacing};
  report_.relax = relax_part(context_, target, options_.relax, part_, mesh_);
  RelaxOptions again = options_.relax;
  again.spring_rounds = 0;
  again.centroidal_rounds = 0;
  for (;;) {
    const Missed missed = find_missed(context_.exec, input_.spacing, mesh_, part_);
    report_.n_obtuse = missed.n_obtuse;
    report_.n_short = missed.n_short;
    if (missed.triangles.empty() || report_.release_rounds == options_.release_rounds ||
        !release(missed)) {
      break;
    }
    ++report_.release_rounds;
    part_.triangles = triangles_of_free(context_.exec, mesh_, part_.is_free);
    relax_part(context_, target, again, part_, mesh_);
  }
  return finish();
}

template <class Visit>
void LocalRemesh::for_each_kept(const Visit& visit) {
  Index v = 0;
  for (std::size_t old_id = 0; old_id < is_kept_.size(); ++old_id) {
    if (is_kept_[old_id] == 0) continue;
    while (part_.is_free[at(v)] != 0) ++v;
    visit(static_cast<Index>(old_id), v++);
  }
}

Remeshed LocalRemesh::finish() {
  report_.changed_area = area(mesh_, part_.triangles) / input_.surface.area();
  std::vector<Index> new_id(region_.change.size(), kNone);
  report_.n_kept = 0;
  for_each_kept([&](Index old_id, Index v) {
    new_id[at(old_id)] = v;
    ++report_.n_kept;
  });
  report_.n_moved = n_survivors_ - report_.n_kept;
  report_.n_inserted = mesh_.n_vertices() - n_survivors_;
  return {std::move(mesh_), std::move(new_id)};
}

}  // namespace

const char* to_string(RemeshKind kind) {
  switch (kind) {
    case RemeshKind::nothing:
      return "nothing";
    case RemeshKind::local:
      return "local";
    case RemeshKind::full:
      return "full";
  }
  return "unknown";
}

RemeshPlan plan_remesh(Context& context, const RemeshInput& input, const RemeshOptions& options) {
  const Mesh& mesh = input.mesh;
  DELOS_CHECK(input.is_fixed.empty() || input.is_fixed.size() == mesh.vertices.size(),
              ErrorKind::internal, "the mask of fixed vertices has ", input.is_fixed.size(),
              " entries for ", mesh.n_vertices(), " vertices.");
  RemeshPlan plan;
  plan.at_vertex = triangle_at_vertex(context.exec, mesh);
  plan.region = find_region(context.exec, {mesh, plan.at_vertex}, input.spacing, options.region,
                            input.is_fixed);
  if (plan.region.n_removed == 0) {
    plan.reason = "the spacing is still right, or off at too few vertices to be worth a change";
    return plan;
  }
  const double share = static_cast<double>(plan.region.n_removed) / mesh.n_vertices();
  const bool has_fixed = std::any_of(input.is_fixed.begin(), input.is_fixed.end(),
                                     [](char fixed) { return fixed != 0; });
  const bool has_lines = !options.refine.lines.empty();
  DELOS_CHECK(!has_lines || !has_fixed, ErrorKind::config,
              "a grid that keeps lines is made anew as a whole, so no cells can be fixed. Take the "
              "lines or the fixed regions out.");
  const bool is_full = has_lines || (share > options.full_share && !has_fixed);
  plan.kind = is_full ? RemeshKind::full : RemeshKind::local;
  plan.reason = text("the spacing is off around ", share, " of the vertices",
                     has_lines ? ": with lines to keep everything is made anew"
                     : is_full ? ": making everything anew costs less"
                               : "");
  return plan;
}

Remeshed remesh(Context& context, const RemeshInput& input, const RemeshOptions& options,
                const RemeshPlan& plan, RemeshReport& report) {
  report = {};
  report.kind = plan.kind;
  report.reason = plan.reason;
  report.n_wanted = plan.region.n_wanted;
  report.n_held = plan.region.n_held;
  report.n_kept = input.mesh.n_vertices();
  switch (plan.kind) {
    case RemeshKind::nothing:
      return unchanged(input.mesh);
    case RemeshKind::full:
      return rebuild(context, input, options, report);
    case RemeshKind::local:
      break;
  }
  return LocalRemesh(context, input, options, plan.region, report)
      .run({input.mesh, plan.at_vertex});
}

Remeshed remesh(Context& context, const RemeshInput& input, const RemeshOptions& options,
                RemeshReport& report) {
  return remesh(context, input, options, plan_remesh(context, input, options), report);
}

}  // namespace delos
