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
  parallel::for_index(exec, static_cast<std::int64_t>(joined.new_id.size()), kScanGrain,
                      [&](std::int64_t v) {
                        const Index id = joined.new_id[at(v)];
                        if (id == kNone || region.change[at(v)] == Change::keep) return;
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
  bool is_obtuse, is_short;
};

Verdict judge(const SpacingField& spacing, const Mesh& mesh, const Triangle& t) {
  std::array<Vec3, 3> p;
  std::array<Vec3, 3> side;
  for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.position(t.vertex[k]);
  for (std::size_t k = 0; k < 3; ++k) side[k] = p[(k + 2) % 3] - p[(k + 1) % 3];
  // The angle between two sides is obtuse where, head to tail, their product is not negative.
  const double greatest =
      std::max({side[0].dot(side[1]), side[1].dot(side[2]), side[2].dot(side[0])});
  Verdict out{greatest >= 0.0, false};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 middle = 0.5 * (p[(k + 2) % 3] + p[(k + 1) % 3]);
    const double least = kRelativeEdgeBound * spacing.at(middle.x(), middle.y(), middle.z());
    if (side[k].squaredNorm() < least * least) out.is_short = true;
  }
  return out;
}

// Of the part, and of the triangles beside it: where a hole is narrow its filling has triangles
// without a free corner, too.
Missed find_missed(parallel::Executor& exec, const SpacingField& spacing, const Mesh& mesh,
                   const RelaxPart& part) {
  struct Found {
    Index triangle;
    Verdict verdict;
  };
  const auto is_beside = [&](Index tri) {
    const auto& v = mesh.triangle(tri).vertex;
    return std::none_of(v.begin(), v.end(), [&](Index i) { return part.is_free[at(i)] != 0; });
  };
  auto all = parallel::collect<Found>(
      exec, static_cast<std::int64_t>(part.triangles.size()), kScanGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<Found>& found) {
        const auto judge_one = [&](Index tri) {
          const Verdict verdict = judge(spacing, mesh, mesh.triangle(tri));
          if (verdict.is_obtuse || verdict.is_short) found.push_back({tri, verdict});
        };
        for (std::int64_t i = begin; i < end; ++i) {
          judge_one(part.triangles[at(i)]);
          for (const Index other : mesh.triangle(part.triangles[at(i)]).neighbour) {
            if (is_beside(other)) judge_one(other);
          }
        }
      });
  std::sort(all.begin(), all.end(),
            [](const Found& a, const Found& b) { return a.triangle < b.triangle; });
  all.erase(std::unique(all.begin(), all.end(),
                        [](const Found& a, const Found& b) { return a.triangle == b.triangle; }),
            all.end());
  Missed out;
  for (const Found& found : all) {
    out.triangles.push_back(found.triangle);
    out.n_obtuse += found.verdict.is_obtuse ? 1 : 0;
    out.n_short += found.verdict.is_short ? 1 : 0;
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
  Remeshed finish();

  Context& context_;
  const RemeshInput& input_;
  const RemeshOptions& options_;
  const Region& region_;
  RemeshReport& report_;
  Mesh mesh_;
  RelaxPart part_;
  Index n_survivors_ = 0;  // of the old vertices, when the holes were emptied
  // Old ids of the vertices that are not free, ascending. Nothing changes their order, so that the
  // i-th vertex that is not free is kept_[i].
  std::vector<Index> kept_;
};

void LocalRemesh::fill(const OldMesh& old) {
  const Phase phase(context_.monitor, "refine", region_.n_removed);
  const Holes holes = make_holes(context_, input_.surface, old, region_);
  const std::vector<TileMesh> fillings = fill_holes(
      context_, {input_.surface, input_.spacing, options_.refine, old, region_}, holes.holes);
  Joined joined = join(context_.exec, old, holes, fillings);
  report_.n_regions = static_cast<std::int64_t>(holes.holes.size());
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
  for (Index v = 0; v < old.mesh.n_vertices(); ++v) {
    if (region_.change[at(v)] == Change::keep) kept_.push_back(v);
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
  std::vector<Index> still_kept;
  std::size_t next_kept = 0;
  for (Index v = 0; v < mesh_.n_vertices(); ++v) {
    if (is_free[at(v)] != 0) continue;
    const Index old_id = kept_[next_kept++];
    if (region_.is_barred[at(old_id)] == 0 && std::binary_search(near.begin(), near.end(), v)) {
      is_free[at(v)] = 1;
      Vertex& vertex = mesh_.vertices[at(v)];
      vertex.spacing = input_.spacing.at(vertex.x, vertex.y, vertex.z);
    } else {
      still_kept.push_back(old_id);
    }
  }
  const bool has_released = still_kept.size() < kept_.size();
  kept_ = std::move(still_kept);
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

Remeshed LocalRemesh::finish() {
  report_.n_kept = static_cast<std::int64_t>(kept_.size());
  report_.n_moved = n_survivors_ - report_.n_kept;
  report_.n_inserted = mesh_.n_vertices() - n_survivors_;
  report_.changed_area = area(mesh_, part_.triangles) / input_.surface.area();
  Remeshed out{std::move(mesh_), std::vector<Index>(region_.change.size(), kNone)};
  std::size_t next_kept = 0;
  for (Index v = 0; v < out.mesh.n_vertices(); ++v) {
    if (part_.is_free[at(v)] == 0) out.new_id[at(kept_[next_kept++])] = v;
  }
  return out;
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
