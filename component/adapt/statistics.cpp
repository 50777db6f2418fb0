// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "geometry/east_north.hpp"

namespace delos {
namespace {

/// Points a task: some ten thousand operations; no result depends on it.
constexpr std::int64_t kPointGrain = 4096;
/// Entries of StatisticsState.
constexpr std::size_t kCounts = 6, kTimes = 4;

void check_options(const StatisticsOptions& options) {
  if (options.window == Window::since_remesh) return;
  DELOS_CHECK(std::isfinite(options.length_s) && options.length_s > 0.0, ErrorKind::config,
              "the window ", to_string(options.window), " has a length of ", options.length_s,
              " s: it must be finite and > 0");
}

/// The first point whose value is of no use, or n.
std::int64_t first_unusable(parallel::Executor& exec, std::span<const double> values,
                            bool may_miss) {
  const auto n = static_cast<std::int64_t>(values.size());
  return parallel::reduce(
      exec, n, kPointGrain, n,
      [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
          const double value = values[at(i)];
          if (!std::isfinite(value) && !(may_miss && std::isnan(value))) return i;
        }
        return n;
      },
      [](std::int64_t a, std::int64_t b) { return std::min(a, b); });
}

void clear(Moments& moments) {
  moments.weight_s = 0.0;
  moments.n_samples = 0;
}

bool is_weight(double value) { return std::isfinite(value) && value >= 0.0; }

void read_moments(std::span<const double> mean, std::span<const double> spread, Moments& out) {
  out.mean.assign(mean.begin(), mean.end());
  out.spread.assign(spread.begin(), spread.end());
}

Array<double> moved_scalars(const StatisticsMove& move, const Array<double>& from, int n_fields) {
  const std::size_t n_from = from.size() / at(n_fields), n_to = at(move.n_points);
  Array<double> to(at(n_fields) * n_to, 0.0);
  for (std::size_t k = 0; k < at(n_fields); ++k) {
    move.field(std::span(from).subspan(k * n_from, n_from), std::span(to).subspan(k * n_to, n_to));
  }
  return to;
}

/// East and north by way of x, y and z: each of these is a scalar.
Array<double> moved_vector(parallel::Executor& exec, const StatisticsMove& move,
                           const Array<double>& from) {
  const auto n_from = static_cast<std::int64_t>(move.from.size());
  Array<double> old(at(n_from)), moved(at(move.n_points), 0.0), to(2 * at(move.n_points), 0.0);
  for (int axis = 0; axis < 3; ++axis) {
    parallel::for_index(exec, n_from, kPointGrain, [&](std::int64_t i) {
      const EastNorth local(move.from[at(i)]);
      old[at(i)] = from[at(i)] * local.east[axis] + from[at(n_from + i)] * local.north[axis];
    });
    move.field(old, moved);
    parallel::for_index(exec, move.n_points, kPointGrain, [&](std::int64_t i) {
      const EastNorth local(move.to[at(i)]);
      to[at(i)] += moved[at(i)] * local.east[axis];
      to[at(move.n_points + i)] += moved[at(i)] * local.north[axis];
    });
  }
  return to;
}

}  // namespace

const char* to_string(Window window) {
  constexpr const char* kNames[] = {"since_remesh", "exponential", "fixed"};
  return kNames[static_cast<std::size_t>(window)];
}

double one_minus_exp(double x) {
  // Above, the difference loses less than a bit; below, the series needs 17 terms for 1e-17.
  constexpr double kSeries = 0.6931471805599453;
  constexpr int kTerms = 17;
  if (x > kSeries) return 1.0 - elementary::exp(-x);
  double rest = 1.0;
  for (int k = kTerms; k > 1; --k) rest = 1.0 - x / k * rest;
  return x * rest;
}

Statistics::Statistics(const StatisticsOptions& options, int n_fields, std::int64_t n_points)
    : options_(options), n_fields_(n_fields), n_points_(n_points) {
  check_options(options);
  DELOS_CHECK(n_fields > 0 && n_points > 0, ErrorKind::config, "statistics of ", n_fields,
              " fields at ", n_points, " places: both must be > 0");
  running_.mean.assign(size(), 0.0);
  running_.spread.assign(size(), 0.0);
}

