// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// When to make a grid anew: how far the grid is from what is wanted, and the decision.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "dual/grid.hpp"
#include "sizing/spacing.hpp"
#include "time/time.hpp"

namespace delos {

/// The wanted spacing at the cells' generators, metres, [n_cells].
Array<double> wanted_at_cells(parallel::Executor& exec, const Grid& grid,
                              const SpacingField& wanted);

/// Shares of the area, 0 to 1, of the cells that may change.
struct Mismatch {
  double too_coarse = 0.0;  ///< spacing / wanted > tau
  double too_fine = 0.0;    ///< spacing / wanted < 1 / tau
  double total() const { return too_coarse + too_fine; }
};

/// The spacing is the one that each cell was made for (grid.cell_spacing_m), so a grid just made
/// for `wanted_m` has no mismatch. `is_fixed` [n_cells], or empty: cells that no remesh touches
/// count neither as area nor as mismatch. Error(config) unless tau > 1, Error(input) for sizes that
/// do not fit.
Mismatch mismatch(parallel::Executor& exec, const Grid& grid, std::span<const double> wanted_m,
                  double tau, std::span<const char> is_fixed = {});

/// The count to scale the wanted spacing to so that the mesh gets `cells`: the mesh of now has
/// n_now where its spacing let n_expected be expected, and the next one does alike (within 5 %;
/// further off is another cause, such as a tiny grid, and not corrected).
std::int64_t corrected_budget(std::int64_t cells, std::int64_t n_now, double n_expected);

struct PolicyOptions {
  double tau = 1.2;        ///< of the mismatch
  double threshold = 0.1;  ///< least share of the area for a remesh, 0 to 1
  /// After a remesh the mismatch must have been below threshold * (1 - hysteresis) once before it
  /// counts again: a grid that can't follow (budget, clamp, fixed regions) is not made anew in
  /// vain. 0 to 1; with 0 being below the threshold is enough.
  double hysteresis = 0.5;
  std::optional<TimeInterval> minimum_interval;  ///< between two remeshes
};
/// Error(config) naming the option that is out of range.
void check(const PolicyOptions& options);

enum class Reason {
  mismatch,         ///< the only one for a remesh
  no_alarm,         ///< the interval is not over
  no_statistics,    ///< the window has not been filled
  too_soon,         ///< minimum_interval
  below_threshold,  ///< the grid fits
  not_rearmed       ///< hysteresis
};
const char* to_string(Reason reason);

/// What is kept between decisions, and in the restart file.
struct PolicyState {
  bool is_armed = true;
  std::optional<Time> last_remesh;
};

struct PolicyInput {
  Time now;
  bool alarm_rings = true;
  bool has_statistics = true;
  Mismatch mismatch;            ///< not looked at without statistics
  double expected_cells = 0.0;  ///< of the wanted spacing
};

struct Decision {
  bool remesh = false;
  std::vector<Reason> reasons;  ///< all that hold: one for, or one or more against
  Mismatch mismatch;
  double expected_cells = 0.0;
  std::string text;  ///< one line, with the numbers
};

/// Decides, and arms the state again when the mismatch has fallen far enough. A remesh that is
/// decided changes the state only by note_remesh, when it is done: one that failed is tried again.
Decision decide(const PolicyOptions& options, const PolicyInput& input, PolicyState& state);

void note_remesh(const Time& now, PolicyState& state);

}  // namespace delos
