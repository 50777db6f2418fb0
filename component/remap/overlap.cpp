// SPDX-License-Identifier: BSD-3-Clause
#include "remap/overlap.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/point_order.hpp"
#include "remap/clip.hpp"
#include "remap/walk.hpp"

namespace delos::remap {
namespace {

// Targets of one task, neighbours of each other: 1 ms of work, and its first walk costs little.
constexpr std::int64_t kBlock = 512;
constexpr std::int64_t kCopyGrain = 4096;  // targets whose overlaps are copied, 0.1 ms

constexpr std::size_t kExpected = 6;  // overlaps a target between grids of like spacing, or less

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
  Array<Index> home;                 // [n_targets] the source that holds the target's centre
  Array<std::uint8_t> is_unchanged;  // [n_targets] its home is its twin
  Array<std::uint8_t> is_taken;      // [n_sources] it has a twin
};

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

void find_homes(Context& context, Plan& plan) {
  plan.order = hilbert_order(context.exec, plan.target.centres());
  plan.home.resize(at(plan.target.size()));
  plan.is_unchanged.resize(at(plan.target.size()));
  plan.is_taken.assign(at(plan.source.size()), 0);
  parallel::for_range(context.exec, plan.target.size(), kBlock,
                      [&](std::int64_t begin, std::int64_t end) {
                        const auto& centres = plan.target.centres();
                        Index here = start_near(plan.source, centres[at(plan.order[at(begin)])]);
                        for (std::int64_t k = begin; k < end; ++k) {
                          const Index i = plan.order[at(k)];
                          here = walk(plan.source, centres[at(i)], here);
                          plan.home[at(i)] = here;
                          plan.is_unchanged[at(i)] = are_twins(plan.target, i, plan.source, here);
                          if (plan.is_unchanged[at(i)]) plan.is_taken[at(here)] = 1;
                        }
                      });
}

// The sources seen around one target: a small table, found by hashing.
class Seen {
 public:
  void clear() {
    std::fill(slots_.begin(), slots_.end(), kNone);
    n_ = 0;
  }
  /// True the first time.
  bool add(Index id) {
    if (2 * (n_ + 1) > slots_.size()) grow();
    return put(id);
  }

 private:
  bool put(Index id) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = (static_cast<std::uint32_t>(id) * 2654435769U >> 7) & mask;
    while (slots_[slot] != kNone) {
      if (slots_[slot] == id) return false;
      slot = (slot + 1) & mask;
    }
    slots_[slot] = id;
    ++n_;
    return true;
  }
  void grow() {
    const std::vector<Index> old =
        std::exchange(slots_, std::vector<Index>(2 * slots_.size(), kNone));
    n_ = 0;
    for (const Index id : old) {
      if (id != kNone) put(id);
    }
  }
  std::vector<Index> slots_ = std::vector<Index>(64, kNone);
  std::size_t n_ = 0;
};

// Finds all sources of one target after another.
class Search {
 public:
  explicit Search(const Plan& plan) : plan_(plan) {}

  /// Relative gap between the target's area and what was found.
  double run(Index target, std::vector<Found>& found) {
    if (plan_.is_unchanged[at(target)]) {
      found = {{plan_.home[at(target)], plan_.source.area_m2()[at(plan_.home[at(target)])],
                Vec3::Zero()}};
      return 0.0;
    }
    double gap = spread(target, false, found);
    if (gap > kLookAgain) gap = spread(target, true, found);
    std::sort(found.begin(), found.end(),
              [](const Found& a, const Found& b) { return a.source < b.source; });
    return gap;
  }

 private:
  // From the home over the sides that the intersections end at or, `everywhere`, over all sides.
  double spread(Index target, bool everywhere, std::vector<Found>& found) {
    found.clear();
    seen_.clear();
    if (!clipper_.begin(plan_.target, target)) return 1.0;
    const double area_m2 = plan_.target.area_m2()[at(target)];
    double sum_m2 = 0.0;
    queue_ = {plan_.home[at(target)]};
    seen_.add(queue_[0]);
    for (std::size_t next = 0; next < queue_.size(); ++next) {
      const Index source = queue_[next];
      const auto corners = clipper_.clip(plan_.source, source);
      const auto neighbours = plan_.source.neighbours(source);
      if (everywhere && (next == 0 || corners.size() >= 3)) {
        for (const Index beside : neighbours) enqueue(beside);
      }
      for (const Corner& corner : corners) {
        if (corner.side >= 0) enqueue(neighbours[at(corner.side)]);
      }
      if (corners.size() >= 3 && !plan_.is_taken[at(source)]) {
        sum_m2 += add(source, target, corners, found);
      }
    }
    return std::abs(sum_m2 / area_m2 - 1.0);
  }
  void enqueue(Index source) {
    if (seen_.add(source)) queue_.push_back(source);
  }
  double add(Index source, Index target, std::span<const Corner> corners,
             std::vector<Found>& found) {
    const Ellipsoid& surface = plan_.target.surface();
    double area = clipper_.area(surface, corners);
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const Index side = corners[k].side;
      const double bow =
          side < 0 ? plan_.target.bow(target, at(~side)) : plan_.source.bow(source, at(side));
      if (bow != 0.0) area += bow * clipper_.part_of_side(corners, k);
    }
    const double area_m2 = surface.scale_m() * surface.scale_m() * area;
    const double smaller_m2 =
        std::min(plan_.target.area_m2()[at(target)], plan_.source.area_m2()[at(source)]);
    if (!(area_m2 > kSliver * smaller_m2)) return 0.0;
    found.push_back({source, area_m2, clipper_.middle(surface, corners)});
    return area_m2;
  }

  const Plan& plan_;
  Clipper clipper_;
  Seen seen_;
  std::vector<Index> queue_;
};

