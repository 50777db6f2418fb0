// SPDX-License-Identifier: BSD-3-Clause
// Gaussian smoothing: a Gaussian of standard deviation sigma is the heat kernel at time
// sigma^2 / 2. Implicit steps split by direction need no care at the poles, where the columns
// crowd: every step is a weighted mean with weights >= 0 and conserves the area integral.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "sizing/nodes.hpp"
#include "sizing/raster.hpp"

namespace delos {
namespace {

/// Backward Euler has the right variance for any number of steps; with 4 the kernel's shape is
/// near the Gaussian's (excess kurtosis 3 / 4 instead of 3).
constexpr int kSteps = 4;
static_assert(kSteps % 2 == 0, "run() takes steps by twos");
/// Rows or columns solved side by side: along one line each division waits for the last, so others
/// fill the gaps.
constexpr std::size_t kLanes = 8;
/// Columns of a task: a row of a table is some pages long, so what is read of it should be some
/// cache lines.
constexpr std::size_t kColumnGroups = 4;
constexpr std::int64_t kColumnGrain = kColumnGroups * kLanes;
/// Rows of a task, whose memory serves one group of lines after the other.
constexpr std::int64_t kRowsOfTask = 4 * kLanes;
/// Nodes of each row that change places with lanes at a time: they stay in the first-level cache.
constexpr Index kPatch = 16;

/// Two numbers in a register of every machine of 64 bits (an extension that GCC and Clang share).
using Pair = double __attribute__((vector_size(2 * sizeof(double))));

using Mask = std::int64_t __attribute__((vector_size(2 * sizeof(std::int64_t))));

/// Numbers that are added, multiplied and divided each with its like. GCC 12 makes scalar code of
/// loops over an array's elements, and keeps vectors wider than a register in memory.
struct Lanes {
  Lanes() = default;
  explicit Lanes(double value) { pairs.fill(Pair{value, value}); }
  double at(std::size_t lane) const { return pairs[lane / 2][lane % 2]; }
  void set(std::size_t lane, double value) { pairs[lane / 2][lane % 2] = value; }
  std::array<Pair, kLanes / 2> pairs{};
};

template <class Operation>
Lanes for_pairs(const Lanes& a, const Lanes& b, Operation operation) {
  Lanes c;
  for (std::size_t k = 0; k < c.pairs.size(); ++k) c.pairs[k] = operation(a.pairs[k], b.pairs[k]);
  return c;
}

Lanes operator+(const Lanes& a, const Lanes& b) {
  return for_pairs(a, b, [](const Pair& x, const Pair& y) { return x + y; });
}
Lanes operator-(const Lanes& a, const Lanes& b) {
  return for_pairs(a, b, [](const Pair& x, const Pair& y) { return x - y; });
}
Lanes operator*(const Lanes& a, const Lanes& b) {
  return for_pairs(a, b, [](const Pair& x, const Pair& y) { return x * y; });
}
Lanes operator/(const Lanes& a, const Lanes& b) {
  return for_pairs(a, b, [](const Pair& x, const Pair& y) { return x / y; });
}

/// Lines of n unknowns side by side: (mass_k + link_{k-1} + link_k) x_k - link_{k-1} x_{k-1}
/// - link_k x_{k+1} = mass_k d_k, where link_k ties k to k + 1; the last link of a ring ties its
/// last unknown to its first.
struct Lines {
  explicit Lines(std::size_t n) : x(n), link(n) {}
  std::vector<Lanes> x;  ///< d before solving, then the unknowns
  std::vector<Lanes> link;
};

/// The numbers where the mask is set, 0 elsewhere.
Pair only_where(const Mask& mask, const Pair& numbers) {
  return std::bit_cast<Pair>(mask & std::bit_cast<Mask>(numbers));
}

/// Puts 0 for what is missing and cuts its links; `link_of(k)` says how strong link k is.
template <class LinkOf>
void tie(LinkOf&& link_of, Lines& lines) {
  const std::size_t n = lines.x.size();
  const Lanes first = lines.x[0];
  for (std::size_t k = 0; k < n; ++k) {
    const Lanes& next = k + 1 < n ? lines.x[k + 1] : first;
    const Lanes link = link_of(k);
    for (std::size_t p = 0; p < next.pairs.size(); ++p) {
      const Pair here = lines.x[k].pairs[p], there = next.pairs[p];
      const Mask is_valid = here == here;  // false for NaN alone
      lines.link[k].pairs[p] = only_where(is_valid & (there == there), link.pairs[p]);
      lines.x[k].pairs[p] = only_where(is_valid, here);
    }
  }
}

/// Gauss's elimination for all lines at once; its factors serve any number of right sides.
class Solver {
 public:
  explicit Solver(const std::vector<double>& mass)
      : next_(mass.size()), diagonal_(mass.size()), z_(mass.size()) {
    for (const double m : mass) mass_.emplace_back(m);
  }

