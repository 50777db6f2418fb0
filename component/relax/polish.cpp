// SPDX-License-Identifier: BSD-3-Clause
#include "relax/polish.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "relax/gaps.hpp"
#include "relax/patch.hpp"
#include "relax/repair.hpp"
#include "triangulation/flip.hpp"

namespace delos {
namespace {

constexpr std::int64_t kScanGrain = 16384;  // triangles a task: about half a millisecond
constexpr std::int64_t kPatchGrain = 4;     // patches a task: some hundred microseconds
constexpr std::int64_t kListGrain = 512;    // listed triangles a task: some ten microseconds

// The means in order of strength; index 0 is tried first.
struct Means {
  int rings;  // of free vertices around the triangle
  bool change_topology;
};
constexpr std::array<Means, 5> kMeans = {{{1, false}, {2, false}, {2, true}, {3, true}, {4, true}}};
constexpr std::size_t kMovesOnly = 2;  // the first means, which only move vertices
// A triangle this little below the target is not worth all means: the last two cost most and are
// for those that spoil a grid.
constexpr double kNearTarget = 0.01;
constexpr std::size_t kMeansNearTarget = 3;
// In a part of a mesh, which is to cost no more than its share, it is not worth more than moves:
// the first changes of topology would take half of the time of a new patch.
constexpr std::size_t kMeansNearTargetOfPart = kMovesOnly;
// The rougher the spacing, the lower the aim. From so many triangles on, not a few of a coarse
// mesh:
constexpr std::size_t kManyBad = 700;
// - Where one triangle in so many is below the target, all means go into those that are more than
//   kNearTarget below it.
constexpr std::size_t kRoughShare = 50;
// - Where one in so many is as far below as that, no mesh can follow the spacing: the bad triangles
//   lie in crowds, of which a round mends the rims, and searching for better topologies would only
//   take time. Most of what can be gained is gained by moves, in a few rounds.
constexpr std::size_t kHostileShare = 40;
constexpr int kHostileRounds = 16;
//   Then all means go into what is left below this, which still excludes an angle of 90 degrees;
//   unless even that is a crowd.
constexpr double kSafeQuality = 0.885;

double score(const Mesh& mesh, Index tri) {
  const Triangle& t = mesh.triangle(tri);
  const std::array<const Vertex*, 3> v = {&mesh.vertices[at(t.vertex[0])],
                                          &mesh.vertices[at(t.vertex[1])],
                                          &mesh.vertices[at(t.vertex[2])]};
  const Cotangents cot = cotangents(v[0]->position(), v[1]->position(), v[2]->position());
  return with_own_sides(triangle_score(*v[0], *v[1], *v[2]), cot, [&](std::size_t k) {
    const Triangle& other = mesh.triangle(t.neighbour[k]);
    const Vertex& apex = mesh.vertices[at(other.vertex[at(side_towards(other, tri))])];
    const int side = static_cast<int>(k);
    return cotangent(apex, *v[at(previous_corner(side))], *v[at(next_corner(side))]);
  });
}

// Triangles whose score is below the target.
struct Badness {
  double target;
  ClearlyGood clearly_good{target};

  bool has(const Mesh& mesh, Index tri) const {
    const auto& v = mesh.triangle(tri).vertex;
    const Vertex &a = mesh.vertices[at(v[0])], &b = mesh.vertices[at(v[1])],
                 &c = mesh.vertices[at(v[2])];
    const Vec3 p = a.position();
    return !clearly_good.holds(
               p, b.position() - p, c.position() - p,
               {a.spacing + b.spacing, a.spacing + c.spacing, b.spacing + c.spacing}) &&
           score(mesh, tri) < target;
  }
};

// A mesh and one triangle at each vertex.
struct MeshView {
  const Mesh& mesh;
  const TriangleAtVertex& at_vertex;
  const RelaxPart* part;  // null: every vertex is free

