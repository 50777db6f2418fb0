// SPDX-License-Identifier: BSD-3-Clause
#include "remap/gradients.hpp"

#include <algorithm>

#include "geometry/tangent_frame.hpp"

namespace delos::remap {
namespace {

constexpr std::int64_t kSourceGrain = 2048;  // about 0.2 ms of stencils

// Neighbours that lie in one line (determinant against the square of the trace) give no gradient
// across it: the source is transferred to first order.
constexpr double kInLine = 1e-6;

// Normal equations of min sum (g . d_k - (f_k - f_j))^2 in the plane.
void fit(const Overlaps& overlaps, std::int64_t j, std::span<const Index> neighbours,
         std::span<Vec3> row) {
  const Vec3& here = overlaps.source_middle[at(j)];
  const TangentFrame plane(here.normalized());
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t k = 0; k < row.size(); ++k) {
    const Vec3 d = overlaps.source_middle[at(neighbours[k])] - here;
    const double x = d.dot(plane.right), y = d.dot(plane.ahead);
    row[k] = Vec3(x, y, 0.0);
    xx += x * x;
    xy += x * y;
    yy += y * y;
  }
  const double det = xx * yy - xy * xy;
  const double trace = xx + yy;
  const double inverse = det > kInLine * trace * trace ? 1.0 / det : 0.0;
  for (Vec3& entry : row) {
    const double x = inverse * (yy * entry.x() - xy * entry.y());
    const double y = inverse * (xx * entry.y() - xy * entry.x());
    entry = x * plane.right + y * plane.ahead;
  }
}

}  // namespace

GradientStencils gradient_stencils(parallel::Executor& exec, const Tiling& source,
                                   const Overlaps& overlaps) {
  // Beyond a border there is none.
  const auto exists = [](Index beside) { return beside != kNone; };
  GradientStencils stencils;
  stencils.offsets.resize(at(source.size()) + 1);
  stencils.offsets[0] = 0;
  for (std::int64_t j = 0; j < source.size(); ++j) {
    stencils.offsets[at(j) + 1] =
        stencils.offsets[at(j)] + std::ranges::count_if(source.neighbours(j), exists);
  }
  stencils.neighbour.resize(at(stencils.offsets.back()));
  stencils.coefficient.resize(at(stencils.offsets.back()));
  parallel::for_index(exec, source.size(), kSourceGrain, [&](std::int64_t j) {
    const auto neighbours = source.neighbours(j);
    const std::size_t first = at(stencils.offsets[at(j)]);
    Index* const row = stencils.neighbour.data() + first;
    const auto n = at(std::copy_if(neighbours.begin(), neighbours.end(), row, exists) - row);
    fit(overlaps, j, {row, n}, {stencils.coefficient.data() + first, n});
  });
  return stencils;
}

Array<Vec3> gradients(parallel::Executor& exec, const GradientStencils& stencils,
                      std::span<const double> field) {
  Array<Vec3> result(field.size());
  parallel::for_index(
      exec, static_cast<std::int64_t>(field.size()), kSourceGrain, [&](std::int64_t j) {
        Vec3 sum = Vec3::Zero();
        for (auto k = stencils.offsets[at(j)]; k < stencils.offsets[at(j) + 1]; ++k) {
          sum +=
              (field[at(stencils.neighbour[at(k)])] - field[at(j)]) * stencils.coefficient[at(k)];
        }
        result[at(j)] = sum;
      });
  return result;
}

}  // namespace delos::remap