  void solve_chains(int n_times, Lines& lines);
  void solve_rings(int n_times, Lines& lines);

 private:
  void factorise(const std::vector<Lanes>& link, std::size_t n, const Lanes& before);
  void factorise_rings(const std::vector<Lanes>& link);
  void solve(const std::vector<Lanes>& link, std::size_t n, std::vector<Lanes>& x) const;

  std::vector<Lanes> mass_;
  std::vector<Lanes> next_, diagonal_;  ///< x_k = y_k + next_k x_{k+1}
  std::vector<Lanes> z_;                ///< x_k = y_k + z_k x_last on a ring
};

/// Elimination from the first of n unknowns on; `before` ties the first to what is kept aside.
void Solver::factorise(const std::vector<Lanes>& link, std::size_t n, const Lanes& before) {
  Lanes west = before, product;
  for (std::size_t k = 0; k < n; ++k) {
    const Lanes east = link[k];
    diagonal_[k] = mass_[k] + west + east - product;
    next_[k] = east / diagonal_[k];
    product = east * next_[k];
    west = east;
  }
}

void Solver::solve(const std::vector<Lanes>& link, std::size_t n, std::vector<Lanes>& x) const {
  Lanes value = mass_[0] * x[0] / diagonal_[0];
  x[0] = value;
  for (std::size_t k = 1; k < n; ++k) {
    value = (mass_[k] * x[k] + link[k - 1] * value) / diagonal_[k];
    x[k] = value;
  }
  for (std::size_t k = n - 1; k-- > 0;) {
    value = x[k] + next_[k] * value;
    x[k] = value;
  }
}

void Solver::solve_chains(int n_times, Lines& lines) {
  factorise(lines.link, lines.x.size(), Lanes());
  for (int k = 0; k < n_times; ++k) solve(lines.link, lines.x.size(), lines.x);
}

/// The last unknown is kept aside, and z holds what the others take from it.
void Solver::factorise_rings(const std::vector<Lanes>& link) {
  const std::size_t last = link.size() - 1;
  const Lanes closing = link[last], west = link[last - 1];
  factorise(link, last, closing);
  std::fill(z_.begin(), z_.end(), Lanes());
  z_[0] = closing;
  z_[last - 1] = z_[last - 1] + west;
  solve(link, last, z_);
  diagonal_[last] = mass_[last] + west + closing - west * z_[last - 1] - closing * z_[0];
}

void Solver::solve_rings(int n_times, Lines& lines) {
  factorise_rings(lines.link);
  std::vector<Lanes>& x = lines.x;
  const std::size_t last = x.size() - 1;
  const Lanes closing = lines.link[last], west = lines.link[last - 1];
  for (int time = 0; time < n_times; ++time) {
    solve(lines.link, last, x);
    const Lanes end =
        (mass_[last] * x[last] + west * x[last - 1] + closing * x[0]) / diagonal_[last];
    x[last] = end;
    for (std::size_t k = 0; k < last; ++k) x[k] = x[k] + z_[k] * end;
  }
}

struct Workspace {
  std::vector<Lines> groups;
  Solver solver;
};

/// One for each thread, made when first asked for: memory given back and asked for again with
/// every task would come from the system each time.
class Workspaces {
 public:
  Workspaces(const parallel::Executor& exec, const std::vector<double>& mass, std::size_t n_groups)
      : exec_(exec),
        mass_(mass),
        n_groups_(n_groups),
        of_thread_(static_cast<std::size_t>(exec.n_threads())) {}
  Workspace& mine() {
    std::optional<Workspace>& work = of_thread_[static_cast<std::size_t>(exec_.thread_slot())];
    if (!work) work = Workspace{std::vector<Lines>(n_groups_, Lines(mass_.size())), Solver(mass_)};
    return *work;
  }

