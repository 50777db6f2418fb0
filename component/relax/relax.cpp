// SPDX-License-Identifier: BSD-3-Clause
#include "relax/relax.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "relax/centroidal.hpp"
#include "relax/moves.hpp"
#include "relax/polish.hpp"
#include "relax/springs.hpp"
#include "triangulation/flip.hpp"

namespace delos {
namespace {

// Flips are looked for after the rounds in which they happen: the first ones, then ever rarer.
bool is_flip_round(int round, int last) { return round == 0 || round == 3 || round == last; }

// What polish mends of a centroidal grid: triangles near a right angle, whose area-length is 0.866
// at best. Twice the error of steady flow is what 0.94 would cost (see the README).
constexpr double kCentroidalQuality = 0.88;

void check_options(const RelaxOptions& options) {
  DELOS_CHECK(options.spring_rounds >= 0 && options.spring_rounds <= 100000, ErrorKind::config,
              "relax.spring_rounds = ", options.spring_rounds, ": must be in 0..100000.");
  DELOS_CHECK(options.centroidal_rounds >= 0 && options.centroidal_rounds <= 100000,
              ErrorKind::config, "relax.centroidal_rounds = ", options.centroidal_rounds,
              ": must be in 0..100000.");
  DELOS_CHECK(options.polish_rounds >= 0 && options.polish_rounds <= 100000, ErrorKind::config,
              "relax.polish_rounds = ", options.polish_rounds, ": must be in 0..100000.");
  DELOS_CHECK(options.target_quality > 0.0 && options.target_quality < 1.0, ErrorKind::config,
              "relax.target_quality = ", options.target_quality,
              ": must be above 0 and below 1 (0.94 is the default).");
}

constexpr std::int64_t kPartGrain = 16384;  // items a task: some ten microseconds

bool has_free_corner(const Triangle& t, const std::vector<char>& is_free) {
  return is_free[static_cast<std::size_t>(t.vertex[0])] != 0 ||
         is_free[static_cast<std::size_t>(t.vertex[1])] != 0 ||
         is_free[static_cast<std::size_t>(t.vertex[2])] != 0;
}

// Flips may give a triangle its first free corner, and take a vertex from another.
void update_part(const Mesh& mesh, const std::vector<Index>& flipped, RelaxPart& part) {
  std::vector<Index> all = flipped;
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  for (const Index tri : all) {
    for (const Index v : mesh.triangle(tri).vertex)
      part.at_vertex[static_cast<std::size_t>(v)] = tri;
  }
  std::vector<Index> merged;
  std::set_union(part.triangles.begin(), part.triangles.end(), all.begin(), all.end(),
                 std::back_inserter(merged));
  std::erase_if(merged,
                [&](Index tri) { return !has_free_corner(mesh.triangle(tri), part.is_free); });
  part.triangles = std::move(merged);
}

// What the rounds move: a whole mesh, or a part of it.
struct Moved {
  const Target& target;
  Mesh& mesh;
  RelaxPart* part;

  Moving begin(Context& context) const {
    if (part == nullptr) return {NeighbourRows(context.exec, mesh)};
    std::vector<Index> vertices;
    for (std::size_t v = 0; v < part->is_free.size(); ++v) {
      if (part->is_free[v] != 0) vertices.push_back(static_cast<Index>(v));
    }
    return {{context.exec, mesh, part->at_vertex, std::move(vertices)}, &part->triangles};
  }

  /// Returns the number of flips.
  std::int64_t restore_delaunay(Context& context, Moving& moving) const {
    std::vector<Index> flipped;
    const std::int64_t n_flips =
        part == nullptr ? restore_delaunay_everywhere(context.exec, mesh, target.surface, &flipped)
                        : restore_delaunay_around(context.exec, mesh, target.surface,
                                                  part->triangles, &flipped);
    moving.rows.update(mesh, flipped);
    if (part != nullptr) update_part(mesh, flipped, *part);
    return n_flips;
  }
};

void relax_springs(Context& context, const Moved& moved, int n_rounds, RelaxReport& report) {
  Moving moving = moved.begin(context);
  const Phase phase(context.monitor, "relax", n_rounds * moving.rows.size());
  for (int round = 0; round < n_rounds; ++round) {
    context.monitor.check_cancelled();
    spring_round(context.exec, moved.target, moving, moved.mesh);
    ++report.spring_rounds;
    if (is_flip_round(round, n_rounds - 1)) {
      report.n_flips += moved.restore_delaunay(context, moving);
    }
    context.monitor.advance(moving.rows.size());
  }
}

void relax_centroidal(Context& context, const Moved& moved, int n_rounds, RelaxReport& report) {
  Moving moving = moved.begin(context);
  const Phase phase(context.monitor, "centroidal", n_rounds * moving.rows.size());
  const double momentum = centroidal_momentum(n_rounds);
  for (int round = 0; round < n_rounds; ++round) {
    context.monitor.check_cancelled();
    centroidal_round(context.exec, moved.target, momentum, moving, moved.mesh);
    ++report.centroidal_rounds;
    report.n_flips += moved.restore_delaunay(context, moving);
    context.monitor.advance(moving.rows.size());
  }
}

void add(const PolishReport& polished, RelaxReport& report) {
  report.polish_rounds = polished.rounds;
  report.n_flips += polished.n_flips;
  report.n_removed = polished.n_removed;
  report.n_inserted = polished.n_inserted;
  report.n_below_target = polished.n_below_target;
}

RelaxReport relax_moved(Context& context, const Moved& moved, RelaxOptions options) {
  check_options(options);
  RelaxReport report;
  if (options.spring_rounds > 0) relax_springs(context, moved, options.spring_rounds, report);
  if (options.centroidal_rounds > 0) {
    relax_centroidal(context, moved, options.centroidal_rounds, report);
    options.target_quality = std::min(options.target_quality, kCentroidalQuality);
  }
  if (options.polish_rounds > 0) {
    add(polish(context, moved.target, options, moved.mesh, moved.part), report);
  }
  return report;
}

}  // namespace

RelaxReport relax(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
                  const RelaxOptions& options, Mesh& mesh) {
  return relax_moved(context, {{surface, spacing}, mesh, nullptr}, options);
}

std::vector<Index> triangles_of_free(parallel::Executor& exec, const Mesh& mesh,
                                     const std::vector<char>& is_free) {
  return parallel::collect<Index>(
      exec, mesh.n_triangles(), kPartGrain,
      [&](std::int64_t begin, std::int64_t end, std::vector<Index>& found) {
        for (auto tri = static_cast<Index>(begin); tri < end; ++tri) {
          if (has_free_corner(mesh.triangle(tri), is_free)) found.push_back(tri);
        }
      });
}

RelaxReport relax_part(Context& context, const Target& target, const RelaxOptions& options,
                       RelaxPart& part, Mesh& mesh) {
  return relax_moved(context, {target, mesh, &part}, options);
}

}  // namespace delos
