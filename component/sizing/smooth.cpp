// SPDX-License-Identifier: BSD-3-Clause
// Gaussian smoothing: a Gaussian of standard deviation sigma is the heat kernel at time
// sigma^2 / 2. Implicit steps split by direction need no care at the poles, where the columns
// crowd: every step is a weighted mean with weights >= 0 and conserves the area integral.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "sizing/nodes.hpp"
#include "sizing/raster.hpp"

namespace delos {
namespace {

/// Backward Euler has the right variance for any number of steps; with 4 the kernel's shape is
/// near the Gaussian's (excess kurtosis 3 / 4 instead of 3).
constexpr int kSteps = 4;
/// Columns solved together: one cache line wide, so that the loops across them vectorise.
constexpr Index kColumnBlock = 16;

class Smoother {
 public:
  Smoother(parallel::Executor& exec, double time, LatLonField& field)
      : exec_(exec), field_(field), time_(time), is_valid_(field.values.size()) {
    const Index last = field.n_lat_cells;
    const double step = kPi / last;
    for (Index j = 0; j <= last; ++j) {
      const double south = std::max(field.lat_rad(j) - 0.5 * step, -0.5 * kPi);
      const double north = std::min(field.lat_rad(j) + 0.5 * step, 0.5 * kPi);
      cos_.push_back(elementary::cos(field.lat_rad(j)));
      cos_north_.push_back(j < last ? elementary::cos(north) : 0.0);
      area_.push_back(elementary::sin(north) - elementary::sin(south));
    }
    for (std::size_t k = 0; k < field.values.size(); ++k) {
      is_valid_[k] = !std::isnan(field.values[k]);
      if (!is_valid_[k]) field.values[k] = 0.0;
    }
  }

  void run() {
    for (int step = 0; step < kSteps; ++step) {
      // Order turned round at every step: the error of splitting is of second order.
      step % 2 == 0 ? diffuse_rows() : diffuse_columns();
      step % 2 == 0 ? diffuse_columns() : diffuse_rows();
    }
    for (std::size_t k = 0; k < is_valid_.size(); ++k) {
      if (!is_valid_[k]) field_.values[k] = std::numeric_limits<double>::quiet_NaN();
    }
    unify_poles(field_);
  }

 private:
  bool valid(Index row, Index column) const { return is_valid_[field_.at(row, column)] != 0; }
  void diffuse_rows();
  void diffuse_columns();
  void diffuse_ring(Index row, double* x);
  void diffuse_block(Index begin, Index end);
  void mix_pole(Index row, double* x) const;

