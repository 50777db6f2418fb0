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
constexpr int kMovesOnly = 2;               // rounds before the topology may change
constexpr int kWiden = 6;                   // a patch gets one more ring every so many rounds
constexpr int kFirstRings = 2;
constexpr int kMostRings = 5;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::vector<Index> concatenate(std::vector<Index> all, const std::vector<Index>& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

double score(const Mesh& mesh, Index tri) {
  const auto& v = mesh.triangle(tri).vertex;
  return triangle_score(mesh.vertices[at(v[0])], mesh.vertices[at(v[1])], mesh.vertices[at(v[2])]);
}

// Ids of the triangles below the target, ascending.
std::vector<Index> find_bad(parallel::Executor& exec, const Mesh& mesh, double target) {
  return parallel::reduce(
      exec, mesh.n_triangles(), kScanGrain, std::vector<Index>{},
      [&](std::int64_t begin, std::int64_t end) {
        std::vector<Index> found;
        for (auto tri = static_cast<Index>(begin); tri < end; ++tri) {
          if (score(mesh, tri) < target) found.push_back(tri);
        }
        return found;
      },
      concatenate);
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
    const bool is_clear = std::all_of(closure.begin(), closure.end(),
                                      [&](Index v) { return is_taken_[at(v)] == 0; });
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

struct RoundPlan {
  double target;
  int rings;
  bool change_topology;
};

// Mends patches around the bad triangles; the edits are committed but not compacted.
MeshEdits mend(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
               const RoundPlan& plan, const std::vector<Index>& bad, Mesh& mesh) {
  TriangleAtVertex at_vertex = triangle_at_vertex(mesh);
  PatchPicker picker(mesh, at_vertex);
  std::vector<std::vector<Index>> picked;
  for (const Index tri : bad) {
    std::vector<Index> free_vertices = picker.pick(tri, plan.rings);
    if (!free_vertices.empty()) picked.push_back(std::move(free_vertices));
  }
  std::vector<ExtractedPatch> mended(picked.size());
  std::vector<char> is_better(picked.size(), 0);
  const auto n = static_cast<std::int64_t>(picked.size());
  parallel::for_index(context.exec, n, kPatchGrain, [&](std::int64_t i) {
    const auto p = static_cast<std::size_t>(i);
    ExtractedPatch patch = extract_patch(mesh, at_vertex, picked[p]);
    if (repair_patch(surface, spacing, {plan.target, plan.change_topology}, patch.patch)) {
      mended[p] = std::move(patch);
      is_better[p] = 1;
    }
  });
  MeshEdits edits;
  for (std::size_t p = 0; p < mended.size(); ++p) {
    if (is_better[p] != 0) commit_patch(mesh, at_vertex, mended[p], edits);
  }
  return edits;
}

}  // namespace

void polish(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
            const RelaxOptions& options, Mesh& mesh, RelaxReport& report) {
  std::vector<Index> bad = find_bad(context.exec, mesh, options.target_quality);
  const Phase phase(context.monitor, "polish", static_cast<std::int64_t>(bad.size()));
  for (int round = 0; round < options.polish_rounds && !bad.empty(); ++round) {
    context.monitor.check_cancelled();
    const RoundPlan plan{options.target_quality,
                         std::min(kFirstRings + round / kWiden, kMostRings),
                         options.repair && round >= kMovesOnly};
    const auto n_before = static_cast<std::int64_t>(mesh.vertices.size());
    MeshEdits edits = mend(context, surface, spacing, plan, bad, mesh);
    report.n_inserted += static_cast<std::int64_t>(mesh.vertices.size()) - n_before;
    report.n_removed += static_cast<std::int64_t>(edits.dead_vertices.size());
    if (!edits.dead_vertices.empty()) compact(mesh, edits);
    report.n_flips += restore_delaunay(mesh, surface, edits.touched_triangles);
    const std::size_t n_bad_before = bad.size();
    bad = find_bad(context.exec, mesh, options.target_quality);
    context.monitor.advance(static_cast<std::int64_t>(n_bad_before) -
                            static_cast<std::int64_t>(bad.size()));
    ++report.polish_rounds;
  }
  report.n_below_target = static_cast<std::int64_t>(bad.size());
}

}  // namespace delos
