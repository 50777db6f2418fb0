// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Pairs of grids and smooth fields for tests of the transfer between grids.
#include <cmath>
#include <cstdint>

#include "core/hash.hpp"
#include "remap/overlap.hpp"
#include "support/sample_grids.hpp"

namespace delos::samples {

/// The mesh turned about an axis far from any symmetry, points back on the surface.
inline Mesh turned(const Ellipsoid& surface, Mesh mesh) {
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vec3(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  for (Vertex& vertex : mesh.vertices) {
    const Vec3 p = surface.project(turn * vertex.position());
    vertex = {p.x(), p.y(), p.z(), vertex.spacing};
  }
  return make_delaunay(std::move(mesh));
}

inline remap::Overlaps overlaps_of(const Grid& source, const Grid& target, int threads = 1) {
  parallel::Executor exec(threads);
  Monitor monitor;
  Context context{exec, monitor};
  return remap::intersect(context, remap::Tiling::cells(exec, source),
                          remap::Tiling::cells(exec, target));
}

/// Positive and rough: it changes by a factor from cell to cell.
inline std::vector<double> rough_field(std::int64_t n, std::uint64_t seed) {
  std::vector<double> field(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = 0.01 + uniform01(seed, i);
  return field;
}

inline double mass(std::span<const double> field, std::span<const double> area_m2) {
  long double sum = 0.0L;
  for (std::size_t i = 0; i < field.size(); ++i) {
    sum += static_cast<long double>(field[i]) * static_cast<long double>(area_m2[i]);
  }
  return static_cast<double>(sum);
}

}  // namespace delos::samples