  parallel::Executor& exec_;
  LatLonField& field_;
  double time_;
  std::vector<char> is_valid_;
  std::vector<double> cos_, cos_north_, area_;
};

void Smoother::mix_pole(Index row, double* x) const {
  double sum = 0.0;
  Index n = 0;
  for (Index i = 0; i < field_.n_lon; ++i) {
    if (!valid(row, i)) continue;
    sum += x[i];
    ++n;
  }
  for (Index i = 0; i < field_.n_lon; ++i) {
    if (valid(row, i)) x[i] = sum / n;
  }
}

/// (1 + w_i + e_i) x_i - w_i x_{i-1} - e_i x_{i+1} = d_i on the ring: elimination with the last
/// unknown kept aside, x_i = y_i + z_i x_last.
void Smoother::diffuse_ring(Index row, double* x) {
  const Index n = field_.n_lon;
  const double step = 2.0 * kPi / n * cos_[static_cast<std::size_t>(row)];
  const double link = time_ / (kSteps * step * step);
  const auto size = static_cast<std::size_t>(n);
  std::vector<double> next(size), z(size);
  const auto east_link = [&](Index i) {
    return valid(row, i) && valid(row, i + 1 == n ? 0 : i + 1) ? link : 0.0;
  };
  const double closing = east_link(n - 1);
  double west = closing;
  for (Index i = 0; i < n - 1; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double east = east_link(i);
    const double carry = i > 0 ? west : 0.0;
    const double diagonal = 1.0 + west + east - (i > 0 ? carry * next[k - 1] : 0.0);
    next[k] = i < n - 2 ? east / diagonal : 0.0;
    x[k] = (x[k] + (i > 0 ? carry * x[k - 1] : 0.0)) / diagonal;
    z[k] = ((i == 0 ? west : carry * z[k - 1]) + (i == n - 2 ? east : 0.0)) / diagonal;
    west = east;
  }
  for (Index i = n - 2; i-- > 0;) {
    const auto k = static_cast<std::size_t>(i);
    x[k] += next[k] * x[k + 1];
    z[k] += next[k] * z[k + 1];
  }
  const std::size_t last = size - 1;
  x[last] = (x[last] + west * x[last - 1] + closing * x[0]) /
            (1.0 + west + closing - west * z[last - 1] - closing * z[0]);
  for (std::size_t k = 0; k < last; ++k) x[k] += z[k] * x[last];
}

void Smoother::diffuse_rows() {
  for_rows(exec_, field_, [&](Index row, double* x) {
    row == 0 || row == field_.n_lat_cells ? mix_pole(row, x) : diffuse_ring(row, x);
  });
}

/// The tridiagonal systems of columns [begin, end), side by side.
void Smoother::diffuse_block(Index begin, Index end) {
  const Index n = field_.n_rows(), width = end - begin;
  const double per_step = time_ / kSteps * n / kPi;
  std::vector<double> next(static_cast<std::size_t>(n) * kColumnBlock);
  double south[kColumnBlock] = {};
  for (Index j = 0; j < n; ++j) {
    const double area = area_[static_cast<std::size_t>(j)];
    const double link = per_step * cos_north_[static_cast<std::size_t>(j)];
    double* x = field_.values.data() + field_.at(j, begin);
    double* here = next.data() + static_cast<std::size_t>(j) * kColumnBlock;
    for (Index c = 0; c < width; ++c) {
      const bool linked = j + 1 < n && valid(j, begin + c) && valid(j + 1, begin + c);
      const double north = linked ? link : 0.0;
      const double before = j > 0 ? here[c - kColumnBlock] : 0.0;
      const double below = j > 0 ? x[c - field_.n_lon] : 0.0;
      const double diagonal = area + south[c] + north - south[c] * before;
      here[c] = north / diagonal;
      x[c] = (area * x[c] + south[c] * below) / diagonal;
      south[c] = north;
    }
  }
  for (Index j = n - 1; j-- > 0;) {
    double* x = field_.values.data() + field_.at(j, begin);
    const double* here = next.data() + static_cast<std::size_t>(j) * kColumnBlock;
    for (Index c = 0; c < width; ++c) x[c] += here[c] * x[c + field_.n_lon];
  }
}

void Smoother::diffuse_columns() {
  parallel::for_range(exec_, field_.n_lon, kColumnBlock, [&](std::int64_t begin, std::int64_t end) {
    diffuse_block(static_cast<Index>(begin), static_cast<Index>(end));
  });
}

}  // namespace

void smooth(parallel::Executor& exec, double sigma_rad, LatLonField& field) {
  DELOS_CHECK(std::isfinite(sigma_rad) && sigma_rad >= 0.0 && sigma_rad < kPi, ErrorKind::config,
              "smoothing by ", sigma_rad * kDegPerRad, " deg: it must be in [0, 180) deg");
  DELOS_CHECK(field.n_lat_cells >= 2 && field.n_lon >= 3, ErrorKind::config, "a spacing table of ",
              field.n_rows(), " x ", field.n_lon, " nodes is too small to smooth");
  if (sigma_rad > 0.0) Smoother(exec, 0.5 * sigma_rad * sigma_rad, field).run();
}

}  // namespace delos
