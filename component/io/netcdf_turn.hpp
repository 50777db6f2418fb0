// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <mutex>

namespace delos::netcdf {

/// netCDF-C and HDF5 keep their open files in tables of the process and serve one thread at a time;
/// hosts make grids in several. Every call of Reader and Writer takes its turn, which is the only
/// thing of a process that delos shares between its objects. Nothing else is waited for meanwhile.
class Turn {
 public:
  Turn();

 private:
  std::lock_guard<std::recursive_mutex> lock_;
};

}  // namespace delos::netcdf
