// SPDX-License-Identifier: BSD-3-Clause
#include "relax/polish.hpp"

#include <algorithm>

#include "relax/patch.hpp"
#include "relax/repair.hpp"
#include "triangulation/flip.hpp"

namespace delos {
namespace {

constexpr std::int64_t kScanGrain = 16384;  // triangles a task: about half a millisecond
constexpr std::int64_t kPatchGrain = 4;     // patches a task: some hundred microseconds

// The means in order of strength; index 0 is tried first.
struct Means {
  int rings;  // of free vertices around the triangle
  bool change_topology;
};
constexpr std::array<Means, 5> kMeans = {{{1, false}, {2, false}, {2, true}, {3, true}, {4, true}}};
constexpr std::size_t kMovesOnly = 2;  // the first means, which only move vertices
// Where more than one triangle in so many is bad, and not a few of a coarse mesh either, the
// spacing itself is too rough for any mesh to follow: the bad ones lie in crowds, of which a round
// mends the rims, and searching for better topologies would only take time. Most of what can be
// gained there is gained in a few rounds.
constexpr std::size_t kHostileShare = 40;
constexpr std::size_t kHostileCount = 700;
constexpr int kHostileRounds = 16;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

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

bool is_bad(const Mesh& mesh, Index tri, double target) {
  const auto& v = mesh.triangle(tri).vertex;
  return !is_clearly_good(mesh.vertices[at(v[0])], mesh.vertices[at(v[1])], mesh.vertices[at(v[2])],
                          target) &&
         score(mesh, tri) < target;
}

// Ids of the triangles below the target, ascending.
std::vector<Index> find_bad(parallel::Executor& exec, const Mesh& mesh, double target) {
  return parallel::collect<Index>(
      exec, mesh.n_triangles(), kScanGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<Index>& found) {
        for (auto tri = static_cast<Index>(begin); tri < end; ++tri) {
          if (is_bad(mesh, tri, target)) found.push_back(tri);
        }
      });
}

// Picks disjoint patches: lists of free vertices whose triangles share no vertex.
class PatchPicker {
 public:
  PatchPicker(const Mesh& mesh, const TriangleAtVertex& at_vertex)
      : mesh_(mesh), at_vertex_(at_vertex), is_taken_(mesh.vertices.size(), 0) {}

  // The free vertices of the patch of `tri`, `rings` around it; empty when it meets another patch.
  std::vector<Index> pick(Index tri, int rings) {
    const auto& corners = mesh_.triangle(tri).vertex;
    std::vector<Index> closure(corners.begin(), corners.end());
    std::size_t n_free = 0;
    std::size_t ring_begin = 0;
    for (int ring = 0; ring <= rings; ++ring) {
      n_free = closure.size();
      add_ring(closure, ring_begin);
      ring_begin = n_free;
    }
    const bool is_clear =
        std::all_of(closure.begin(), closure.end(), [&](Index v) { return is_taken_[at(v)] == 0; });
    if (!is_clear) return {};
    for (const Index v : closure) is_taken_[at(v)] = 1;
    closure.resize(n_free);
    std::sort(closure.begin(), closure.end());
    return closure;
  }

 private:
  // Appends the neighbours of closure[begin..] that are not in it yet.
  void add_ring(std::vector<Index>& closure, std::size_t begin) const {
    const std::size_t end = closure.size();
    for (std::size_t i = begin; i < end; ++i) {
      const Index vertex = closure[i];
      Index tri = at_vertex_[at(vertex)];
      do {
        const Triangle& t = mesh_.triangle(tri);
        const int k = next_corner(corner_at(t, vertex));
        const Index neighbour = t.vertex[at(k)];
        if (std::find(closure.begin(), closure.end(), neighbour) == closure.end()) {
          closure.push_back(neighbour);
        }
        tri = t.neighbour[at(k)];
      } while (tri != at_vertex_[at(vertex)]);
    }
  }

