// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/budget.hpp"

#include <algorithm>
#include <cmath>

#include "adapt/cell_raster.hpp"
#include "sizing/nodes.hpp"

namespace delos {
namespace {

/// Vertices a task; part of the answer of the sums.
constexpr std::int64_t kSumGrain = 8192;
/// Halvings of the bracket of a factor: more than doubles tell apart.
constexpr int kHalvings = 60;

template <class I>
std::size_t at_index(I i) {
  return static_cast<std::size_t>(i);
}

// What the cells have, in the surroundings of each node of a table.
LatLonField on_nodes(parallel::Executor& exec, const Grid& grid, const Array<double>& values,
                     LatLonField table) {
  sample(exec, raster_of_cells(exec, grid, values, cell_resolution_rad(grid), "the region"), table);
  return table;
}

}  // namespace

SpacingField followed_spacing(parallel::Executor& exec, const Grid& grid, const Region& region,
                              const SpacingField& before, const SpacingField& wanted) {
  LatLonField table_m = wanted.to_table();
  const LatLonField share =
      on_nodes(exec, grid, {region.share.begin(), region.share.end()}, table_m);
  const double scale_m = grid.surface.scale_m();
  const NodeDirections nodes(table_m);
  for_rows(exec, table_m, [&](Index row, double* values) {
    std::vector<Vertex> places;
    for (Index i = 0; i < table_m.n_lon; ++i) {
      const Vec3 p = grid.surface.point(nodes.lon[at(i)], nodes.lat[at(row)], wanted.latitude());
      places.push_back({p.x(), p.y(), p.z(), 0.0});
    }
    before.evaluate(places);
    for (Index i = 0; i < table_m.n_lon; ++i) {
      const double part = share.values[share.at(row, i)];
      if (part >= 1.0) continue;  // to the last bit
      const double before_m = places[at(i)].spacing * scale_m;
      values[i] = before_m + part * (values[i] - before_m);
    }
  });
  return SpacingField::table(exec, grid.surface, wanted.latitude(), table_m);
}

LatLonField share_made_anew(parallel::Executor& exec, const Grid& grid, const Region& region,
                            const SpacingField& spacing) {
  Array<double> is_anew(region.change.size());
  for (std::size_t v = 0; v < is_anew.size(); ++v) {
    is_anew[v] = region.change[v] == Change::remove ? 1.0 : 0.0;
  }
  return on_nodes(exec, grid, is_anew, spacing.to_table());
}

SpacingField scaled_where_anew(parallel::Executor& exec, const Ellipsoid& surface,
                               const SpacingField& spacing, const LatLonField& share,
                               double factor) {
  LatLonField table_m = spacing.to_table();
  for_rows(exec, table_m, [&](Index row, double* values) {
    for (Index i = 0; i < table_m.n_lon; ++i) {
      values[i] *= 1.0 + (factor - 1.0) * share.values[share.at(row, i)];
    }
  });
  return SpacingField::table(exec, surface, spacing.latitude(), table_m);
}

CountForecast::CountForecast(parallel::Executor& exec, const RemeshInput& input,
                             const RemeshPlan& plan)
    : exec_(exec) {
  const Array<Vertex>& vertices = input.mesh.vertices;
  const bool is_full = plan.kind == RemeshKind::full;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const bool goes =
        is_full || (plan.kind == RemeshKind::local && plan.region.change[v] == Change::remove);
    if (goes) places_.push_back(vertices[v]);
  }
  n_kept_ = static_cast<double>(vertices.size() - places_.size());
  room_.resize(places_.size());
  for (std::size_t i = 0; i < places_.size(); ++i) room_[i] = places_[i].spacing;
  input.spacing.evaluate(exec, places_);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const double ratio = room_[i] / places_[i].spacing;
    room_[i] = ratio * ratio;
  }
}

void CountForecast::restrict_to(const Ellipsoid& surface, const SpacingField& spacing,
                                const LatLonField& share) {
  // A factor of 2 tells how much of it comes to a place.
  const SpacingField doubled = scaled_where_anew(exec_, surface, spacing, share, 2.0);
  Array<Vertex> there = places_;
  doubled.evaluate(exec_, there);
  share_.resize(there.size());
  for (std::size_t i = 0; i < there.size(); ++i) {
    share_[i] = std::clamp(there[i].spacing / places_[i].spacing - 1.0, 0.0, 1.0);
  }
}

double CountForecast::at(double factor) const {
  return n_kept_ + parallel::sum(exec_, static_cast<std::int64_t>(room_.size()), kSumGrain,
                                 [&](std::int64_t i) {
                                   const double share = share_.empty() ? 1.0 : share_[at_index(i)];
                                   const double scale = 1.0 + (factor - 1.0) * share;
                                   return room_[at_index(i)] / (scale * scale);
                                 });
}

std::optional<double> CountForecast::factor_for(double count, double most) const {
  double fine = 1.0 / most, coarse = most;
  if (!(at(fine) >= count && at(coarse) <= count)) return std::nullopt;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (fine + coarse);
    (at(middle) > count ? fine : coarse) = middle;
  }
  return 0.5 * (fine + coarse);
}

}  // namespace delos