 private:
  const parallel::Executor& exec_;
  const std::vector<double> mass_;
  std::size_t n_groups_;
  std::vector<std::optional<Workspace>> of_thread_;
};

class Smoother {
 public:
  Smoother(parallel::Executor& exec, double time, LatLonField& field);

  /// Rows, columns; columns, rows; and so on: the error of splitting is of second order, and two
  /// steps along the same lines share the elimination.
  void run() {
    diffuse_rows(1);
    for (int step = 2; step < kSteps; step += 2) {
      diffuse_columns(2);
      diffuse_rows(2);
    }
    diffuse_columns(2);
    diffuse_rows(1);
    unify_poles(field_);
  }

 private:
  void diffuse_rows(int n_times);
  void diffuse_columns(int n_times);
  void load_rows(Index begin, Index end, Lines& lines) const;
  void store_rows(Index begin, Index end, const Lines& lines);
  void load_columns(Index row, Index begin, Index end, Lines& lines) const;
  void store_columns(Index row, Index begin, Index end, const Lines& lines);
  Lanes row_links(Index begin, Index end) const;
  void mix_pole(Index row);

  parallel::Executor& exec_;
  LatLonField& field_;
  double time_;
  std::vector<double> cos_, cos_north_, area_;
};

Smoother::Smoother(parallel::Executor& exec, double time, LatLonField& field)
    : exec_(exec), field_(field), time_(time) {
  const Index last = field.n_lat_cells;
  const double step = kPi / last;
  for (Index j = 0; j <= last; ++j) {
    const double south = std::max(field.lat_rad(j) - 0.5 * step, -0.5 * kPi);
    const double north = std::min(field.lat_rad(j) + 0.5 * step, 0.5 * kPi);
    cos_.push_back(elementary::cos(field.lat_rad(j)));
    cos_north_.push_back(j < last ? elementary::cos(north) : 0.0);
    area_.push_back(elementary::sin(north) - elementary::sin(south));
  }
}

void Smoother::mix_pole(Index row) {
  double* x = field_.values.data() + field_.at(row, 0);
  double sum = 0.0;
  Index n = 0;
  for (Index i = 0; i < field_.n_lon; ++i) {
    if (std::isnan(x[i])) continue;
    sum += x[i];
    ++n;
  }
  for (Index i = 0; i < field_.n_lon; ++i) {
    if (!std::isnan(x[i])) x[i] = sum / n;
  }
}

/// Rows [begin, end), one a lane, no more than there are lanes.
void Smoother::load_rows(Index begin, Index end, Lines& lines) const {
  for (Index from = 0; from < field_.n_lon; from += kPatch) {
    const Index to = std::min(from + kPatch, field_.n_lon);
    for (Index row = begin; row < end; ++row) {
      const double* x = field_.values.data() + field_.at(row, 0);
      const auto lane = static_cast<std::size_t>(row - begin);
      for (Index i = from; i < to; ++i) lines.x[static_cast<std::size_t>(i)].set(lane, x[i]);
    }
  }
}

/// What is missing stays missing.
void Smoother::store_rows(Index begin, Index end, const Lines& lines) {
  for (Index from = 0; from < field_.n_lon; from += kPatch) {
    const Index to = std::min(from + kPatch, field_.n_lon);
    for (Index row = begin; row < end; ++row) {
      double* x = field_.values.data() + field_.at(row, 0);
      const auto lane = static_cast<std::size_t>(row - begin);
      for (Index i = from; i < to; ++i) {
        x[i] = std::isnan(x[i]) ? x[i] : lines.x[static_cast<std::size_t>(i)].at(lane);
      }
    }
  }
}

Lanes Smoother::row_links(Index begin, Index end) const {
  Lanes link;
  for (Index row = begin; row < end; ++row) {
    const double step = 2.0 * kPi / field_.n_lon * cos_[static_cast<std::size_t>(row)];
    link.set(static_cast<std::size_t>(row - begin), time_ / (kSteps * step * step));
  }
  return link;
}

void Smoother::diffuse_rows(int n_times) {
  const Index last = field_.n_lat_cells;
  for (int k = 0; k < n_times; ++k) {
    mix_pole(0);
    mix_pole(last);
  }
  const auto n = static_cast<std::size_t>(field_.n_lon);
  Workspaces workspaces(exec_, std::vector<double>(n, 1.0), 1);
  parallel::for_range(exec_, last - 1, kRowsOfTask, [&](std::int64_t from, std::int64_t to) {
    Workspace& work = workspaces.mine();
    Lines& lines = work.groups[0];
    constexpr auto kWidth = static_cast<Index>(kLanes);
    for (Index begin = static_cast<Index>(from) + 1; begin <= to; begin += kWidth) {
      const Index end = std::min(begin + kWidth, static_cast<Index>(to) + 1);
      load_rows(begin, end, lines);
      tie([link = row_links(begin, end)](std::size_t) { return link; }, lines);
      work.solver.solve_rings(n_times, lines);
      store_rows(begin, end, lines);
    }
  });
}

/// Row `row` of the columns [begin, end), one a lane.
void Smoother::load_columns(Index row, Index begin, Index end, Lines& lines) const {
  const double* x = field_.values.data() + field_.at(row, begin);
  Lanes& to = lines.x[static_cast<std::size_t>(row)];
  const auto width = static_cast<std::size_t>(end - begin);
  for (std::size_t lane = 0; lane < width; ++lane) to.set(lane, x[lane]);
}

void Smoother::store_columns(Index row, Index begin, Index end, const Lines& lines) {
  double* x = field_.values.data() + field_.at(row, begin);
  const Lanes& from = lines.x[static_cast<std::size_t>(row)];
  const auto width = static_cast<std::size_t>(end - begin);
  for (std::size_t lane = 0; lane < width; ++lane) {
    x[lane] = std::isnan(x[lane]) ? x[lane] : from.at(lane);
  }
}

void Smoother::diffuse_columns(int n_times) {
  const Index n = field_.n_rows();
  const double step = time_ / kSteps * n / kPi;
  const auto link_of = [&](std::size_t row) { return Lanes(step * cos_north_[row]); };
  Workspaces workspaces(exec_, area_, kColumnGroups);
  parallel::for_range(exec_, field_.n_lon, kColumnGrain, [&](std::int64_t from, std::int64_t to) {
    Workspace& work = workspaces.mine();
    const auto for_groups = [&](auto&& body) {
      constexpr auto kWidth = static_cast<Index>(kLanes);
      std::size_t group = 0;
      for (auto begin = static_cast<Index>(from); begin < to; begin += kWidth) {
        body(begin, std::min(begin + kWidth, static_cast<Index>(to)), work.groups[group++]);
      }
    };
    for (Index row = 0; row < n; ++row) {
      for_groups([&](Index i, Index j, Lines& lines) { load_columns(row, i, j, lines); });
    }
    for_groups([&](Index, Index, Lines& lines) {
      tie(link_of, lines);
      work.solver.solve_chains(n_times, lines);
    });
    for (Index row = 0; row < n; ++row) {
      for_groups([&](Index i, Index j, Lines& lines) { store_columns(row, i, j, lines); });
    }
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
