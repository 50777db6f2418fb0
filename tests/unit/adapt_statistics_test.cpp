// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/statistics.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

#include "core/hash.hpp"
#include "support/expect_error.hpp"

using namespace delos;

namespace {

constexpr double kDay_s = 86400.0;

/// Sums of a whole series in long double, in two passes.
struct TwoPass {
  long double mean = 0.0L, variance = 0.0L;
};

template <class Value, class Weight>
TwoPass two_pass(int n, const Value& value, const Weight& weight) {
  long double sum_w = 0.0L, sum = 0.0L, squares = 0.0L;
  for (int k = 0; k < n; ++k) {
    sum_w += static_cast<long double>(weight(k));
    sum += static_cast<long double>(weight(k)) * static_cast<long double>(value(k));
  }
  const long double mean = sum / sum_w;
  for (int k = 0; k < n; ++k) {
    const long double d = static_cast<long double>(value(k)) - mean;
    squares += static_cast<long double>(weight(k)) * d * d;
  }
  return {mean, squares / sum_w};
}

/// Value of field `field` at `point` in sample k: a wave of its own, and noise.
double value_at(int k, std::int64_t point, int field = 0) {
  return std::sin(0.01 * k + static_cast<double>(point)) + 0.3 * field +
         uniform01(7, static_cast<std::uint64_t>(k * 1000 + 10 * point + field));
}

double duration_of(int k) { return 600.0 * (1 + k % 5); }

void add(parallel::Executor& exec, Statistics& statistics, int k) {
  std::vector<std::vector<double>> values(at(statistics.n_fields()));
  Sample sample;
  sample.duration_s = duration_of(k);
  for (int field = 0; field < statistics.n_fields(); ++field) {
    for (std::int64_t i = 0; i < statistics.n_points(); ++i) {
      values[at(field)].push_back(value_at(k, i, field));
    }
  }
  for (const auto& field : values) sample.fields.emplace_back(field);
  statistics.add(exec, sample);
}

/// One value at one point.
void add_value(Statistics& statistics, double value, double duration_s) {
  parallel::Executor exec(1);
  statistics.add(exec, {{std::span(&value, 1)}, duration_s});
}

double variance_of(const Statistics& statistics, int field = 0, std::int64_t point = 0) {
  parallel::Executor exec(1);
  return statistics.variance(exec, field)[at(point)];
}

bool same_state(const Statistics& a, const Statistics& b) {
  const StatisticsState x = a.state(), y = b.state();
  const auto same = [](std::span<const double> p, std::span<const double> q) {
    return std::equal(p.begin(), p.end(), q.begin(), q.end());
  };
  return x.counts == y.counts && x.times_s == y.times_s && same(x.mean, y.mean) &&
         same(x.spread, y.spread) && same(x.complete_mean, y.complete_mean) &&
         same(x.complete_spread, y.complete_spread);
}

const StatisticsOptions kWindows[] = {
    {}, {Window::exponential, 5.0 * kDay_s}, {Window::fixed, 3.0 * kDay_s}};

}  // namespace

TEST_CASE("a million samples with a large mean agree with two passes in long double") {
  constexpr int kSamples = 1'000'000;
  constexpr double kLargeMean = 1.0e6;  // sums of squares would lose twelve digits
  const auto value = [](int k) {
    return kLargeMean + uniform01(3, static_cast<std::uint64_t>(k)) - 0.5;
  };
  Statistics statistics({}, 1, 1);
  parallel::Executor exec(1);
  for (int k = 0; k < kSamples; ++k) {
    const double x = value(k);
    statistics.add(exec, {{std::span(&x, 1)}, duration_of(k)});
  }
  const TwoPass exact = two_pass(kSamples, value, duration_of);
  CHECK(std::abs(statistics.mean(0)[0] / static_cast<double>(exact.mean) - 1.0) < 1e-13);
  CHECK(variance_of(statistics) ==
        doctest::Approx(static_cast<double>(exact.variance)).epsilon(1e-10));
}