  bool is_free(Index vertex) const {
    return !mesh.fixed.has_vertex(vertex) && (part == nullptr || part->is_free[at(vertex)] != 0);
  }
  bool has_free_corner(Index tri) const {
    const auto& v = mesh.triangle(tri).vertex;
    return is_free(v[0]) || is_free(v[1]) || is_free(v[2]);
  }
};

// Ids of the triangles below the target that have a free corner, ascending; of a part when there is
// one.
std::vector<Index> find_bad(parallel::Executor& exec, const MeshView& view, double target) {
  const Badness bad{target};
  const auto n = view.part == nullptr ? static_cast<std::int64_t>(view.mesh.n_triangles())
                                      : static_cast<std::int64_t>(view.part->triangles.size());
  return parallel::collect<Index>(
      exec, n, kScanGrain, [&](std::int64_t begin, std::int64_t end, std::vector<Index>& found) {
        for (std::int64_t i = begin; i < end; ++i) {
          const Index tri = view.part == nullptr
                                ? static_cast<Index>(i)
                                : view.part->triangles[static_cast<std::size_t>(i)];
          if (bad.has(view.mesh, tri) && view.has_free_corner(tri)) found.push_back(tri);
        }
      });
}

// A triangle with the vertices around it: the first n_free may move, the others are their border.
struct Surroundings {
  std::vector<Index> vertices;
  std::size_t n_free = 0;
};

// Appends the neighbours of vertices[begin..] that are not in it yet.
void add_ring(const MeshView& view, std::size_t begin, std::vector<Index>& vertices) {
  const std::size_t end = vertices.size();
  for (std::size_t i = begin; i < end; ++i) {
    const Index vertex = vertices[i];
    for_each_neighbour(view.mesh, view.at_vertex[at(vertex)], vertex, [&](Index neighbour) {
      if (std::find(vertices.begin(), vertices.end(), neighbour) == vertices.end()) {
        vertices.push_back(neighbour);
      }
    });
  }
}

Surroundings surroundings(const MeshView& view, Index tri, int rings) {
  Surroundings found;
  const auto& corners = view.mesh.triangle(tri).vertex;
  found.vertices.assign(corners.begin(), corners.end());
  std::size_t ring_begin = 0;
  for (int ring = 0; ring <= rings; ++ring) {
    found.n_free = found.vertices.size();
    add_ring(view, ring_begin, found.vertices);
    ring_begin = found.n_free;
  }
  return found;
}

// Means already tried in vain, by vertex; a triangle has those that all its corners have.
using TriedMeans = std::vector<std::uint8_t>;

std::size_t tried_at(const Mesh& mesh, const TriedMeans& tried, Index tri) {
  const auto& v = mesh.triangle(tri).vertex;
  return std::min({tried[at(v[0])], tried[at(v[1])], tried[at(v[2])]});
}

// What polish sets out to do with a mesh.
struct Aim {
  double quality;
  std::size_t n_means;
  int most_rounds;
};

// Triangles to mend, ascending.
struct Wanted {
  const std::vector<Index>& triangles;
  const Aim& aim;
};

struct Job {
  Index triangle;
  Means means;
  std::vector<Index> free_vertices;
  ExtractedPatch patch;
  bool is_better = false;
};

// Jobs on disjoint patches, whose triangles share no vertex: of those that meet, the first stays.
// Looking around is done by all threads, choosing by one; `is_taken` is all false, and is so again
// afterwards.
std::vector<Job> pick_jobs(parallel::Executor& exec, const MeshView& view, const TriedMeans& tried,
                           const Wanted& wanted, std::vector<char>& is_taken) {
  const std::size_t n_near = view.part == nullptr ? kMeansNearTarget : kMeansNearTargetOfPart;
  std::vector<Job> jobs;
  for (const Index tri : wanted.triangles) {
    const std::size_t next = tried_at(view.mesh, tried, tri);
    if (next >= n_near && score(view.mesh, tri) >= wanted.aim.quality - kNearTarget) {
      continue;
    }
    if (next < wanted.aim.n_means) jobs.push_back({tri, kMeans[next], {}, {}, false});
  }
  std::vector<Surroundings> around(jobs.size());
  parallel::for_index(
      exec, static_cast<std::int64_t>(jobs.size()), kPatchGrain, [&](std::int64_t i) {
        const Job& job = jobs[static_cast<std::size_t>(i)];
        around[static_cast<std::size_t>(i)] = surroundings(view, job.triangle, job.means.rings);
      });
  std::vector<Index> taken;
  std::vector<Job> picked;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    std::vector<Index>& vertices = around[i].vertices;
    if (std::any_of(vertices.begin(), vertices.end(),
                    [&](Index v) { return is_taken[at(v)] != 0; })) {
      continue;
    }
    for (const Index v : vertices) is_taken[at(v)] = 1;
    taken.insert(taken.end(), vertices.begin(), vertices.end());
    vertices.resize(around[i].n_free);
    std::erase_if(vertices, [&](Index v) { return !view.is_free(v); });
    std::sort(vertices.begin(), vertices.end());
    jobs[i].free_vertices = std::move(vertices);
    picked.push_back(std::move(jobs[i]));
  }
  for (const Index v : taken) is_taken[at(v)] = 0;
  return picked;
}

void mend(Context& context, const Target& target, const RepairOptions& options,
          const MeshView& view, std::vector<Job>& jobs) {
  parallel::for_index(
      context.exec, static_cast<std::int64_t>(jobs.size()), kPatchGrain, [&](std::int64_t i) {
        Job& job = jobs[static_cast<std::size_t>(i)];
        job.patch = extract_patch(view.mesh, view.at_vertex, job.free_vertices);
        job.is_better = repair_patch(
            target, {options.enough, options.change_topology && job.means.change_topology},
            job.patch.patch);
      });
}

// Writes the better patches back and remembers what was tried where.
void commit(const std::vector<Job>& jobs, Mesh& mesh, TriangleAtVertex& at_vertex,
            TriedMeans& tried, MeshEdits& edits) {
  edits.touched_triangles.clear();
  for (const Job& job : jobs) {
    if (job.is_better) {
      for (const Index v : job.patch.origin.vertices) tried[at(v)] = 0;
      commit_patch(mesh, at_vertex, job.patch, edits);
      continue;
    }
    const auto next = static_cast<std::uint8_t>(tried_at(mesh, tried, job.triangle) + 1);
    for (const Index v : mesh.triangle(job.triangle).vertex) {
      tried[at(v)] = std::max(tried[at(v)], next);
    }
  }
  tried.resize(mesh.vertices.size(), 0);
}

// Lawson flips from the triangles that have been written; `written` gets those that flips write.
// Most of the written ones need none, which all threads find out together. Flips come to rest
// before the next seed is looked at, so leaving out seeds that need none changes nothing.
std::int64_t restore_around(parallel::Executor& exec, const Ellipsoid& surface, Mesh& mesh,
                            std::vector<Index>& written) {
  const std::vector<Index> seeds = parallel::collect<Index>(
      exec, static_cast<std::int64_t>(written.size()), kListGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<Index>& found) {
        for (std::int64_t i = begin; i < end; ++i) {
          const Index tri = written[static_cast<std::size_t>(i)];
          if (has_illegal_side(mesh, surface, tri)) found.push_back(tri);
        }
      });
  return restore_delaunay(mesh, surface, seeds, &written);
}

