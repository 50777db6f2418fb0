// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// delos: Delaunay/Voronoi grids of the sphere and the ellipsoid. Everything public.
//
//   const auto config = delos::Config::from_file("world_ocean.yaml");
//   const delos::Grid grid = delos::generate(config);
//   for (double area_m2 : grid.cell_area_m2()) ...
//
// An object that was moved from may be assigned to or destroyed, nothing else. Several
// threads may use delos at once, each its own objects. netCDF, below all that reads or writes
// files, serves one thread of a process at a time: delos takes turns among its own calls, and a
// host that calls netCDF itself meanwhile from another thread must not.
#include "delos/clock.hpp"      // IWYU pragma: export
#include "delos/component.hpp"  // IWYU pragma: export
#include "delos/config.hpp"     // IWYU pragma: export
#include "delos/error.hpp"      // IWYU pragma: export
#include "delos/field.hpp"      // IWYU pragma: export
#include "delos/generate.hpp"   // IWYU pragma: export
#include "delos/grid.hpp"       // IWYU pragma: export
#include "delos/partition.hpp"  // IWYU pragma: export
#include "delos/services.hpp"   // IWYU pragma: export
#include "delos/state.hpp"      // IWYU pragma: export
#include "delos/time.hpp"       // IWYU pragma: export
#include "delos/transfer.hpp"   // IWYU pragma: export
#include "delos/version.hpp"    // IWYU pragma: export
