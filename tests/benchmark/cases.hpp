// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The fixed cases. Their names and meanings do not change: figures of other years and other
// generators are known under them.
#include <functional>
#include <string>
#include <vector>

namespace delos::benchmark {

struct Case {
  std::string name;
  std::string yaml;            ///< configuration, but for `output`
  bool is_large = false;       ///< runs only when named or asked for: minutes, gigabytes
  bool writes_files = false;   ///< whether the phase "write" is measured (an MPAS file)
  std::string data_file = {};  ///< file of ferret-datasets without which the case is left out
  /// Makes the input files that the configuration names; null: none.
  std::function<void(const std::string& folder)> prepare = {};
};

/// U: uniform spacing in km. E: the same on WGS84. T: on a triaxial body of radii 1.2 : 1.0 : 0.8.
/// V1: 150 km with a 15 km Gaussian patch; V1fine: a quarter of that. Rossby: twice a zonal Rossby
/// radius, 30 to 150 km. EKE: from an eddy-rich field, 60 to 10 km. Slope: bottom slope of ETOPO5,
/// 15 to 60 km. G: V1 scaled to that many vertices, for the growth of times.
std::vector<Case> all_cases();

}  // namespace delos::benchmark