// Only triangles that were bad, have been written or lie next to those can be bad now. Most are not
// and come up several times, so they are judged as they come and only the bad ones put in order.
std::vector<Index> still_bad(parallel::Executor& exec, const MeshView& view, double target,
                             const std::vector<Index>& suspects,
                             const std::vector<Index>& written) {
  const Mesh& mesh = view.mesh;
  const Badness bad{target};
  const auto judge = [&](Index tri, std::vector<Index>& found) {
    if (mesh.triangle(tri).vertex[0] != kNone && view.has_free_corner(tri) && bad.has(mesh, tri)) {
      found.push_back(tri);
    }
  };
  const auto n_suspects = static_cast<std::int64_t>(suspects.size());
  std::vector<Index> still = parallel::collect<Index>(
      exec, n_suspects + static_cast<std::int64_t>(written.size()), kListGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<Index>& found) {
        for (std::int64_t i = begin; i < end; ++i) {
          if (i < n_suspects) {
            judge(suspects[static_cast<std::size_t>(i)], found);
            continue;
          }
          const Index tri = written[static_cast<std::size_t>(i - n_suspects)];
          judge(tri, found);
          for (const Index neighbour : mesh.triangle(tri).neighbour) judge(neighbour, found);
        }
      });
  std::sort(still.begin(), still.end());
  still.erase(std::unique(still.begin(), still.end()), still.end());
  return still;
}

// `bad`, the triangles below the target, keeps those that are aimed at.
Aim choose_aim(const MeshView& view, const RelaxOptions& options, std::vector<Index>& bad) {
  const Mesh& mesh = view.mesh;
  const Aim full{options.target_quality, kMeans.size(), options.polish_rounds};
  const std::size_t n_triangles =
      view.part == nullptr ? mesh.triangles.size() : view.part->triangles.size();
  const auto is_many = [&](std::size_t n, std::size_t share) {
    return n > kManyBad && n * share > n_triangles;
  };
  if (!is_many(bad.size(), kRoughShare)) return full;
  const double near_target = options.target_quality - kNearTarget;
  std::erase_if(bad, [&](Index tri) { return score(mesh, tri) >= near_target; });
  if (!is_many(bad.size(), kHostileShare)) return {near_target, full.n_means, full.most_rounds};
  return {near_target, kMovesOnly, std::min(kHostileRounds, options.polish_rounds)};
}

// What is left to do for the mesh after the first aim; nothing unless that was a low one.
std::optional<Aim> choose_last_aim(const MeshView& view, const RelaxOptions& options,
                                   const Aim& first, std::vector<Index>& bad) {
  if (first.n_means == kMeans.size()) return {};
  const Aim last{std::min(kSafeQuality, first.quality), kMeans.size(), options.polish_rounds};
  std::erase_if(bad, [&](Index tri) { return score(view.mesh, tri) >= last.quality; });
  if (bad.size() * kHostileShare > view.mesh.triangles.size()) return {};
  return last;
}