  const Mesh& mesh_;
  const TriangleAtVertex& at_vertex_;
  std::vector<char> is_taken_;
};

// Means already tried in vain, by vertex; a triangle has those that all its corners have.
using TriedMeans = std::vector<std::uint8_t>;

std::size_t tried_at(const Mesh& mesh, const TriedMeans& tried, Index tri) {
  const auto& v = mesh.triangle(tri).vertex;
  return std::min({tried[at(v[0])], tried[at(v[1])], tried[at(v[2])]});
}

// A mesh and one triangle at each vertex.
struct MeshView {
  const Mesh& mesh;
  const TriangleAtVertex& at_vertex;
};

struct Job {
  Index triangle;
  Means means;
  std::vector<Index> free_vertices;
  ExtractedPatch patch;
  bool is_better = false;
};

std::vector<Job> pick_jobs(const Mesh& mesh, const TriangleAtVertex& at_vertex,
                           const TriedMeans& tried, std::size_t n_means,
                           const std::vector<Index>& bad) {
  PatchPicker picker(mesh, at_vertex);
  std::vector<Job> jobs;
  for (const Index tri : bad) {
    const std::size_t next = tried_at(mesh, tried, tri);
    if (next >= n_means) continue;
    std::vector<Index> free_vertices = picker.pick(tri, kMeans[next].rings);
    if (!free_vertices.empty()) {
      jobs.push_back({tri, kMeans[next], std::move(free_vertices), {}, false});
    }
  }
  return jobs;
}

void mend(Context& context, const Target& target, const RelaxOptions& options, const MeshView& view,
          std::vector<Job>& jobs) {
  parallel::for_index(
      context.exec, static_cast<std::int64_t>(jobs.size()), kPatchGrain, [&](std::int64_t i) {
        Job& job = jobs[static_cast<std::size_t>(i)];
        job.patch = extract_patch(view.mesh, view.at_vertex, job.free_vertices);
        job.is_better = repair_patch(
            target, {options.target_quality, options.repair && job.means.change_topology},
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

// Only triangles that were bad, have been written or lie next to those can be bad now.
std::vector<Index> still_bad(const Mesh& mesh, double target, std::vector<Index> bad,
                             const std::vector<Index>& written) {
  for (const Index tri : written) {
    const auto& around = mesh.triangle(tri).neighbour;
    bad.insert(bad.end(), around.begin(), around.end());
    bad.push_back(tri);
  }
  std::sort(bad.begin(), bad.end());
  bad.erase(std::unique(bad.begin(), bad.end()), bad.end());
  std::erase_if(bad, [&](Index tri) {
    return mesh.triangle(tri).vertex[0] == kNone || !is_bad(mesh, tri, target);
  });
  return bad;
}

}  // namespace

PolishReport polish(Context& context, const Target& target, const RelaxOptions& options,
                    Mesh& mesh) {
  PolishReport report;
  const Phase phase(context.monitor, "polish", mesh.n_triangles());
  std::vector<Index> bad = find_bad(context.exec, mesh, options.target_quality);
  context.monitor.advance(mesh.n_triangles() - static_cast<std::int64_t>(bad.size()));
  TriedMeans tried(mesh.vertices.size(), 0);
  TriangleAtVertex at_vertex = triangle_at_vertex(mesh);
  const auto n_before = static_cast<std::int64_t>(mesh.vertices.size());
  MeshEdits edits;
  const bool is_hostile =
      bad.size() > kHostileCount && bad.size() * kHostileShare > mesh.triangles.size();
  const std::size_t n_means = is_hostile ? kMovesOnly : kMeans.size();
  const int most_rounds =
      is_hostile ? std::min(kHostileRounds, options.polish_rounds) : options.polish_rounds;
  for (int round = 0; round < most_rounds && !bad.empty(); ++round) {
    context.monitor.check_cancelled();
    std::vector<Job> jobs = pick_jobs(mesh, at_vertex, tried, n_means, bad);
    if (jobs.empty()) break;
    mend(context, target, options, {mesh, at_vertex}, jobs);
    commit(jobs, mesh, at_vertex, tried, edits);
    std::vector<Index> written = edits.touched_triangles;
    report.n_flips += restore_delaunay(mesh, target.surface, edits.touched_triangles, &written);
    for (const Index tri : written) {
      for (const Index v : mesh.triangle(tri).vertex) at_vertex[at(v)] = tri;
    }
    const auto n_bad_before = static_cast<std::int64_t>(bad.size());
    bad = still_bad(mesh, options.target_quality, std::move(bad), written);
    context.monitor.advance(n_bad_before - static_cast<std::int64_t>(bad.size()));
    ++report.rounds;
  }
  report.n_inserted = static_cast<std::int64_t>(mesh.vertices.size()) - n_before;
  report.n_removed = static_cast<std::int64_t>(edits.dead_vertices.size());
  report.n_below_target = static_cast<std::int64_t>(bad.size());
  if (!edits.dead_vertices.empty()) compact(mesh, edits);
  return report;
}

}  // namespace delos
