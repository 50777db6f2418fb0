// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "remap/transfer.hpp"
#include "support/culled_grids.hpp"
#include "support/sample_fields.hpp"

using namespace delos;
using remap::Limiter;
using remap::Normalization;
using remap::Order;

namespace {

/// A grid and what is left of it; `left` is empty for a grid that stays whole.
struct Domain {
  Grid whole;
  domain::Culled left;
  bool is_culled;
  const Grid& grid() const { return is_culled ? left.grid : whole; }
  Index old_cell(Index cell) const { return is_culled ? left.old_cell[at(cell)] : cell; }
};

bool in_ocean(const Vec3& p) { return p.z() < 0.6 && std::abs(p.x() - 0.3) > 0.08 && p.y() < 0.9; }
bool in_other(const Vec3& p) { return p.z() < 0.5 && std::abs(p.x() - 0.3) > 0.06; }

template <class Keep>
Domain domain_of(Grid whole, bool is_culled, Keep&& keep) {
  Domain domain{std::move(whole), {}, is_culled};
  if (is_culled) domain.left = samples::culled(domain.whole, keep);
  return domain;
}

remap::Transfer transfer_between(const Grid& from, const Grid& to, int threads = 1) {
  parallel::Executor exec(threads);
  Monitor monitor;
  Context context{exec, monitor};
  return {context, remap::Tiling::cells(exec, from), remap::Tiling::cells(exec, to)};
}

/// Areas of the pairs by the ids of the whole grids, of cells that both have.
std::map<std::pair<Index, Index>, double> pairs_of(const remap::Overlaps& overlaps) {
  std::map<std::pair<Index, Index>, double> pairs;
  for (Index i = 0; i < overlaps.n_targets; ++i) {
    for (auto k = overlaps.offsets[at(i)]; k < overlaps.offsets[at(i) + 1]; ++k) {
      pairs[{i, overlaps.source[at(k)]}] = overlaps.area_m2[at(k)];
    }
  }
  return pairs;
}

struct Case {
  Domain from, to;
};

std::vector<Case> cases(const Ellipsoid& surface, int levels) {
  const auto a = [&] {
    return samples::grid_of(surface, samples::shaken(surface, levels, 0.1, 1));
  };
  const auto b = [&] { return samples::grid_of(surface, samples::shaken(surface, 3, 0.1, 2)); };
  std::vector<Case> result;
  for (const auto& [first, second] : {std::pair(true, true), {true, false}, {false, true}}) {
    result.push_back({domain_of(a(), first, in_ocean), domain_of(b(), second, in_other)});
  }
  return result;
}

double used_mass(const remap::Overlaps& overlaps, std::span<const double> field) {
  long double sum = 0.0L;
  for (std::size_t k = 0; k < overlaps.source.size(); ++k) {
    sum += static_cast<long double>(overlaps.area_m2[k]) *
           static_cast<long double>(field[at(overlaps.source[k])]);
  }
  return static_cast<double>(sum);
}

}  // namespace

TEST_CASE("culled grids overlap where the whole ones do, over both sides of every gap") {
  for (const Ellipsoid& surface : {Ellipsoid::sphere(6371220.0), Ellipsoid::wgs84()}) {
    for (const int levels : {2, 4}) {
      for (const Case& one : cases(surface, levels)) {
        CAPTURE(levels);
        const auto transfer = transfer_between(one.from.grid(), one.to.grid());
        const auto whole = transfer_between(one.from.whole, one.to.whole);
        const auto left = pairs_of(transfer.overlaps());
        const auto all = pairs_of(whole.overlaps());
        std::vector<Index> new_source(one.from.whole.cell_position.size(), kNone);
        std::vector<Index> new_target(one.to.whole.cell_position.size(), kNone);
        for (Index j = 0; j < one.from.grid().n_cells(); ++j) {
          new_source[at(one.from.old_cell(j))] = j;
        }
        for (Index i = 0; i < one.to.grid().n_cells(); ++i) new_target[at(one.to.old_cell(i))] = i;
        std::size_t n = 0;
        double worst = 0.0;
        for (const auto& [pair, area_m2] : all) {
          const Index i = new_target[at(pair.first)], j = new_source[at(pair.second)];
          if (i == kNone || j == kNone) continue;
          const auto found = left.find({i, j});
          const double smaller =
              std::min(one.to.grid().cell_area_m2[at(i)], one.from.grid().cell_area_m2[at(j)]);
          const double mine = found == left.end() ? 0.0 : found->second;
          n += found == left.end() ? 0 : 1;
          worst = std::max(worst, std::abs(mine - area_m2) / smaller);
        }
        CHECK(n == left.size());
        CHECK(worst < 1e-11);
      }
    }
  }
}

