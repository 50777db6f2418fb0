// SPDX-License-Identifier: BSD-3-Clause
#include "relax/relax.hpp"

#include <algorithm>
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

}  // namespace

RelaxReport relax(Context& context, const Ellipsoid& surface, const SpacingField& spacing,
                  const RelaxOptions& options, Mesh& mesh) {
  check_options(options);
  RelaxReport report;
  const Target target{surface, spacing};
  if (options.spring_rounds > 0) relax_springs(context, target, options, mesh, report);
  if (options.polish_rounds > 0) {
    const PolishReport polished = polish(context, target, options, mesh);
    report.polish_rounds = polished.rounds;
    report.n_flips += polished.n_flips;
    report.n_removed = polished.n_removed;
    report.n_inserted = polished.n_inserted;
    report.n_below_target = polished.n_below_target;
  }
  return report;
}

}  // namespace delos