TEST_CASE("means weigh samples by how long they stood") {
  Statistics statistics({}, 1, 1);
  CHECK(!statistics.is_ready());
  CHECK(variance_of(statistics) == 0.0);
  add_value(statistics, 1.0, 1.0);
  CHECK(!statistics.is_ready());
  CHECK(statistics.mean(0)[0] == 1.0);
  CHECK(variance_of(statistics) == 0.0);
  add_value(statistics, 5.0, 3.0);
  CHECK(statistics.is_ready());
  CHECK(statistics.mean(0)[0] == 4.0);
  CHECK(variance_of(statistics) == 3.0);  // (9 + 3 * 1) / 4
}

TEST_CASE("an exponential window weighs the past by its age") {
  constexpr int kSamples = 400;
  constexpr double kLength_s = 20.0 * 600.0;
  Statistics statistics({Window::exponential, kLength_s}, 1, 1);
  double end_s = 0.0;
  for (int k = 0; k < kSamples; ++k) {
    CHECK(statistics.is_ready() == (end_s >= kLength_s));
    add_value(statistics, value_at(k, 0), duration_of(k));
    end_s += duration_of(k);
  }
  std::vector<double> begin_s(kSamples + 1, 0.0);
  for (int k = 0; k < kSamples; ++k) begin_s[at(k + 1)] = begin_s[at(k)] + duration_of(k);
  const auto weight = [&](int k) {
    return std::exp((begin_s[at(k + 1)] - end_s) / kLength_s) -
           std::exp((begin_s[at(k)] - end_s) / kLength_s);
  };
  const TwoPass exact = two_pass(
      kSamples, [](int k) { return value_at(k, 0); }, weight);
  CHECK(statistics.mean(0)[0] == doctest::Approx(static_cast<double>(exact.mean)).epsilon(1e-12));
  CHECK(variance_of(statistics) ==
        doctest::Approx(static_cast<double>(exact.variance)).epsilon(1e-12));
}

TEST_CASE("a value that stands twice as long counts as two") {
  for (const StatisticsOptions& options : kWindows) {
    CAPTURE(std::string(to_string(options.window)));
    Statistics once(options, 1, 1), twice(options, 1, 1);
    for (int k = 0; k < 500; ++k) {
      add_value(once, value_at(k, 0), 3600.0);
      add_value(twice, value_at(k, 0), 1200.0);
      add_value(twice, value_at(k, 0), 2400.0);
    }
    CHECK(once.mean(0)[0] == doctest::Approx(twice.mean(0)[0]).epsilon(1e-12));
    CHECK(variance_of(once) == doctest::Approx(variance_of(twice)).epsilon(1e-12));
  }
}

TEST_CASE("a fixed window is used when it is full and begins anew") {
  Statistics statistics({Window::fixed, 4.0}, 1, 1);
  add_value(statistics, 1.0, 3.0);
  CHECK(!statistics.is_ready());
  add_value(statistics, 5.0, 3.0);  // 1 s of it completes the first stretch
  CHECK(statistics.is_ready());
  CHECK(statistics.n_complete() == 1);
  CHECK(statistics.mean(0)[0] == 2.0);
  CHECK(variance_of(statistics) == 3.0);
  add_value(statistics, 9.0, 1.0);
  CHECK(statistics.mean(0)[0] == 2.0);  // the second has 3 s only
  add_value(statistics, 9.0, 1.0);
  CHECK(statistics.n_complete() == 2);
  CHECK(statistics.mean(0)[0] == 7.0);
  CHECK(variance_of(statistics) == 4.0);
}

TEST_CASE("a sample that fills many fixed windows ends in the right one") {
  Statistics statistics({Window::fixed, 4.0}, 1, 1);
  add_value(statistics, 1.0, 1.0);
  add_value(statistics, 3.0, 3.0 + 40.0 + 2.0);
  CHECK(statistics.n_complete() == 11);
  CHECK(statistics.mean(0)[0] == 3.0);
  CHECK(variance_of(statistics) == 0.0);
  add_value(statistics, 7.0, 2.0);
  CHECK(statistics.n_complete() == 12);
  CHECK(statistics.mean(0)[0] == 5.0);
}

