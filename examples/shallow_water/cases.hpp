// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What flows at the start: three published tests, each a zonal flow in balance and what disturbs
// it.
#include <delos/delos.hpp>
#include <functional>
#include <string>
#include <vector>

#include "model.hpp"

namespace shallow_water {

/// What to look at: a map between two latitudes, and the vorticity in 1/s that is dark red there.
struct View {
  double south_deg = -90.0, north_deg = 90.0;
  double largest = 1.0;
};

struct Start {
  std::vector<double> ground_m;  ///< [n_cells]
  Flow flow;
};

class Case {
 public:
  /// "tc2" and "tc5": Williamson et al. 1992 (doi:10.1016/S0021-9991(05)80016-6), steady zonal flow
  /// and zonal flow over a mountain. "galewsky": Galewsky et al. 2004
  /// (doi:10.3402/tellusa.v56i5.14436), the jet at 45 N with its perturbation. Error(input) for
  /// any other name.
  static Case named(const std::string& name);

  /// Depths are those at the cells' centroids, their means to second order; velocities the
  /// differences of a stream function, so that they have no divergence.
  Start start(const delos::Grid& grid, const Physics& physics) const;
  /// [n_cells] at the centroids.
  std::vector<double> ground_m(const delos::Grid& grid) const;
  const View& view() const { return view_; }
  double days() const { return days_; }
  /// The start is the solution for all time.
  bool is_steady() const { return is_steady_; }

 private:
  using Profile = std::function<double(double lat_rad)>;
  using Height = std::function<double(double lon_rad, double lat_rad)>;
  static Case steady_flow();
  static Case mountain();
  static Case jet();
  double push_m2_s2(double lat_rad, double radius_m, const Physics& physics) const;
  double base_m(double radius_m, const Physics& physics) const;

  Profile zonal_m_s_;
  double south_rad_ = 0.0, north_rad_ = 0.0;  // where it flows
  double datum_m_ = 0.0;                      // height of the surface at the equator,
  bool is_mean_ = false;                      // or its mean over the sphere
  Height ground_m_, bump_m_;
  View view_;
  double days_ = 0.0;
  bool is_steady_ = false;
};

}  // namespace shallow_water
