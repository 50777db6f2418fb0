// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A model with the grid that delos::Component keeps for it, and remakes where the flow asks for it.
#include <delos/delos.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cases.hpp"
#include "model.hpp"

namespace shallow_water {

/// How strongly the flow asks for small cells [n_cells], from 0 to 1: the steepest slope of the
/// vorticity about the cell over the root-mean-square of these, which a few fronts do not rule; all
/// above it asks alike, so that what is fine is evenly so.
std::vector<double> indicator(const Model& model);

/// A change of grid, from one flow to the other.
struct Change {
  std::int64_t n_before = 0, n_after = 0, n_unchanged = 0;  ///< cells
  Totals before, after;
};

class Host {
 public:
  /// The component runs a day ahead on the flow of the start, so that the grid is the one that this
  /// asks for. Error(config) and what the grid's making throws.
  Host(const Case& flow, const Physics& physics, const delos::Config& config, int threads);

  /// An hour of the model, then one of the component: where the configuration has a section
  /// `remesh` its alarm may ring, and the flow goes on on a new grid, mass to the last bits.
  /// Returns what changed.
  std::optional<Change> advance_hour(double courant);

  const Model& model() const { return model_; }
  int hour() const { return hour_; }
  /// Why the last alarm changed the grid, or not; empty without one.
  std::string decision() const { return component_.remesh_decision(); }

 private:
  void begin();
  bool run_component();  // for an hour; whether there is a new grid
  Change carry(const delos::Grid& before, const delos::Grid& after);

  Case case_;
  Physics physics_;
  int threads_;
  delos::Component component_;
  delos::Clock clock_;
  Model model_;
  int hour_ = 0;
};

}  // namespace shallow_water
