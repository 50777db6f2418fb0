// SPDX-License-Identifier: BSD-3-Clause
#include "relax/relax.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "relax/neighbours.hpp"
#include "relax/polish.hpp"
#include "relax/springs.hpp"
#include "triangulation/flip.hpp"

namespace delos {
namespace {

// Flips are looked for after the rounds in which they happen: the first ones, then ever rarer.
bool is_flip_round(int round, int last) { return round == 0 || round == 3 || round == last; }

void check_options(const RelaxOptions& options) {
  DELOS_CHECK(options.spring_rounds >= 0 && options.spring_rounds <= 100000, ErrorKind::config,
              "relax.spring_rounds = ", options.spring_rounds, ": must be in 0..100000.");
  DELOS_CHECK(options.polish_rounds >= 0 && options.polish_rounds <= 100000, ErrorKind::config,
              "relax.polish_rounds = ", options.polish_rounds, ": must be in 0..100000.");
  DELOS_CHECK(options.target_quality > 0.0 && options.target_quality < 1.0, ErrorKind::config,
              "relax.target_quality = ", options.target_quality,
              ": must be above 0 and below 1 (0.94 is the default).");
}

void relax_springs(Context& context, const Target& target, const RelaxOptions& options, Mesh& mesh,
                   RelaxReport& report) {
  const Phase phase(context.monitor, "relax",
                    static_cast<std::int64_t>(options.spring_rounds) * mesh.n_vertices());
  Array<Vertex> other;
  NeighbourRows rows(context.exec, mesh);
  for (int round = 0; round < options.spring_rounds; ++round) {
    context.monitor.check_cancelled();
    spring_round(context.exec, target, rows, mesh, other);
    std::swap(mesh.vertices, other);
    ++report.spring_rounds;
    if (is_flip_round(round, options.spring_rounds - 1)) {
      std::vector<Index> flipped;
      report.n_flips += restore_delaunay_everywhere(context.exec, mesh, target.surface, &flipped);
      rows.update(mesh, flipped);
    }
    context.monitor.advance(mesh.n_vertices());
  }
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

RelaxReport relax_springs(Context& context, const Target& target, const RelaxOptions& options,
                          RelaxPart& part, Mesh& mesh) {
  RelaxReport report;
  std::vector<Index> vertices;
  for (std::size_t v = 0; v < part.is_free.size(); ++v) {
    if (part.is_free[v] != 0) vertices.push_back(static_cast<Index>(v));
  }
  const auto n = static_cast<std::int64_t>(vertices.size());
  const Phase phase(context.monitor, "relax", options.spring_rounds * n);
  SpringPart springs{{context.exec, mesh, part.at_vertex, std::move(vertices)}, part.triangles};
  Array<Vertex> other;
  for (int round = 0; round < options.spring_rounds; ++round) {
    context.monitor.check_cancelled();
    spring_round(context.exec, target, springs, mesh, other);
    ++report.spring_rounds;
    if (is_flip_round(round, options.spring_rounds - 1)) {
      std::vector<Index> flipped;
      report.n_flips +=
          restore_delaunay_around(context.exec, mesh, target.surface, springs.triangles, &flipped);
      springs.rows.update(mesh, flipped);
      update_part(mesh, flipped, part);
      springs.triangles = part.triangles;
    }
    context.monitor.advance(n);
  }
  return report;
}

void add(const PolishReport& polished, RelaxReport& report) {
  report.polish_rounds = polished.rounds;
  report.n_flips += polished.n_flips;
  report.n_removed = polished.n_removed;
  report.n_inserted = polished.n_inserted;
  report.n_below_target = polished.n_below_target;
}

}  // namespace

RelaxReport relax(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
                  const RelaxOptions& options, Mesh& mesh) {
  check_options(options);
  RelaxReport report;
  const Target target{surface, spacing};
  if (options.spring_rounds > 0) relax_springs(context, target, options, mesh, report);
  if (options.polish_rounds > 0) {
    add(polish(context, target, options, mesh), report);
  }
  return report;
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
  check_options(options);
  RelaxReport report;
  if (options.spring_rounds > 0) report = relax_springs(context, target, options, part, mesh);
  if (options.polish_rounds > 0) add(polish(context, target, options, mesh, &part), report);
  return report;
}

}  // namespace delos