TEST_CASE("a restart at any sample goes on to the same bits") {
  parallel::Executor exec(2);
  for (const StatisticsOptions& options : kWindows) {
    CAPTURE(std::string(to_string(options.window)));
    Statistics straight(options, 2, 50);
    Statistics restarted = straight;
    for (int k = 0; k < 300; ++k) {
      add(exec, straight, k);
      restarted = Statistics::restored(options, restarted.state());
      add(exec, restarted, k);
    }
    CHECK(same_state(straight, restarted));
    CHECK(straight.is_ready() == restarted.is_ready());
  }
}

TEST_CASE("a state of other statistics is refused") {
  parallel::Executor exec(1);
  Statistics statistics(kWindows[2], 2, 3);
  const auto refused = [&](auto&& change, const std::string& part) {
    StatisticsState state = statistics.state();
    change(state);
    testing::expect_error(ErrorKind::input, {part},
                          [&] { Statistics::restored(kWindows[2], state); });
  };
  refused([](StatisticsState& s) { s.counts.pop_back(); }, "5 counts");
  refused([](StatisticsState& s) { s.counts[0] = 0; }, "another window than fixed");
  refused([](StatisticsState& s) { s.times_s[0] = 7.0; }, "keep the settings");
  refused([](StatisticsState& s) { s.counts[1] = 0; }, "0 fields");
  refused([](StatisticsState& s) { s.counts[2] = 4; }, "8 values");
  refused([](StatisticsState& s) { s.counts[5] = 1; }, "6 values");
  refused([](StatisticsState& s) { s.counts[3] = -1; }, "negative");
  refused([](StatisticsState& s) { s.times_s[2] = std::nan(""); }, "infinite");
}

TEST_CASE("any number of threads gives the same bits") {
  for (const StatisticsOptions& options : kWindows) {
    Statistics one(options, 2, 20000);
    for (const int threads : {1, 2, 5, 8}) {
      parallel::Executor exec(threads);
      Statistics many(options, 2, 20000);
      for (int k = 0; k < 12; ++k) add(exec, many, k);
      if (threads == 1) one = many;
      CHECK(same_state(one, many));
      CHECK(eddy_kinetic_energy(exec, one) == eddy_kinetic_energy(exec, many));
    }
  }
}

TEST_CASE("a value that is no number is refused with its place, and nothing changes") {
  parallel::Executor exec(2);
  Statistics statistics({}, 2, 3);
  add(exec, statistics, 0);
  const Statistics before = statistics;
  const std::vector<double> good{1.0, 2.0, 3.0};
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    const std::vector<double> values{1.0, 2.0, bad};
    Sample sample{{good, values}, 60.0};
    sample.place = [](std::int64_t i) { return text("cell ", i, " (lon 3, lat 4 deg)"); };
    testing::expect_error(ErrorKind::input, {"field 1", "cell 2 (lon 3, lat 4 deg)", "finite"},
                          [&] { statistics.add(exec, sample); });
  }
  testing::expect_error(ErrorKind::input, {"1 fields", "have 2"}, [&] {
    statistics.add(exec, {{good}, 60.0});
  });
  testing::expect_error(ErrorKind::input, {"0 s"}, [&] {
    statistics.add(exec, {{good, good}, 0.0});
  });
  testing::expect_error(ErrorKind::input, {"2 values", "3 places"}, [&] {
    statistics.add(exec, {{good, std::span(good).first(2)}, 60.0});
  });
  CHECK(same_state(before, statistics));
}

TEST_CASE("where values may miss, the place has no mean and the others do") {
  parallel::Executor exec(1);
  Statistics statistics({}, 1, 2);
  const std::vector<double> coast{std::nan(""), 2.0}, other{1.0, 4.0};
  for (const auto* values : {&coast, &other}) {
    Sample sample{{*values}, 60.0};
    sample.may_miss = true;
    statistics.add(exec, sample);
  }
  CHECK(std::isnan(statistics.mean(0)[0]));
  CHECK(statistics.mean(0)[1] == 3.0);
  CHECK(variance_of(statistics, 0, 1) == 1.0);
  const std::vector<double> infinite{1.0, std::numeric_limits<double>::infinity()};
  Sample sample{{infinite}, 60.0};
  sample.may_miss = true;
  testing::expect_error(ErrorKind::input, {"inf"}, [&] { statistics.add(exec, sample); });
}