class Polisher {
 public:
  Polisher(Context& context, const Target& target, const RelaxOptions& options, Mesh& mesh,
           RelaxPart* part)
      : context_(context),
        target_(target),
        options_(options),
        mesh_(mesh),
        part_(part),
        at_vertex_(part == nullptr ? triangle_at_vertex(context.exec, mesh)
                                   : std::move(part->at_vertex)),
        view_{mesh, at_vertex_, part},
        tried_(mesh.vertices.size(), 0),
        is_taken_(mesh.vertices.size(), 0) {}

  PolishReport run() {
    const std::size_t n_triangles =
        part_ == nullptr ? mesh_.triangles.size() : part_->triangles.size();
    const std::size_t n_vertices = mesh_.vertices.size();
    bad_ = find_bad(context_.exec, view_, options_.target_quality);
    const Aim aim = choose_aim(view_, options_, bad_);
    context_.monitor.advance(static_cast<std::int64_t>(n_triangles - bad_.size()));
    mend_all(aim);
    const std::size_t n_below_target = bad_.size();
    if (const auto last = choose_last_aim(view_, options_, aim, bad_)) mend_all(*last);
    report_.n_below_target = static_cast<std::int64_t>(n_below_target);
    report_.n_inserted = static_cast<std::int64_t>(mesh_.vertices.size() - n_vertices);
    report_.n_removed = static_cast<std::int64_t>(edits_.dead_vertices.size());
    part_ != nullptr ? finish_part() : compact_mesh();
    return report_;
  }

 private:
  /// Rounds over the bad triangles until there are none, or nothing helps them.
  void mend_all(const Aim& aim) {
    const RepairOptions repair{aim.quality, options_.repair};
    for (int round = 0; round < aim.most_rounds && !bad_.empty(); ++round) {
      context_.monitor.check_cancelled();
      std::vector<Job> jobs = pick_jobs(context_.exec, view_, tried_, {bad_, aim}, is_taken_);
      if (jobs.empty()) break;
      mend(context_, target_, repair, view_, jobs);
      commit(jobs, mesh_, at_vertex_, tried_, edits_);
      is_taken_.resize(mesh_.vertices.size(), 0);
      if (part_ != nullptr) part_->is_free.resize(mesh_.vertices.size(), 1);
      std::vector<Index> written = edits_.touched_triangles;
      report_.n_flips += restore_around(context_.exec, target_.surface, mesh_, written);
      for (const Index tri : written) {
        for (const Index v : mesh_.triangle(tri).vertex) at_vertex_[at(v)] = tri;
      }
      if (part_ != nullptr) written_.insert(written_.end(), written.begin(), written.end());
      const std::size_t n_before = bad_.size();
      bad_ = still_bad(context_.exec, view_, aim.quality, bad_, written);
      context_.monitor.advance(static_cast<std::int64_t>(n_before) -
                               static_cast<std::int64_t>(bad_.size()));
      ++report_.rounds;
    }
  }

  void compact_mesh() {
    if (!edits_.dead_vertices.empty()) compact(context_.exec, mesh_, edits_);
  }

  // Takes out what patches gave up and brings the part up to date.
  void finish_part() {
    if (!fill_gaps(mesh_, at_vertex_, *part_, edits_)) {
      compact_part(context_.exec, mesh_, *part_, edits_);
      part_->triangles = triangles_of_free(context_.exec, mesh_, part_->is_free);
      return;
    }
    // Besides those written, what filled a gap may be new to the part.
    std::vector<Index>& triangles = part_->triangles;
    triangles.insert(triangles.end(), written_.begin(), written_.end());
    triangles.insert(triangles.end(), edits_.dead_triangles.begin(), edits_.dead_triangles.end());
    std::erase_if(triangles, [&](Index tri) {
      return tri >= mesh_.n_triangles() || !view_.has_free_corner(tri);
    });
    std::sort(triangles.begin(), triangles.end());
    triangles.erase(std::unique(triangles.begin(), triangles.end()), triangles.end());
  }

  Context& context_;
  const Target& target_;
  const RelaxOptions& options_;
  Mesh& mesh_;
  RelaxPart* part_;
  TriangleAtVertex at_vertex_;
  const MeshView view_;
  TriedMeans tried_;
  std::vector<char> is_taken_;
  std::vector<Index> bad_;
  std::vector<Index> written_;  // of a part, in all rounds
  MeshEdits edits_;
  PolishReport report_;
};

}  // namespace

PolishReport polish(Context& context, const Target& target, const RelaxOptions& options, Mesh& mesh,
                    RelaxPart* part) {
  const std::int64_t n_triangles =
      static_cast<std::int64_t>(part == nullptr ? mesh.triangles.size() : part->triangles.size());
  const Phase phase(context.monitor, "polish", n_triangles);
  return Polisher(context, target, options, mesh, part).run();
}

}  // namespace delos