struct Block {
  std::vector<Found> found;
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

// Blocks first, in the order of the curve; then every target's overlaps to their place.
void collect(Context& context, const Plan& plan, Overlaps& overlaps) {
  const std::int64_t n = plan.target.size();
  std::vector<Block> blocks(at((n + kBlock - 1) / kBlock));
  Array<std::int64_t> first(at(n));
  Array<Index> count(at(n));
  parallel::for_range(context.exec, n, kBlock, [&](std::int64_t begin, std::int64_t end) {
    context.monitor.check_cancelled();
    Block& block = blocks[at(begin / kBlock)];
    Search search(plan);
    block.found.reserve(kExpected * at(end - begin));
    std::vector<Found> found;
    for (std::int64_t k = begin; k < end; ++k) {
      const Index target = plan.order[at(k)];
      const double gap = search.run(target, found);
      if (gap > block.largest_gap) {
        block.largest_gap = gap;
        block.worst = target;
      }
      first[at(target)] = static_cast<std::int64_t>(block.found.size());
      count[at(target)] = static_cast<Index>(found.size());
      block.found.insert(block.found.end(), found.begin(), found.end());
    }
    context.monitor.advance(end - begin);
  });
  for (const Block& block : blocks) {
    check_gap(plan, block);
    overlaps.largest_gap = std::max(overlaps.largest_gap, block.largest_gap);
  }
  overlaps.offsets.resize(at(n) + 1);
  overlaps.offsets[0] = 0;
  for (std::int64_t i = 0; i < n; ++i) {
    overlaps.offsets[at(i) + 1] = overlaps.offsets[at(i)] + count[at(i)];
    overlaps.n_unchanged += plan.is_unchanged[at(i)];
  }
  const std::size_t n_overlaps = at(overlaps.offsets[at(n)]);
  overlaps.source.resize(n_overlaps);
  overlaps.area_m2.resize(n_overlaps);
  overlaps.middle.resize(n_overlaps);
  parallel::for_index(context.exec, n, kCopyGrain, [&](std::int64_t k) {
    const Index target = plan.order[at(k)];
    const Found* found = blocks[at(k / kBlock)].found.data() + first[at(target)];
    for (Index j = 0; j < count[at(target)]; ++j) {
      const std::size_t entry = at(overlaps.offsets[at(target)] + j);
      overlaps.source[entry] = found[j].source;
      overlaps.area_m2[entry] = found[j].area;
      overlaps.middle[entry] = found[j].middle;
    }
  });
}

// Makes the middles relative: sums of area times middle over a source are then 0, whatever the
// accuracy of the middles, which is what keeps the mass of the second order.
void centre_middles(parallel::Executor& exec, const ByKey& by_source, Overlaps& overlaps) {
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
    overlaps.source_middle[at(source)] = sum / area_m2;
    for (std::int64_t k = begin; k < end; ++k) {
      Vec3& middle = overlaps.middle[at(by_source.entry[at(k)])];
      middle = end - begin == 1 ? Vec3(0, 0, 0) : Vec3(middle - overlaps.source_middle[at(source)]);
    }
  });
}

}  // namespace

Overlaps intersect(Context& context, const Tiling& source, const Tiling& target) {
  DELOS_CHECK(source.surface().radii() == target.surface().radii() &&
                  source.surface().scale_m() == target.surface().scale_m(),
              ErrorKind::input, "the grids lie on different surfaces, of largest radius ",
              source.surface().scale_m(), " m and ", target.surface().scale_m(),
              " m: transfer needs one surface; generate both grids with the same radii.");
  Plan plan{source, target, {}, {}, {}, {}};
  find_homes(context, plan);
  Overlaps overlaps;
  overlaps.n_sources = source.size();
  overlaps.n_targets = target.size();
  overlaps.source_area_m2.assign(source.area_m2().begin(), source.area_m2().end());
  overlaps.target_area_m2.assign(target.area_m2().begin(), target.area_m2().end());
  collect(context, plan, overlaps);
  const ByKey of_sources = by_source(context.exec, overlaps);
  overlaps.n_balancing = balance(context.exec, of_sources, overlaps);
  centre_middles(context.exec, of_sources, overlaps);
  return overlaps;
}

}  // namespace delos::remap