Statistics Statistics::restored(const StatisticsOptions& options, const StatisticsState& state) {
  DELOS_CHECK(state.counts.size() == kCounts && state.times_s.size() == kTimes, ErrorKind::input,
              "the state of statistics has ", state.counts.size(), " counts and ",
              state.times_s.size(), " times instead of ", kCounts, " and ", kTimes);
  const auto window = static_cast<std::int64_t>(options.window);
  DELOS_CHECK(state.counts[0] == window && state.times_s[0] == options.length_s, ErrorKind::input,
              "the state of statistics is of another window than ", to_string(options.window), ", ",
              options.length_s, " s: keep the settings of the run that wrote it");
  const std::int64_t n_fields = state.counts[1], n_points = state.counts[2];
  constexpr std::int64_t kMostFields = 16, kMostPoints = std::int64_t{1} << 40;
  DELOS_CHECK(n_fields > 0 && n_fields <= kMostFields && n_points > 0 && n_points <= kMostPoints,
              ErrorKind::input, "the state of statistics has ", n_fields, " fields at ", n_points,
              " places");
  const std::size_t n = at(n_fields * n_points);
  const std::size_t n_complete = state.counts[5] > 0 ? n : 0;
  DELOS_CHECK(state.mean.size() == n && state.spread.size() == n &&
                  state.complete_mean.size() == n_complete &&
                  state.complete_spread.size() == n_complete,
              ErrorKind::input, "the arrays of a state of statistics do not have ", n, " values");
  DELOS_CHECK(std::all_of(state.times_s.begin(), state.times_s.end(), is_weight) &&
                  std::all_of(state.counts.begin(), state.counts.end(),
                              [](std::int64_t count) { return count >= 0; }),
              ErrorKind::input, "the state of statistics has a negative or infinite number");

  Statistics out(options, static_cast<int>(n_fields), n_points);
  read_moments(state.mean, state.spread, out.running_);
  read_moments(state.complete_mean, state.complete_spread, out.complete_);
  out.running_.n_samples = state.counts[3];
  out.complete_.n_samples = state.counts[4];
  out.n_complete_ = state.counts[5];
  out.elapsed_s_ = state.times_s[1];
  out.running_.weight_s = state.times_s[2];
  out.complete_.weight_s = state.times_s[3];
  return out;
}

StatisticsState Statistics::state() const {
  return {{static_cast<std::int64_t>(options_.window), n_fields_, n_points_, running_.n_samples,
           complete_.n_samples, n_complete_},
          {options_.length_s, elapsed_s_, running_.weight_s, complete_.weight_s},
          running_.mean,
          running_.spread,
          complete_.mean,
          complete_.spread};
}

void Statistics::check(parallel::Executor& exec, const Sample& sample) const {
  DELOS_CHECK(std::isfinite(sample.duration_s) && sample.duration_s > 0.0, ErrorKind::input,
              "a sample lasts ", sample.duration_s, " s: it must be finite and > 0");
  DELOS_CHECK(sample.fields.size() == at(n_fields_), ErrorKind::input, "a sample has ",
              sample.fields.size(), " fields, the statistics have ", n_fields_);
  for (std::size_t k = 0; k < sample.fields.size(); ++k) {
    const std::span<const double> values = sample.fields[k];
    DELOS_CHECK(values.size() == at(n_points_), ErrorKind::input, "field ", k, " of a sample has ",
                values.size(), " values, the statistics have ", n_points_, " places");
    const std::int64_t bad = first_unusable(exec, values, sample.may_miss);
    DELOS_CHECK(bad == n_points_, ErrorKind::input, "field ", k, " of a sample is ",
                values[at(bad)], " at ", sample.place ? sample.place(bad) : text("place ", bad),
                ": every value must be finite");
  }
}

void Statistics::add(parallel::Executor& exec, const Sample& sample) {
  check(exec, sample);
  take(exec, sample);
}

void Statistics::take(parallel::Executor& exec, const Sample& sample) {
  elapsed_s_ += sample.duration_s;
  double left_s = sample.duration_s;
  if (options_.window == Window::fixed) {
    while (running_.weight_s + left_s >= options_.length_s) {
      const double part_s = options_.length_s - running_.weight_s;
      accumulate(exec, sample, part_s);
      close_window();
      left_s = std::max(left_s - part_s, 0.0);
      // Stretches that one sample fills are alike: the last of them is enough.
      const double whole = std::floor(left_s / options_.length_s);
      if (whole > 1.0) {
        left_s -= (whole - 1.0) * options_.length_s;
        n_complete_ += static_cast<std::int64_t>(whole - 1.0);
      }
    }
  }
  if (left_s > 0.0) accumulate(exec, sample, left_s);
}