TEST_CASE("windows need a length, statistics places") {
  for (const double length_s : {0.0, -1.0, std::nan("")}) {
    testing::expect_error(ErrorKind::config, {"exponential", "> 0"}, [&] {
      Statistics({Window::exponential, length_s}, 1, 1);
    });
  }
  testing::expect_error(ErrorKind::config, {"0 places"}, [] { Statistics({}, 1, 0); });
}

TEST_CASE("eddy kinetic energy is half the sum of the variances") {
  parallel::Executor exec(1);
  Statistics statistics({}, 2, 1);
  const double u[] = {1.0, 3.0}, v[] = {-2.0, 2.0};
  for (int k = 0; k < 2; ++k) {
    statistics.add(exec, {{std::span(&u[k], 1), std::span(&v[k], 1)}, 60.0});
  }
  CHECK(eddy_kinetic_energy(exec, statistics)[0] == 2.5);
}

TEST_CASE("moving to other places keeps vectors and what is left of the window") {
  parallel::Executor exec(1);
  // Two places; the new ones are the same in the other order, and one at the far side of a pole,
  // where east and north point the other way.
  const std::vector<LonLat> from{{0.0, 1.5}, {1.0, 0.2}};
  const std::vector<LonLat> to{{1.0, 0.2}, {0.0, 1.5}, {kPi, 1.5}};
  StatisticsMove move{3, {}, from, to};
  move.field = [](std::span<const double> old, std::span<double> now) {
    now[0] = old[1];
    now[1] = now[2] = old[0];
  };
  for (const StatisticsOptions& options : kWindows) {
    CAPTURE(std::string(to_string(options.window)));
    Statistics statistics(options, 2, 2);
    for (int k = 0; k < 300; ++k) add(exec, statistics, k);
    const Statistics before = statistics;
    statistics.move(exec, move);
    CHECK(statistics.n_points() == 3);
    if (options.window == Window::since_remesh) {
      CHECK(!statistics.is_ready());
      CHECK(statistics.moments().weight_s == 0.0);
      continue;
    }
    CHECK(statistics.is_ready());
    CHECK(statistics.moments().weight_s == before.moments().weight_s);
    for (int field = 0; field < 2; ++field) {
      CHECK(statistics.mean(field)[0] == doctest::Approx(before.mean(field)[1]).epsilon(1e-14));
      CHECK(statistics.mean(field)[1] == doctest::Approx(before.mean(field)[0]).epsilon(1e-14));
    }
    // From one side of the pole, 8 degrees across: turned by half a turn, a little shorter.
    CHECK(statistics.mean(0)[2] == doctest::Approx(-before.mean(0)[0]).epsilon(1e-12));
    CHECK(statistics.mean(1)[2] ==
          doctest::Approx(-before.mean(1)[0] * std::cos(kPi - 3.0)).epsilon(1e-12));
    CHECK(eddy_kinetic_energy(exec, statistics)[2] ==
          doctest::Approx(eddy_kinetic_energy(exec, before)[0]).epsilon(1e-15));
    add(exec, statistics, 300);
  }
  Statistics statistics(kWindows[1], 2, 2);
  move.to = {};
  testing::expect_error(ErrorKind::input, {"needs 2 and 3 places"},
                        [&] { statistics.move(exec, move); });
}

TEST_CASE("1 - exp(-x) has no cancellation") {
  constexpr double kUlp = std::numeric_limits<double>::epsilon();
  CHECK(one_minus_exp(0.0) == 0.0);
  double worst = 0.0;
  for (int k = 0; k < 20000; ++k) {
    const double x = std::pow(10.0, 3.0 - 20.0 * uniform01(11, static_cast<std::uint64_t>(k)));
    const long double exact = -std::expm1(-static_cast<long double>(x));
    const long double error = std::abs(static_cast<long double>(one_minus_exp(x)) - exact) / exact;
    worst = std::max(worst, static_cast<double>(error));
  }
  CHECK(worst < 2.0 * kUlp);
}
