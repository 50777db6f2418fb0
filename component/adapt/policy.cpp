// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/policy.hpp"

#include <cmath>

#include "core/error.hpp"
#include "time/iso8601.hpp"

namespace delos {
namespace {

/// Cells a task; part of the answer of the sums.
constexpr std::int64_t kCellGrain = 8192;

struct Areas {
  double all = 0.0, coarse = 0.0, fine = 0.0;
};

std::string percent(double share) { return text(std::round(1000.0 * share) / 10.0, " %"); }

/// One reason as the part of a sentence.
std::string clause(Reason reason, const PolicyOptions& options, const PolicyState& state) {
  const auto interval = [&] {
    return text("the last remesh was at ", iso_text(*state.last_remesh), ", less than ",
                iso_text(*options.minimum_interval), " ago");
  };
  switch (reason) {
    case Reason::mismatch:
      return text("above the threshold of ", percent(options.threshold));
    case Reason::no_alarm:
      return "the interval is not over";
    case Reason::no_statistics:
      return "the window of the statistics is not filled";
    case Reason::too_soon:
      return interval();
    case Reason::below_threshold:
      return text("below the threshold of ", percent(options.threshold));
    case Reason::not_rearmed:
      return text("not been below ", percent(options.threshold * (1.0 - options.hysteresis)),
                  " since the last remesh");
  }
  return "";
}

std::string line(const PolicyOptions& options, const PolicyInput& input, const PolicyState& state,
                 const Decision& decision) {
  std::string out = text(decision.remesh ? "remesh" : "no remesh", " at ", iso_text(input.now));
  if (input.has_statistics) {
    out += text(": ", percent(input.mismatch.total()), " of the area is off by more than a factor ",
                options.tau, " (", percent(input.mismatch.too_coarse), " too coarse, ",
                percent(input.mismatch.too_fine), " too fine), ", std::round(input.expected_cells),
                " cells are expected");
  }
  const char* separator = ": ";
  for (const Reason reason : decision.reasons) {
    out += separator + clause(reason, options, state);
    separator = "; ";
  }
  return out;
}

}  // namespace

Array<double> wanted_at_cells(parallel::Executor& exec, const Grid& grid,
                              const SpacingField& wanted) {
  Array<double> out;
  out.resize(at(grid.n_cells()));
  const double scale_m = grid.surface.scale_m();
  parallel::for_range(exec, grid.n_cells(), kCellGrain, [&](std::int64_t begin, std::int64_t end) {
    std::vector<Vertex> places;
    places.reserve(at(end - begin));
    for (std::int64_t cell = begin; cell < end; ++cell) {
      const Vec3& p = grid.cell_position[at(cell)];
      places.push_back({p.x(), p.y(), p.z(), 0.0});
    }
    wanted.evaluate(places);
    for (std::int64_t cell = begin; cell < end; ++cell) {
      out[at(cell)] = places[at(cell - begin)].spacing * scale_m;
    }
  });
  return out;
}

Mismatch mismatch(parallel::Executor& exec, const Grid& grid, std::span<const double> wanted_m,
                  double tau, std::span<const char> is_fixed) {
  DELOS_CHECK(std::isfinite(tau) && tau > 1.0, ErrorKind::config, "tau of the mismatch is ", tau,
              ": it must be > 1");
  DELOS_CHECK(wanted_m.size() == at(grid.n_cells()) &&
                  (is_fixed.empty() || is_fixed.size() == wanted_m.size()),
              ErrorKind::input, "the wanted spacing has ", wanted_m.size(),
              " values, what is fixed ", is_fixed.size(), ", the grid ", grid.n_cells(), " cells");
  const Areas areas = parallel::reduce(
      exec, grid.n_cells(), kCellGrain, Areas{},
      [&](std::int64_t begin, std::int64_t end) {
        Areas sum;
        for (std::int64_t cell = begin; cell < end; ++cell) {
          const std::size_t i = at(cell);
          if (!is_fixed.empty() && is_fixed[i] != 0) continue;
          const double area = grid.cell_area_m2[i], now_m = grid.cell_spacing_m[i];
          sum.all += area;
          if (now_m > tau * wanted_m[i]) sum.coarse += area;
          if (wanted_m[i] > tau * now_m) sum.fine += area;
        }
        return sum;
      },
      [](const Areas& a, const Areas& b) {
        return Areas{a.all + b.all, a.coarse + b.coarse, a.fine + b.fine};
      });
  if (areas.all == 0.0) return {};
  return {areas.coarse / areas.all, areas.fine / areas.all};
}

std::int64_t corrected_budget(std::int64_t cells, std::int64_t n_now, double n_expected) {
  constexpr double kUsual = 0.05;  // smooth spacings come within 3 %
  const double ratio = static_cast<double>(n_now) / n_expected;
  if (!(std::abs(ratio - 1.0) <= kUsual)) return cells;
  return static_cast<std::int64_t>(std::round(static_cast<double>(cells) / ratio));
}

void check(const PolicyOptions& options) {
  const auto is_share = [](double value) { return value >= 0.0 && value <= 1.0; };
  DELOS_CHECK(std::isfinite(options.tau) && options.tau > 1.0, ErrorKind::config,
              "tau of the mismatch is ", options.tau, ": it must be > 1");
  DELOS_CHECK(is_share(options.threshold), ErrorKind::config, "the threshold of the mismatch is ",
              options.threshold, ": it must be from 0 to 1");
  DELOS_CHECK(is_share(options.hysteresis), ErrorKind::config, "the hysteresis is ",
              options.hysteresis, ": it must be from 0 to 1");
  DELOS_CHECK(!options.minimum_interval || options.minimum_interval->is_positive(),
              ErrorKind::config, "the minimum interval between remeshes must lead forward");
}

const char* to_string(Reason reason) {
  constexpr const char* kNames[] = {"mismatch", "no_alarm",        "no_statistics",
                                    "too_soon", "below_threshold", "not_rearmed"};
  return kNames[static_cast<std::size_t>(reason)];
}

Decision decide(const PolicyOptions& options, const PolicyInput& input, PolicyState& state) {
  check(options);
  Decision out;
  const auto add_if = [&](bool holds, Reason reason) {
    if (holds) out.reasons.push_back(reason);
  };
  add_if(!input.alarm_rings, Reason::no_alarm);
  add_if(!input.has_statistics, Reason::no_statistics);
  add_if(state.last_remesh && options.minimum_interval &&
             input.now < *state.last_remesh + *options.minimum_interval,
         Reason::too_soon);
  if (input.has_statistics) {
    const double share = input.mismatch.total();
    out.mismatch = input.mismatch;
    out.expected_cells = input.expected_cells;
    // With hysteresis 0 both bounds are the threshold, and at the threshold it counts as above.
    if (share < options.threshold * (1.0 - options.hysteresis)) state.is_armed = true;
    add_if(share < options.threshold, Reason::below_threshold);
    add_if(share >= options.threshold && !state.is_armed, Reason::not_rearmed);
  }
  out.remesh = out.reasons.empty();
  if (out.remesh) out.reasons.push_back(Reason::mismatch);
  out.text = line(options, input, state, out);
  return out;
}

void note_remesh(const Time& now, PolicyState& state) {
  state.is_armed = false;
  state.last_remesh = now;
}

}  // namespace delos
