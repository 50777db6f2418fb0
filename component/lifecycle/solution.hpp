// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What a remesh knows of the running model: its imports, their statistics, and the sources of
// spacing made of these.
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "adapt/statistics.hpp"
#include "core/parallel.hpp"
#include "dual/grid.hpp"
#include "lifecycle/fields.hpp"
#include "lifecycle/settings_remesh.hpp"
#include "lifecycle/whole_grid.hpp"
#include "sizing/sources.hpp"

namespace delos {

class Solution {
 public:
  explicit Solution(const RemeshSettings& settings);

  /// Fields that its sources need and not every component declares.
  static std::vector<FieldTraits> imports(const RemeshSettings& settings);

  /// Takes the imports, as they stood for `duration_s`, into the statistics; fields without values
  /// are passed over. Error(input) with the field and the place of a value that can't be used;
  /// then nothing has changed. A host's new lat-lon grid begins that field's statistics anew.
  void add(parallel::Executor& exec, const State& imports, const Grid& grid, double duration_s);
  /// Whether all statistics are.
  bool is_ready() const;
  /// The sources, with what the statistics in the cells of the product of `whole` say, and nothing
  /// elsewhere; after is_ready(). The whole grid is made where statistics are in cells.
  std::vector<SpacingSource> sources(parallel::Executor& exec, WholeGrid& whole) const;

  /// What a restart file keeps of one field's statistics; refers to them.
  struct Saved {
    std::string name;  ///< of the field, as in names()
    LatLonAxes axes;   ///< empty for cells
    StatisticsState statistics;
  };
  /// Of the fields that its sources need, whether they have statistics or not.
  std::vector<std::string> names() const;
  std::vector<Saved> saved() const;
  /// Error(input) when the state is not of such statistics, or not of so many cells or axes.
  void restore(const Saved& saved, const Grid& grid);

  using MoveField = std::function<void(std::span<const double> from, std::span<double> to)>;
  /// To another grid, whose cells get their values by `field`.
  void move(parallel::Executor& exec, const Grid& from, const Grid& to, const MoveField& field);

 private:
  /// One field's statistics, in cells or on the host's lat-lon grid.
  struct Tracker {
    SolutionField field = SolutionField::velocity;
    LatLonAxes axes;  ///< empty for cells
    std::optional<Statistics> statistics;
    bool is_in_cells() const { return axes.lon_deg.empty(); }
  };
  /// The values of one tracker in one sample.
  struct Values;

  Values values_of(parallel::Executor& exec, SolutionField field, const State& imports,
                   const Grid& grid) const;
  const Tracker& tracker_of(SolutionField field) const;
  void track(SolutionField field);
  SpacingSource source_of(parallel::Executor& exec, WholeGrid& whole,
                          const SolutionSource& source) const;

  std::vector<SolutionSource> sources_;
  StatisticsOptions options_;
  std::vector<Tracker> trackers_;  ///< one for each field that a source needs
};

}  // namespace delos