TEST_CASE("between culled grids constants and the covered mass are kept, what is bare gets NaN") {
  parallel::Executor exec(2);
  for (const Case& one : cases(Ellipsoid::wgs84(), 4)) {
    const auto transfer = transfer_between(one.from.grid(), one.to.grid());
    const remap::Overlaps& overlaps = transfer.overlaps();
    CHECK(overlaps.is_open);
    CHECK((overlaps.n_unmapped > 0) == one.from.is_culled);
    const auto field = samples::rough_field(overlaps.n_sources, 3);
    const std::vector<double> constant(field.size(), 0.1);
    std::vector<double> result(at(overlaps.n_targets)), same(result.size());
    for (const Order order : {Order::first, Order::second}) {
      for (const Limiter limiter : {Limiter::none, Limiter::gradient}) {
        transfer.apply(exec, constant, same, {order, limiter});
        for (const Normalization part : {Normalization::covered, Normalization::whole}) {
          transfer.apply(exec, field, result, {order, limiter, 1, part});
          long double mass = 0.0L;
          std::int64_t n_bare = 0;
          for (std::int64_t i = 0; i < overlaps.n_targets; ++i) {
            const bool is_bare = overlaps.offsets[at(i)] == overlaps.offsets[at(i) + 1];
            n_bare += is_bare ? 1 : 0;
            CHECK(std::isnan(result[at(i)]) == is_bare);
            if (is_bare) continue;
            CHECK(same[at(i)] == 0.1);
            const double fraction =
                part == Normalization::covered ? overlaps.covered_fraction(i) : 1.0;
            mass += static_cast<long double>(result[at(i)] * fraction) *
                    static_cast<long double>(overlaps.target_area_m2[at(i)]);
          }
          CHECK(n_bare == overlaps.n_unmapped);
          CHECK(std::abs(static_cast<double>(mass) / used_mass(overlaps, field) - 1.0) < 1e-14);
        }
      }
    }
  }
}

TEST_CASE(
    "of culled grids sources that are covered keep their area, matrices do what transfers do") {
  parallel::Executor exec(1);
  for (const Case& one : cases(Ellipsoid::sphere(6371220.0), 4)) {
    const auto transfer = transfer_between(one.from.grid(), one.to.grid());
    const remap::Overlaps& overlaps = transfer.overlaps();
    std::vector<double> used(at(overlaps.n_sources), 0.0);
    for (std::size_t k = 0; k < overlaps.source.size(); ++k) {
      used[at(overlaps.source[k])] += overlaps.area_m2[k];
    }
    std::size_t n_whole = 0;
    for (std::size_t j = 0; j < used.size(); ++j) {
      const double part = used[j] / overlaps.source_area_m2[j];
      CHECK(part < 1.0 + 1e-14);
      if (part < remap::kWhole) continue;
      ++n_whole;
      CHECK(part > 1.0 - 1e-14);
    }
    CHECK(n_whole > used.size() / 2);
    const auto field = samples::rough_field(overlaps.n_sources, 3);
    std::vector<double> direct(at(overlaps.n_targets)), product(direct.size());
    for (const Normalization part : {Normalization::covered, Normalization::whole}) {
      transfer.apply(exec, field, direct, {Order::second, Limiter::none, 1, part});
      remap::apply(exec, transfer.weights(exec, Order::second, part), field, product);
      for (std::size_t i = 0; i < direct.size(); ++i) {
        if (!std::isnan(direct[i])) {
          CHECK(product[i] == doctest::Approx(direct[i]).epsilon(1e-12));
        }
      }
    }
  }
}

TEST_CASE("two parts of one grid share their cells to the bit, and threads change nothing") {
  const Ellipsoid surface = Ellipsoid::wgs84();
  const Grid grid = samples::grid_of(surface, samples::shaken(surface, 4, 0.1, 1));
  const Domain from = domain_of(grid, true, in_ocean), to = domain_of(grid, true, in_other);
  const auto transfer = transfer_between(from.grid(), to.grid());
  const auto field = samples::rough_field(from.grid().n_cells(), 3);
  std::vector<double> before(grid.cell_position.size(), std::nan("")),
      result(at(to.grid().n_cells()));
  for (std::size_t j = 0; j < field.size(); ++j) before[at(from.left.old_cell[j])] = field[j];
  parallel::Executor exec(1);
  transfer.apply(exec, field, result);
  std::int64_t n_shared = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double old = before[at(to.left.old_cell[i])];
    if (std::isnan(old)) continue;
    ++n_shared;
    CHECK(result[i] == old);
  }
  CHECK(n_shared == transfer.overlaps().n_unchanged);
  CHECK(n_shared > to.grid().n_cells() / 2);
  for (const int threads : {2, 5}) {
    const auto many = transfer_between(from.grid(), to.grid(), threads);
    CHECK(many.overlaps().source == transfer.overlaps().source);
    CHECK(many.overlaps().area_m2 == transfer.overlaps().area_m2);
    CHECK(many.overlaps().middle == transfer.overlaps().middle);
  }
}
