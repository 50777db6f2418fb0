// SPDX-License-Identifier: BSD-3-Clause
#include "remap/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "geometry/point_order.hpp"
#include "remap/box_tree.hpp"
#include "remap/clip.hpp"
#include "remap/first_seen.hpp"
#include "remap/walk.hpp"

namespace delos::remap {
namespace {

// Targets of one task, neighbours of each other: 1 ms of work, and its first walk costs little.
constexpr std::int64_t kBlock = 512;
constexpr std::int64_t kCopyGrain = 4096;  // targets whose overlaps are copied, 0.1 ms

// What is set aside beyond the overlaps that are expected.
constexpr double kSpare = 1.1;

// Corners nearer than this are the same: the last bits depend on the order of a triangle's corners.
constexpr double kSame = 1e-15;
constexpr double kOtherArea = 1e-5;
// A common area below this part of the smaller polygon is rounding.
constexpr double kSliver = 1e-13;
// Sums that miss the area by more mean that something was not found: look again, farther.
constexpr double kLookAgain = 1e-8;
// What may be missing at last: sides are straight to rounding, also after looking again.
constexpr double kLargestGap = 1e-6;

struct Found {
  Index source;
  double area;
  Vec3 middle;
};

struct Plan {
  const Tiling& source;
  const Tiling& target;
  std::vector<Index> order;          // targets along a Hilbert curve
  Array<std::uint8_t> is_unchanged;  // [n_targets] it has a twin
  Array<std::uint8_t> is_taken;      // [n_sources] it has a twin
  std::optional<BoxTree> tree;       // of sources with a border
};

Plan plan_search(Context& context, const Tiling& source, const Tiling& target) {
  Plan plan{source, target, hilbert_order(context.exec, target.centres()), {}, {}, {}};
  if (!source.is_closed()) plan.tree.emplace(context.exec, source);
  plan.is_unchanged.resize(at(target.size()));
  plan.is_taken.assign(at(source.size()), 0);
  return plan;
}

bool are_twins(const Tiling& a, std::int64_t i, const Tiling& b, std::int64_t j) {
  const auto p = a.corners(i), q = b.corners(j);
  if (p.size() != q.size()) return false;
  // Sooner known than by positions, and far from what rounding does to a twin's area.
  if (std::abs(a.area_m2()[at(i)] / b.area_m2()[at(j)] - 1.0) > kOtherArea) return false;
  const auto same = [&](std::size_t k, std::size_t l) {
    return (a.corner(p[k]) - b.corner(q[l])).cwiseAbs().maxCoeff() <= kSame;
  };
  for (std::size_t shift = 0; shift < q.size(); ++shift) {
    if (!same(0, shift)) continue;
    std::size_t k = 1;
    while (k < p.size() && same(k, (k + shift) % q.size())) ++k;
    if (k == p.size()) return true;
  }
  return false;
}

// Has what sources will need fetched, one after the other.
class Lookahead {
 public:
  /// `now`: the one that is worked on.
  void prefetch(const Tiling& tiling, std::span<const Index> ids, std::size_t now) {
    for (; placed_ < ids.size(); ++placed_) tiling.prefetch_place(ids[placed_]);
    for (; listed_ < std::min(now + 4, ids.size()); ++listed_) tiling.prefetch_lists(ids[listed_]);
    for (; named_ < std::min(now + 3, ids.size()); ++named_) tiling.prefetch_corners(ids[named_]);
  }

 private:
  std::size_t placed_ = 1, listed_ = 1, named_ = 1;  // how many have their place, lists, corners
};

// Finds all sources of one target after another.
class Search {
 public:
  explicit Search(const Plan& plan) : plan_(plan) {}

  /// `home`: the source that holds the target's centre. Relative gap between the target's area and
  /// what was found.
  double run(Index target, Index home, std::vector<Found>& found) {
    if (is_twin_of(home, target, found)) return 0.0;
    double gap = spread(target, home, false, found);
    if (gap > kLookAgain) gap = spread(target, home, true, found);
    sort_by_source(found);
    return gap;
  }

  /// The same from those that may meet the target, of which `home` is its twin, if it has one; what
  /// is too much of its area is the gap.
  double run_among(std::span<const Index> sources, Index target, Index home,
                   std::vector<Found>& found) {
    if (is_twin_of(home, target, found)) return 0.0;
    found.clear();
    if (!clipper_.begin(plan_.target, target)) return 1.0;
    double sum_m2 = 0.0;
    for (const Index source : sources) {
      const auto corners = clipper_.clip(plan_.source, source);
      if (corners.size() >= 3) sum_m2 += add(source, target, corners, found);
    }
    sort_by_source(found);
    return std::max(0.0, sum_m2 / plan_.target.area_m2()[at(target)] - 1.0);
  }

