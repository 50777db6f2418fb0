// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/solution.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "adapt/cell_raster.hpp"
#include "adapt/velocity.hpp"
#include "core/error.hpp"

namespace delos {
namespace {

constexpr const char* kEastward = "surface_eastward_sea_water_velocity";
constexpr const char* kNorthward = "surface_northward_sea_water_velocity";
constexpr const char* kNormal = "surface_normal_sea_water_velocity";
constexpr const char* kEnergy = "eddy_kinetic_energy";
constexpr const char* kHeight = "sea_surface_height_above_geoid";
constexpr const char* kIndicator = "remesh_indicator";
constexpr const char* kSpacing = "wanted_spacing";

std::vector<const char*> imports_of(SolutionField field) {
  switch (field) {
    case SolutionField::velocity:
    case SolutionField::vorticity_gradient:
      return {kEastward, kNorthward};
    case SolutionField::normal_velocity:
      return {kNormal};
    case SolutionField::energy:
      return {kEnergy};
    case SolutionField::height:
      return {kHeight};
    case SolutionField::indicator:
      return {kIndicator};
    case SolutionField::spacing:
      return {kSpacing};
  }
  return {};
}

const char* name_of(SolutionField field) {
  constexpr const char* kNames[] = {"velocity",           "normal_velocity", "energy", "height",
                                    "vorticity_gradient", "indicator",       "spacing"};
  return kNames[static_cast<std::size_t>(field)];
}

bool is_vector(SolutionField field) {
  return field == SolutionField::velocity || field == SolutionField::normal_velocity;
}

bool same_axes(const LatLonAxes& a, const LatLonAxes& b) {
  return a.lon_deg == b.lon_deg && a.lat_deg == b.lat_deg;
}

std::string place_in_cells(const Grid& grid, std::int64_t cell) {
  const LonLat place = grid.cell_lon_lat[static_cast<std::size_t>(cell)];
  return text("cell ", cell, " (counted from 0; lon ", place.lon_rad * kDegPerRad, ", lat ",
              place.lat_rad * kDegPerRad, " deg)");
}

std::string place_on_table(const LatLonAxes& axes, std::int64_t point) {
  const auto n_lon = static_cast<std::int64_t>(axes.lon_deg.size());
  return text("lon ", axes.lon_deg[static_cast<std::size_t>(point % n_lon)], ", lat ",
              axes.lat_deg[static_cast<std::size_t>(point / n_lon)], " deg");
}

/// One value a place and field, from statistics of that field.
Array<double> signal_of(parallel::Executor& exec, SolutionField field,
                        const Statistics& statistics) {
  if (is_vector(field)) return eddy_kinetic_energy(exec, statistics);
  if (field == SolutionField::height) return statistics.variance(exec, 0);
  const std::span<const double> mean = statistics.mean(0);
  return {mean.begin(), mean.end()};
}

/// The velocity whose mean carries a source's signal.
SolutionField flow_of(SolutionField field) {
  return field == SolutionField::normal_velocity ? field : SolutionField::velocity;
}

}  // namespace

struct Solution::Values {
  LatLonAxes axes;
  std::vector<std::span<const double>> fields;  ///< none: the host has not given them
  std::array<Array<double>, 2> own;             ///< what was computed from the imports
};

Solution::Solution(const RemeshSettings& settings)
    : sources_(settings.sources), options_(settings.statistics) {
  for (const SolutionSource& source : sources_) {
    track(source.field);
    if (source.upstream) track(flow_of(source.field));
  }
}

void Solution::track(SolutionField field) {
  const bool is_known = std::any_of(trackers_.begin(), trackers_.end(),
                                    [&](const Tracker& one) { return one.field == field; });
  if (is_known) return;
  trackers_.emplace_back();
  trackers_.back().field = field;
}

std::vector<FieldTraits> Solution::imports(const RemeshSettings& settings) {
  std::vector<FieldTraits> out;
  for (const Tracker& tracker : Solution(settings).trackers_) {
    if (tracker.field == SolutionField::normal_velocity) {
      out.push_back({.name = kNormal,
                     .standard_name = "",
                     .units = "m s-1",
                     .long_name = "velocity of the surface water along the edges' normals",
                     .location = Location::edge});
    } else if (tracker.field == SolutionField::height) {
      out.push_back({.name = kHeight,
                     .standard_name = kHeight,
                     .units = "m",
                     .long_name = "height of the sea surface above the geoid"});
    } else if (tracker.field == SolutionField::indicator) {
      out.push_back({.name = kIndicator,
                     .standard_name = "",
                     .units = "1",
                     .long_name = "amplitude that the spacing follows, of the host's own unit"});
    } else if (tracker.field == SolutionField::spacing) {
      out.push_back({.name = kSpacing,
                     .standard_name = "",
                     .units = "m",
                     .long_name = "distance to the neighbours that the host asks for"});
    }
  }
  return out;
}

Solution::Values Solution::values_of(parallel::Executor& exec, SolutionField field,
                                     const State& imports, const Grid& grid) const {
  Values out;
  std::vector<std::span<const double>> given;
  for (const char* const name : imports_of(field)) {
    const auto item = imports.item(name);
    if (!item->has_data()) return {};
    const LatLonAxes axes =
        item->traits().location == Location::lat_lon ? item->axes() : LatLonAxes{};
    DELOS_CHECK(given.empty() || same_axes(axes, out.axes), ErrorKind::input, kEastward, " and ",
                kNorthward, " must be given at the same places");
    out.axes = axes;
    given.push_back(item->data());
  }
  const bool is_in_cells = out.axes.lon_deg.empty();
  const auto n_cells = static_cast<std::size_t>(grid.n_cells());
  if (field == SolutionField::normal_velocity) {
    DELOS_CHECK(is_in_cells, ErrorKind::input, kNormal, " must be given on the grid's edges");
    for (Array<double>& component : out.own) component.resize(n_cells);
    vectors_at_cells(exec, grid, given[0], out.own[0], out.own[1]);
    out.fields = {out.own[0], out.own[1]};
  } else if (field == SolutionField::vorticity_gradient) {
    DELOS_CHECK(is_in_cells, ErrorKind::input,
                "the source vorticity_gradient needs velocities in the grid's cells");
    const Array<double> normal = normals_at_edges(exec, grid, given[0], given[1]);
    out.own[0] = vorticity_gradient(exec, grid, normal);
    out.fields = {out.own[0]};
  } else {
    out.fields = std::move(given);
  }
  return out;
}

void Solution::add(parallel::Executor& exec, const State& imports, const Grid& grid,
                   double duration_s) {
  std::vector<Values> values;
  std::vector<Sample> samples(trackers_.size());
  std::vector<Tracker> fresh(trackers_.size());
  for (std::size_t i = 0; i < trackers_.size(); ++i) {
    const Tracker& tracker = trackers_[i];
    values.push_back(values_of(exec, tracker.field, imports, grid));
    const Values& now = values.back();
    if (now.fields.empty()) continue;
    const bool is_in_cells = now.axes.lon_deg.empty();
    samples[i] = {now.fields, duration_s, !is_in_cells, [&grid, axes = now.axes](std::int64_t k) {
                    return axes.lon_deg.empty() ? place_in_cells(grid, k) : place_on_table(axes, k);
                  }};
    const auto n_points = static_cast<std::int64_t>(now.fields[0].size());
    const bool goes_on = tracker.statistics && same_axes(tracker.axes, now.axes) &&
                         tracker.statistics->n_points() == n_points;
    if (!goes_on) {
      const auto n_fields = static_cast<int>(now.fields.size());
      fresh[i] = {tracker.field, now.axes, Statistics(options_, n_fields, n_points)};
    }
    try {
      (goes_on ? tracker : fresh[i]).statistics->check(exec, samples[i]);
    } catch (const Error& error) {
      throw Error(error.kind(), text("import ", imports_of(tracker.field)[0], ": ", error.what()));
    }
  }
  // What could be refused has been.
  for (std::size_t i = 0; i < trackers_.size(); ++i) {
    if (samples[i].fields.empty()) continue;
    if (fresh[i].statistics) trackers_[i] = std::move(fresh[i]);
    trackers_[i].statistics->take(exec, samples[i]);
  }
}

bool Solution::is_ready() const {
  return std::all_of(trackers_.begin(), trackers_.end(), [](const Tracker& tracker) {
    return tracker.statistics && tracker.statistics->is_ready();
  });
}

const Solution::Tracker& Solution::tracker_of(SolutionField field) const {
  return *std::find_if(trackers_.begin(), trackers_.end(),
                       [&](const Tracker& tracker) { return tracker.field == field; });
}

SpacingSource Solution::source_of(parallel::Executor& exec, WholeGrid& whole,
                                  const SolutionSource& source) const {
  const auto raster = [&](const Tracker& tracker, std::span<const double> values) {
    return tracker.is_in_cells()
               ? raster_of_cells(exec, whole.grid(), whole.spread(values),
                                 cell_resolution_rad(whole.grid()), source.name)
               : raster_of_table(tracker.axes.lon_deg, tracker.axes.lat_deg, values, source.name);
  };
  const Tracker& tracker = tracker_of(source.field);
  Raster signal = raster(tracker, signal_of(exec, source.field, *tracker.statistics));
  if (source.upstream) {
    const Tracker& flow = tracker_of(flow_of(source.field));
    const Raster east = raster(flow, flow.statistics->mean(0));
    const Raster north = raster(flow, flow.statistics->mean(1));
    signal =
        spread_upstream(exec, signal, {east, north}, *source.upstream, whole.surface().scale_m());
  }
  auto field = std::make_shared<const Raster>(std::move(signal));
  if (const auto* const wanted = std::get_if<WantedSpacing>(&source.law)) {
    return {source.name, RasterSource{std::move(field), 1.0, wanted->missing_m}};
  }
  EddySource law = std::get<EddySource>(source.law);
  law.field = std::move(field);
  return {source.name, std::move(law)};
}

std::vector<SpacingSource> Solution::sources(parallel::Executor& exec, WholeGrid& whole) const {
  std::vector<SpacingSource> out;
  out.reserve(sources_.size());
  for (const SolutionSource& source : sources_) out.push_back(source_of(exec, whole, source));
  return out;
}

std::vector<std::string> Solution::names() const {
  std::vector<std::string> out;
  for (const Tracker& tracker : trackers_) out.emplace_back(name_of(tracker.field));
  return out;
}

std::vector<Solution::Saved> Solution::saved() const {
  std::vector<Saved> out;
  for (const Tracker& tracker : trackers_) {
    if (!tracker.statistics) continue;
    out.push_back({name_of(tracker.field), tracker.axes, tracker.statistics->state()});
  }
  return out;
}

void Solution::restore(const Saved& saved, const Grid& grid) {
  for (Tracker& tracker : trackers_) {
    if (saved.name != name_of(tracker.field)) continue;
    Statistics statistics = Statistics::restored(options_, saved.statistics);
    const auto n_table =
        static_cast<std::int64_t>(saved.axes.lon_deg.size() * saved.axes.lat_deg.size());
    const std::int64_t n_places = saved.axes.lon_deg.empty() ? grid.n_cells() : n_table;
    DELOS_CHECK(statistics.n_points() == n_places &&
                    statistics.n_fields() == (is_vector(tracker.field) ? 2 : 1),
                ErrorKind::input, "the statistics of ", saved.name, " have ", statistics.n_fields(),
                " fields at ", statistics.n_points(), " places, not at ", n_places);
    tracker.axes = saved.axes;
    tracker.statistics = std::move(statistics);
  }
}

void Solution::move(parallel::Executor& exec, const Grid& from, const Grid& to,
                    const MoveField& field) {
  for (Tracker& tracker : trackers_) {
    if (!tracker.statistics) continue;
    if (tracker.is_in_cells()) {
      tracker.statistics->move(exec, {to.n_cells(), field, from.cell_lon_lat, to.cell_lon_lat});
    } else if (options_.window == Window::since_remesh) {
      tracker.statistics.emplace(options_, tracker.statistics->n_fields(),
                                 tracker.statistics->n_points());
    }
  }
}

}  // namespace delos