void Statistics::accumulate(parallel::Executor& exec, const Sample& sample, double duration_s) {
  double kept_s = running_.weight_s, weight_s = duration_s, decay = 1.0;
  if (options_.window == Window::exponential) {
    const double share = one_minus_exp(duration_s / options_.length_s);
    decay = 1.0 - share;
    kept_s *= decay;
    weight_s = options_.length_s * share;
  }
  const bool is_first = running_.n_samples == 0;
  const double total_s = kept_s + weight_s;
  const double share = weight_s / total_s;
  const double spread_s = kept_s * share;
  for (std::size_t k = 0; k < sample.fields.size(); ++k) {
    const double* const values = sample.fields[k].data();
    double* const mean = running_.mean.data() + k * at(n_points_);
    double* const spread = running_.spread.data() + k * at(n_points_);
    parallel::for_index(exec, n_points_, kPointGrain, [=](std::int64_t i) {
      const double d = values[i] - mean[i];
      mean[i] = is_first ? values[i] : mean[i] + share * d;
      spread[i] = is_first ? 0.0 : decay * spread[i] + spread_s * (d * d);
    });
  }
  running_.weight_s = total_s;
  ++running_.n_samples;
}

void Statistics::close_window() {
  running_.weight_s = options_.length_s;
  std::swap(running_, complete_);
  clear(running_);
  running_.mean.resize(size(), 0.0);
  running_.spread.resize(size(), 0.0);
  ++n_complete_;
}

const Moments& Statistics::moments() const {
  return options_.window == Window::fixed && n_complete_ > 0 ? complete_ : running_;
}

bool Statistics::is_ready() const {
  switch (options_.window) {
    case Window::since_remesh:
      return running_.n_samples > 1;
    case Window::exponential:
      return elapsed_s_ >= options_.length_s;
    case Window::fixed:
      return n_complete_ > 0;
  }
  return false;
}

Array<double> Statistics::variance(parallel::Executor& exec, int field) const {
  Array<double> out;
  out.resize(at(n_points_));
  const Moments& now = moments();
  const double* const spread = now.spread.data() + at(field) * at(n_points_);
  const double weight_s = now.n_samples > 0 ? now.weight_s : 1.0;
  parallel::for_index(exec, n_points_, kPointGrain,
                      [&](std::int64_t i) { out[at(i)] = spread[i] / weight_s; });
  return out;
}

std::span<const double> Statistics::mean(int field) const {
  return {moments().mean.data() + at(field) * at(n_points_), at(n_points_)};
}

void Statistics::move(parallel::Executor& exec, const StatisticsMove& move) {
  DELOS_CHECK(move.n_points > 0, ErrorKind::input, "statistics are moved to ", move.n_points,
              " places");
  const bool is_vector = n_fields_ == 2;
  DELOS_CHECK(
      !is_vector || (move.from.size() == at(n_points_) && move.to.size() == at(move.n_points)),
      ErrorKind::input, "moving a vector needs ", n_points_, " and ", move.n_points,
      " places, not ", move.from.size(), " and ", move.to.size());
  Moments running = running_, complete = complete_;
  const bool is_anew = options_.window == Window::since_remesh;
  if (is_anew) {
    clear(running);
    running.mean.assign(at(n_fields_ * move.n_points), 0.0);
    running.spread.assign(at(n_fields_ * move.n_points), 0.0);
  } else {
    move_moments(exec, move, running);
    move_moments(exec, move, complete);
  }
  // Nothing throws from here on.
  running_ = std::move(running);
  complete_ = std::move(complete);
  n_points_ = move.n_points;
  if (is_anew) elapsed_s_ = 0.0;
}

void Statistics::move_moments(parallel::Executor& exec, const StatisticsMove& move,
                              Moments& moments) const {
  if (moments.mean.empty()) return;
  moments.mean = n_fields_ == 2 ? moved_vector(exec, move, moments.mean)
                                : moved_scalars(move, moments.mean, n_fields_);
  moments.spread = moved_scalars(move, moments.spread, n_fields_);
  // A sum of weights that is 1 within rounding may leave a trace below zero.
  for (double& spread : moments.spread) {
    if (spread < 0.0) spread = 0.0;
  }
}

Array<double> eddy_kinetic_energy(parallel::Executor& exec, const Statistics& velocity) {
  DELOS_CHECK(velocity.n_fields() == 2, ErrorKind::internal,
              "eddy kinetic energy needs statistics of two components, not ", velocity.n_fields());
  Array<double> out = velocity.variance(exec, 0);
  const Array<double> other = velocity.variance(exec, 1);
  parallel::for_index(exec, velocity.n_points(), kPointGrain,
                      [&](std::int64_t i) { out[at(i)] = 0.5 * (out[at(i)] + other[at(i)]); });
  return out;
}

}  // namespace delos