 private:
  bool is_twin_of(Index home, Index target, std::vector<Found>& found) const {
    if (!plan_.is_unchanged[at(target)]) return false;
    found = {{home, plan_.source.area_m2()[at(home)], Vec3::Zero()}};
    return true;
  }
  static void sort_by_source(std::vector<Found>& found) {
    std::sort(found.begin(), found.end(),
              [](const Found& a, const Found& b) { return a.source < b.source; });
  }
  // From the home over the sides that the intersections end at or, `everywhere`, over all sides.
  double spread(Index target, Index home, bool everywhere, std::vector<Found>& found) {
    found.clear();
    seen_.clear();
    if (!clipper_.begin(plan_.target, target)) return 1.0;
    const double area_m2 = plan_.target.area_m2()[at(target)];
    double sum_m2 = 0.0;
    seen_.place_of(home);
    Lookahead ahead;
    for (std::size_t next = 0; next < seen_.ids().size(); ++next) {
      const Index source = seen_.ids()[next];
      const auto corners = clipper_.clip(plan_.source, source);
      const auto neighbours = plan_.source.neighbours(source);
      if (everywhere && (next == 0 || corners.size() >= 3)) {
        for (const Index beside : neighbours) seen_.place_of(beside);
      }
      for (const Corner& corner : corners) {
        // A side of the target leads nowhere: without a branch, which could not be foretold.
        const Index beside = neighbours[at(std::max(corner.side, 0))];
        seen_.place_of(corner.side >= 0 ? beside : source);
      }
      ahead.prefetch(plan_.source, seen_.ids(), next);
      if (corners.size() >= 3) sum_m2 += add(source, target, corners, found);
    }
    return std::abs(sum_m2 / area_m2 - 1.0);
  }
  double add(Index source, Index target, std::span<const Corner> corners,
             std::vector<Found>& found) {
    const Ellipsoid& surface = plan_.target.surface();
    const double area =
        clipper_.with_bows(clipper_.area(surface, corners), plan_.source, source, corners);
    const double area_m2 = surface.scale_m() * surface.scale_m() * area;
    const double smaller_m2 =
        std::min(plan_.target.area_m2()[at(target)], plan_.source.area_m2()[at(source)]);
    if (!(area_m2 > kSliver * smaller_m2)) return 0.0;
    found.push_back({source, area_m2, clipper_.middle(surface, corners)});
    return area_m2;
  }

