// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/region.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "core/error.hpp"

namespace delos {
namespace {

constexpr std::int64_t kCompareGrain = 8192;  // vertices a task: about a quarter millisecond
constexpr std::int64_t kCompareBatch = 256;   // looked up together, in the first-level cache

template <class Visit>
void for_each_neighbour(const OldMesh& old, Index vertex, const Visit& visit) {
  delos::for_each_neighbour(old.mesh, old.at_vertex[at(vertex)], vertex, visit);
}

// How the two spacings compare at a vertex.
enum Fit : char { fits, off_blend, off_tolerance };

std::vector<char> compare_spacings(parallel::Executor& exec, const Mesh& mesh,
                                   const SpacingField& spacing, const RegionOptions& options) {
  std::vector<char> fit(mesh.vertices.size());
  const auto is_within = [](double before, double now, double ratio) {
    return before <= ratio * now && now <= ratio * before;
  };
  parallel::for_range(
      exec, mesh.n_vertices(), kCompareGrain, [&](std::int64_t begin, std::int64_t end) {
        std::array<Vertex, kCompareBatch> now;
        for (std::int64_t first = begin; first < end; first += kCompareBatch) {
          const std::int64_t n = std::min(kCompareBatch, end - first);
          std::copy_n(mesh.vertices.begin() + first, n, now.begin());
          spacing.evaluate(std::span(now).first(at(n)));
          for (std::int64_t i = 0; i < n; ++i) {
            const double before = mesh.vertices[at(first + i)].spacing;
            const double after = now[at(i)].spacing;
            fit[at(first + i)] = is_within(before, after, options.blend)       ? fits
                                 : is_within(before, after, options.tolerance) ? off_blend
                                                                               : off_tolerance;
          }
        }
      });
  return fit;
}

// A growing set of vertices.
class Growth {
 public:
  Growth(const OldMesh& old, std::vector<char> is_barred)
      : old_(old), is_in_(std::move(is_barred)) {
    for (char& mark : is_in_) mark = mark != 0 ? never : out_of_it;
  }

  void add(Index vertex) {
    if (is_in_[at(vertex)] != out_of_it) return;
    is_in_[at(vertex)] = inside;
    members_.push_back(vertex);
  }
  // Adds the neighbours of the vertices added since the last call that `accepts` agrees to.
  template <class Accepts>
  void add_ring(const Accepts& accepts) {
    const std::size_t end = members_.size();
    for (; next_ < end; ++next_) {
      for_each_neighbour(old_, members_[next_], [&](Index neighbour) {
        if (accepts(neighbour)) add(neighbour);
      });
    }
  }
  bool has(Index vertex) const { return is_in_[at(vertex)] == inside; }
  const std::vector<Index>& members() const { return members_; }

