// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Time mean and variance of what a model sends, place by place, in one pass over its samples.
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/array.hpp"
#include "core/parallel.hpp"
#include "geometry/ellipsoid.hpp"

namespace delos {

/// What the statistics are taken over.
///   since_remesh: everything since the grid was made
///   exponential:  everything, a moment t ago counting exp(-t / length)
///   fixed:        consecutive stretches of `length`; the last complete one is what is used
enum class Window { since_remesh, exponential, fixed };
const char* to_string(Window window);

struct StatisticsOptions {
  Window window = Window::since_remesh;
  double length_s = 0.0;  ///< e-folding time, or length of a stretch; > 0 but for since_remesh
};

/// Values that stood for `duration_s`: the samples may be unequally far apart.
struct Sample {
  std::vector<std::span<const double>> fields;  ///< [n_fields] of [n_points]
  double duration_s = 0.0;                      ///< > 0
  /// A value may be NaN; such a place has no mean from then on, until the window begins anew.
  bool may_miss = false;
  /// Says where a point is, for messages: "cell 17 (lon 3, lat 4 deg)".
  std::function<std::string(std::int64_t point)> place = {};
};

/// Weighted mean m and spread S = sum w (x - m)^2 of each field at each point; the variance is S /
/// W. A sample of weight w turns W, m, S, after decay by q (1 but for exponential windows), into
///   W' = q W + w,  m' = m + (w / W') d,  S' = q S + (q W w / W') d^2,  d = x - m
/// (Welford 1962, doi:10.1080/00401706.1962.10490022, with the weights of West 1979,
/// doi:10.1145/359146.359153). w is the duration, or length (1 - q) with
/// q = exp(-duration / length). No term of S is negative, no large sums are subtracted.
struct Moments {
  double weight_s = 0.0;  ///< W
  std::int64_t n_samples = 0;
  Array<double> mean, spread;  ///< [n_fields * n_points], field after field
};

/// What a restart file keeps; refers to the statistics that it is of.
struct StatisticsState {
  /// window, n_fields, n_points, samples of the running and of the complete window, n_complete
  std::vector<std::int64_t> counts;
  std::vector<double> times_s;  ///< length, elapsed, weights of the running and the complete window
  std::span<const double> mean, spread;                    ///< of the running window
  std::span<const double> complete_mean, complete_spread;  ///< empty before one is complete
};

/// How values come to another grid.
struct StatisticsMove {
  std::int64_t n_points = 0;  ///< of the new grid
  /// From a scalar on the old places to one on the new ones: linear, and within the old's range.
  std::function<void(std::span<const double> from, std::span<double> to)> field;
  /// The places themselves; only needed for two fields, which are then a vector's east and north.
  std::span<const LonLat> from = {}, to = {};
};

/// Bit for bit the same for any number of threads, and for a run that was restarted from its state.
class Statistics {
 public:
  /// Error(config) for a length that is not finite and > 0 where one is needed.
  Statistics(const StatisticsOptions& options, int n_fields, std::int64_t n_points);
  /// Error(input) when the state is not of such statistics.
  static Statistics restored(const StatisticsOptions& options, const StatisticsState& state);
  StatisticsState state() const;

  /// Error(input) for a size, a duration or a value (NaN, infinite) that can't be used, with
  /// its place.
  void check(parallel::Executor& exec, const Sample& sample) const;
  /// Takes a sample that has been checked.
  void take(parallel::Executor& exec, const Sample& sample);
  /// Both: a sample that is refused changes nothing.
  void add(parallel::Executor& exec, const Sample& sample);

  /// The moments to use: of the running window, or of the last complete one when it is fixed.
  /// They say something when is_ready().
  const Moments& moments() const;
  /// Two samples at least since the remesh; one e-folding time; one complete stretch.
  bool is_ready() const;
  /// moments().spread / weight of one field, [n_points]; zeros before the first sample.
  Array<double> variance(parallel::Executor& exec, int field) const;
  std::span<const double> mean(int field) const;

  /// Takes everything to another grid; a window since_remesh begins anew. Means of two fields go as
  /// Cartesian components of a vector, spreads as scalars: the sum of both (the eddy kinetic
  /// energy) does not depend on the directions.
  void move(parallel::Executor& exec, const StatisticsMove& move);

  const StatisticsOptions& options() const { return options_; }
  int n_fields() const { return n_fields_; }
  std::int64_t n_points() const { return n_points_; }
  /// Fixed stretches completed.
  std::int64_t n_complete() const { return n_complete_; }
  double elapsed_s() const { return elapsed_s_; }

 private:
  std::size_t size() const { return static_cast<std::size_t>(n_fields_ * n_points_); }
  void accumulate(parallel::Executor& exec, const Sample& sample, double duration_s);
  void close_window();
  void move_moments(parallel::Executor& exec, const StatisticsMove& move, Moments& moments) const;

  StatisticsOptions options_;
  int n_fields_;
  std::int64_t n_points_;
  std::int64_t n_complete_ = 0;
  double elapsed_s_ = 0.0;
  Moments running_, complete_;
};

/// (var u + var v) / 2 of statistics of a velocity's two components, in their unit squared.
Array<double> eddy_kinetic_energy(parallel::Executor& exec, const Statistics& velocity);

/// 1 - exp(-x) for x >= 0 without cancellation, within 4 units in the last place.
double one_minus_exp(double x);

}  // namespace delos