  const Plan& plan_;
  Clipper clipper_;
  FirstSeen seen_;  // in the order in which they are tried
};

struct Block {
  std::vector<Found> found;  // target by target
  double largest_gap = 0.0;
  Index worst = kNone;
};

void check_gap(const Plan& plan, const Block& block) {
  if (block.largest_gap <= kLargestGap) return;
  const LonLat place =
      plan.target.surface().lon_lat(plan.target.centres()[at(block.worst)], LatitudeKind::geodetic);
  throw Error(ErrorKind::input,
              text("the sources miss ", block.largest_gap, " of the area of target ", block.worst,
                   " at lon ", place.lon_rad * kDegPerRad, ", lat ", place.lat_rad * kDegPerRad,
                   " degrees: transfer needs closed grids of convex cells; check both grids."));
}

// Where the overlaps of each target are.
struct Pieces {
  std::vector<Block> blocks;  // along the curve
  Array<std::int64_t> first;  // [n_targets] in its block
  Array<Index> count;         // [n_targets]
  std::int64_t n_unchanged = 0;
};

// What targets along the curve will need, in three steps of which each needs the one before.
void prefetch_ahead(const Plan& plan, std::int64_t k) {
  const std::int64_t n = plan.target.size();
  if (k + 2 < n) plan.target.prefetch_corners(plan.order[at(k + 2)]);
  if (k + 4 < n) plan.target.prefetch_lists(plan.order[at(k + 4)]);
  if (k + 8 < n) plan.target.prefetch_place(plan.order[at(k + 8)]);
}

// Overlaps of a target: sources inside it, and those that its sides cross.
double n_expected(const Plan& plan) {
  const double sources = static_cast<double>(plan.source.size()) / plan.target.size();
  return kSpare * (1.0 + std::sqrt(sources)) * (1.0 + std::sqrt(sources));
}

// Where to look for a polygon at p: the source whose overlap with the last one was nearest.
Index nearest_found(const std::vector<Found>& found, const Vec3& p, Index otherwise) {
  double least = 16.0;
  for (const Found& one : found) {
    const double square = (one.middle - p).squaredNorm();
    otherwise = square < least ? one.source : otherwise;
    least = std::min(least, square);
  }
  return otherwise;
}

// Keeps the sources of one target in `found`; relative gap. `home` is where the search began and,
// in the end, where the next one is to begin.
double search_target(Plan& plan, Search& search, Index target, Index& home,
                     std::vector<Found>& found) {
  const Vec3& centre = plan.target.centres()[at(target)];
  home = walk(plan.source, centre, nearest_found(found, centre, home));
  plan.is_unchanged[at(target)] = are_twins(plan.target, target, plan.source, home);
  if (plan.is_unchanged[at(target)]) plan.is_taken[at(home)] = 1;
  return search.run(target, home, found);
}

double search_tree(Plan& plan, Search& search, Index target, std::vector<Index>& near,
                   std::vector<Found>& found) {
  plan.tree->find(box_of(plan.target, target), near);
  const auto twin = std::find_if(near.begin(), near.end(), [&](Index source) {
    return are_twins(plan.target, target, plan.source, source);
  });
  plan.is_unchanged[at(target)] = twin != near.end();
  if (twin != near.end()) plan.is_taken[at(*twin)] = 1;
  return search.run_among(near, target, twin == near.end() ? kNone : *twin, found);
}

Block search_block(Plan& plan, std::int64_t begin, std::int64_t end, Pieces& pieces) {
  const auto& centres = plan.target.centres();
  Block block;
  block.found.reserve(at(static_cast<std::int64_t>(n_expected(plan) * (end - begin))));
  Search search(plan);
  std::vector<Found> found;
  std::vector<Index> near;
  Index home = plan.tree ? kNone : start_near(plan.source, centres[at(plan.order[at(begin)])]);
  for (std::int64_t k = begin; k < end; ++k) {
    prefetch_ahead(plan, k);
    const Index target = plan.order[at(k)];
    const double gap = plan.tree ? search_tree(plan, search, target, near, found)
                                 : search_target(plan, search, target, home, found);
    if (gap > block.largest_gap) {
      block.largest_gap = gap;
      block.worst = target;
    }
    pieces.first[at(target)] = static_cast<std::int64_t>(block.found.size());
    pieces.count[at(target)] = static_cast<Index>(found.size());
    block.found.insert(block.found.end(), found.begin(), found.end());
  }
  return block;
}

Pieces find_pieces(Context& context, Plan& plan) {
  const std::int64_t n = plan.target.size();
  Pieces pieces;
  pieces.blocks.resize(at((n + kBlock - 1) / kBlock));
  pieces.first.resize(at(n));
  pieces.count.resize(at(n));
  parallel::for_range(context.exec, n, kBlock, [&](std::int64_t begin, std::int64_t end) {
    context.monitor.check_cancelled();
    pieces.blocks[at(begin / kBlock)] = search_block(plan, begin, end, pieces);
    context.monitor.advance(end - begin);
  });
  for (const std::uint8_t is_unchanged : plan.is_unchanged) pieces.n_unchanged += is_unchanged;
  return pieces;
}

// What has a twin overlaps that alone: the slivers that others have of it are rounding.
void drop_taken(parallel::Executor& exec, const Plan& plan, Pieces& pieces) {
  if (pieces.n_unchanged == 0) return;
  parallel::for_index(exec, plan.target.size(), kCopyGrain, [&](std::int64_t k) {
    const Index target = plan.order[at(k)];
    if (plan.is_unchanged[at(target)]) return;
    Found* const found = pieces.blocks[at(k / kBlock)].found.data() + pieces.first[at(target)];
    Found* const end = found + pieces.count[at(target)];
    const auto is_taken = [&](const Found& one) { return plan.is_taken[at(one.source)] != 0; };
    pieces.count[at(target)] = static_cast<Index>(std::remove_if(found, end, is_taken) - found);
  });
}

// Every target's overlaps to their place.
void collect(parallel::Executor& exec, const Plan& plan, const Pieces& pieces, Overlaps& overlaps) {
  for (const Block& block : pieces.blocks) {
    check_gap(plan, block);
    overlaps.largest_gap = std::max(overlaps.largest_gap, block.largest_gap);
  }
  const std::int64_t n = plan.target.size();
  overlaps.n_unchanged = pieces.n_unchanged;
  overlaps.offsets.resize(at(n) + 1);
  overlaps.offsets[0] = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    overlaps.offsets[at(i) + 1] = overlaps.offsets[at(i)] + pieces.count[at(i)];
    overlaps.n_unmapped += pieces.count[at(i)] == 0 ? 1 : 0;
  }
  const std::size_t n_overlaps = at(overlaps.offsets[at(n)]);
  overlaps.source.resize(n_overlaps);
  overlaps.area_m2.resize(n_overlaps);
  overlaps.middle.resize(n_overlaps);
  parallel::for_index(exec, n, kCopyGrain, [&](std::int64_t k) {
    const Index target = plan.order[at(k)];
    const Found* found = pieces.blocks[at(k / kBlock)].found.data() + pieces.first[at(target)];
    for (Index j = 0; j < pieces.count[at(target)]; ++j) {
      const std::size_t entry = at(overlaps.offsets[at(target)] + j);
      overlaps.source[entry] = found[j].source;
      overlaps.area_m2[entry] = found[j].area;
      overlaps.middle[entry] = found[j].middle;
    }
  });
}

// Makes the middles relative: sums of area times middle over a source are then 0, whatever the
// accuracy of the middles, which is what keeps the mass of the second order.
void centre_middles(parallel::Executor& exec, const ByKey& by_source, const Tiling& source_tiling,
                    Overlaps& overlaps) {
  overlaps.source_middle.resize(at(overlaps.n_sources));
  parallel::for_index(exec, overlaps.n_sources, kCopyGrain, [&](std::int64_t source) {
    const std::int64_t begin = by_source.offsets[at(source)],
                       end = by_source.offsets[at(source) + 1];
    Vec3 sum = Vec3::Zero();
    double area_m2 = 0.0;
    for (std::int64_t k = begin; k < end; ++k) {
      const std::size_t entry = at(by_source.entry[at(k)]);
      sum += overlaps.area_m2[entry] * overlaps.middle[entry];
      area_m2 += overlaps.area_m2[entry];
    }
    const Vec3 mean = begin == end ? Vec3(0, 0, 0) : Vec3(sum / area_m2);
    const bool is_part =
        overlaps.is_open && !(area_m2 >= kWhole * overlaps.source_area_m2[at(source)]);
    overlaps.source_middle[at(source)] = is_part ? source_tiling.centres()[at(source)] : mean;
    for (std::int64_t k = begin; k < end; ++k) {
      Vec3& middle = overlaps.middle[at(by_source.entry[at(k)])];
      middle = end - begin == 1 ? Vec3(0, 0, 0) : Vec3(middle - mean);
    }
  });
}

}  // namespace

