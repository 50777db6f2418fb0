// SPDX-License-Identifier: BSD-3-Clause
#include "relax/repair.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "relax/hill_climb.hpp"

namespace delos {
namespace {

constexpr double kLeastGain = 2e-4;  // of the worst score, for a mended patch to be taken
constexpr int kSpringSweeps = 12;    // after a topological change: the patch finds a new balance
constexpr int kSmoothSweeps = 3;     // spread what climbing has pushed together
constexpr double kMargin = 1e-3;     // climbed past the target, so that rounding does not undo it
constexpr int kClimbRounds = 3;      // hill climbing and flips in turn

class Repairer {
 public:
  Repairer(const Target& target, const RepairOptions& options)
      : target_(target), options_(options) {}

  // Springs, flips, hill climbing; returns the worst score.
  double settle(Patch& patch, int spring_sweeps) const {
    if (spring_sweeps > 0) {
      relax_patch(target_, {spring_sweeps, 0.0}, patch);
      patch::restore_delaunay(patch);
    }
    for (int round = 0; round < kClimbRounds; ++round) {
      hill_climb(target_, {options_.enough + kMargin, 12}, patch);
      if (patch::restore_delaunay(patch) == 0) break;
    }
    relax_patch(target_, {kSmoothSweeps, options_.enough}, patch);
    patch::restore_delaunay(patch);
    return patch.worst().first;
  }

  // Keeps `trial` in `best` when it is better; true once the target is met.
  bool consider(Patch trial, std::pair<double, Patch>& best) const {
    patch::restore_delaunay(trial);
    const double score = settle(trial, kSpringSweeps);
    if (score > best.first + kLeastGain) best = {score, std::move(trial)};
    return best.first >= options_.enough;
  }

  // One vertex less or more at the worst triangle, whichever leaves the best patch.
  void try_topology(const Patch& patch, std::pair<double, Patch>& best) const {
    const Triangle worst = patch.triangle(patch.worst().second);
    for (const Index v : worst.vertex) {
      Patch trial = patch;
      if (v < patch.n_free && patch::remove_vertex(trial, v) && consider(std::move(trial), best)) {
        return;
      }
    }
    const Index tri = patch.worst().second;
    const std::array<Vec3, 3> p = {patch.vertex(worst.vertex[0]).position(),
                                   patch.vertex(worst.vertex[1]).position(),
                                   patch.vertex(worst.vertex[2]).position()};
    for (const Vec3& place : {Vec3(p[0] + p[1] + p[2]), Vec3(4.0 * (p[0] + p[1]) + p[2]),
                              Vec3(4.0 * (p[1] + p[2]) + p[0]), Vec3(4.0 * (p[2] + p[0]) + p[1])}) {
      const Vec3 q = target_.surface.project(place);
      Patch trial = patch;
      patch::insert_vertex(trial, tri,
                           {q.x(), q.y(), q.z(), target_.spacing.at(q.x(), q.y(), q.z())});
      if (consider(std::move(trial), best)) return;
    }
  }

 private:
  const Target& target_;
  const RepairOptions& options_;
};

}  // namespace

bool repair_patch(const Target& target, const RepairOptions& options, Patch& patch) {
  const Repairer repairer(target, options);
  const double before = patch.worst().first;
  std::pair<double, Patch> best{before, {}};  // without a patch until there is a better one
  Patch moved = patch;
  const double score = repairer.settle(moved, 0);
  if (score > before + kLeastGain) best = {score, std::move(moved)};
  if (best.first < options.enough && options.change_topology) repairer.try_topology(patch, best);
  if (best.first <= before + kLeastGain) return false;
  patch = std::move(best.second);
  return true;
}

}  // namespace delos