 private:
  enum Mark : char { out_of_it, inside, never };
  const OldMesh& old_;
  std::vector<char> is_in_;
  std::vector<Index> members_;  // in the order of their coming
  std::size_t next_ = 0;        // the first whose neighbours have not been looked at
};

// Fixed vertices and their neighbours.
std::vector<char> barred(const OldMesh& old, const std::vector<char>& is_fixed) {
  std::vector<char> out(old.mesh.vertices.size(), 0);
  for (std::size_t v = 0; v < is_fixed.size(); ++v) {
    if (is_fixed[v] == 0) continue;
    out[v] = 1;
    for_each_neighbour(old, static_cast<Index>(v),
                       [&](Index neighbour) { out[at(neighbour)] = 1; });
  }
  return out;
}

// The wanted vertices with the rings that are always added, less the parts that hold too few
// wanted ones.
std::vector<Index> wanted_parts(const OldMesh& old, const std::vector<char>& fit,
                                const std::vector<char>& is_barred, const RegionOptions& options) {
  Growth grown(old, is_barred);
  for (Index v = 0; v < old.mesh.n_vertices(); ++v) {
    if (fit[at(v)] == off_tolerance) grown.add(v);
  }
  for (int ring = 0; ring < options.rings; ++ring) grown.add_ring([](Index) { return true; });
  std::vector<char> is_seen(fit.size(), 0);
  std::vector<Index> kept, part;
  for (const Index seed : grown.members()) {
    if (is_seen[at(seed)] != 0) continue;
    part.assign(1, seed);
    is_seen[at(seed)] = 1;
    std::int64_t n_wanted = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      if (fit[at(part[i])] == off_tolerance) ++n_wanted;
      for_each_neighbour(old, part[i], [&](Index neighbour) {
        if (!grown.has(neighbour) || is_seen[at(neighbour)] != 0) return;
        is_seen[at(neighbour)] = 1;
        part.push_back(neighbour);
      });
    }
    if (n_wanted >= options.least_wanted) kept.insert(kept.end(), part.begin(), part.end());
  }
  return kept;
}

// Rings around the wanted vertices in which steps of `blend` lead through `tolerance`.
int passing_rings(const RegionOptions& options) {
  int n = 0;
  for (double ratio = options.blend; ratio < options.tolerance && n < options.blend_rings; ++n) {
    ratio *= options.blend;
  }
  return std::max(n, options.rings);
}

// The wanted parts with all their rings; their shares of the wanted spacing.
Growth grown_parts(const OldMesh& old, const std::vector<char>& fit,
                   const std::vector<char>& is_barred, const RegionOptions& options,
                   std::vector<double>& share) {
  if (options.passes) share.assign(fit.size(), 0.0);
  Growth grown(old, is_barred);
  for (const Index v : wanted_parts(old, fit, is_barred, options)) {
    if (!options.passes || fit[at(v)] == off_tolerance) grown.add(v);
  }
  const int n_rings = options.passes ? passing_rings(options) : options.blend_rings;
  const auto give = [&](std::size_t first, double value) {
    if (!options.passes) return;
    for (std::size_t i = first; i < grown.members().size(); ++i) {
      share[at(grown.members()[i])] = value;
    }
  };
  give(0, 1.0);
  for (int ring = 1; ring <= n_rings; ++ring) {
    const std::size_t first = grown.members().size();
    const bool takes_all = options.passes && ring <= options.rings;
    grown.add_ring([&](Index v) { return takes_all || fit[at(v)] != fits; });
    give(first, 1.0 - ring / (n_rings + 1.0));
  }
  return grown;
}

// Vertices around the removed ones that stay but may move; how many.
std::int64_t let_move(const OldMesh& old, const std::vector<char>& is_barred,
                      const std::vector<Index>& removed, int n_rings, std::vector<Change>& change) {
  Growth moving(old, is_barred);
  for (const Index v : removed) moving.add(v);
  for (int ring = 0; ring < n_rings; ++ring) moving.add_ring([](Index) { return true; });
  for (const Index v : moving.members()) {
    if (change[at(v)] == Change::keep) change[at(v)] = Change::move;
  }
  return static_cast<std::int64_t>(moving.members().size() - removed.size());
}

}  // namespace

Region find_region(parallel::Executor& exec, const OldMesh& old, const SpacingField& spacing,
                   const RegionOptions& options, const std::vector<char>& is_fixed) {
  const std::vector<char> fit = compare_spacings(exec, old.mesh, spacing, options);
  std::vector<char> is_barred = barred(old, is_fixed);
  Region out;
  out.change.assign(fit.size(), Change::keep);
  for (std::size_t v = 0; v < fit.size(); ++v) {
    if (fit[v] != off_tolerance) continue;
    ++out.n_wanted;
    if (is_barred[v] != 0) ++out.n_held;
  }
  const Growth grown = grown_parts(old, fit, is_barred, options, out.share);
  for (const Index v : grown.members()) out.change[at(v)] = Change::remove;
  out.n_removed = static_cast<std::int64_t>(grown.members().size());
  if (options.moving_rings > 0) {
    out.n_moving = let_move(old, is_barred, grown.members(), options.moving_rings, out.change);
  }
  out.is_barred = std::move(is_barred);
  return out;
}

}  // namespace delos