double Overlaps::covered_fraction(std::int64_t i) const {
  if (!is_open) return 1.0;
  double sum_m2 = 0.0;
  for (auto k = offsets[at(i)]; k < offsets[at(i) + 1]; ++k) sum_m2 += area_m2[at(k)];
  const double area = target_area_m2[at(i)];
  return sum_m2 >= kWhole * area ? 1.0 : sum_m2 / area;
}

Overlaps intersect(Context& context, const Tiling& source, const Tiling& target) {
  DELOS_CHECK(source.surface().radii() == target.surface().radii() &&
                  source.surface().scale_m() == target.surface().scale_m(),
              ErrorKind::input, "the grids lie on different surfaces, of largest radius ",
              source.surface().scale_m(), " m and ", target.surface().scale_m(),
              " m: transfer needs one surface; generate both grids with the same radii.");
  Overlaps overlaps;
  overlaps.n_sources = source.size();
  overlaps.n_targets = target.size();
  overlaps.is_open = !(source.is_closed() && target.is_closed());
  overlaps.source_area_m2.assign(source.area_m2().begin(), source.area_m2().end());
  overlaps.target_area_m2.assign(target.area_m2().begin(), target.area_m2().end());
  {
    Plan plan = plan_search(context, source, target);
    Pieces pieces = find_pieces(context, plan);
    drop_taken(context.exec, plan, pieces);
    collect(context.exec, plan, pieces, overlaps);
  }
  const ByKey of_sources = by_source(context.exec, overlaps);
  overlaps.n_balancing = balance(context.exec, of_sources, overlaps);
  centre_middles(context.exec, of_sources, source, overlaps);
  return overlaps;
}

}  // namespace delos::remap
