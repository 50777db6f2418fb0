// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/gradient_limit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.hpp"
#include "sizing/nodes.hpp"

namespace delos {
namespace {

/// Rows and columns of a tile: its values fill about half of a second-level cache.
constexpr Index kTileRows = 64;
constexpr Index kTileColumns = 256;
/// Rows round a pole that are swept as whole rings, because slopes run along their short steps.
constexpr Index kPolarRows = 48;
/// |grad h|^2 may exceed slope^2 by this much: far below the scheme's error, far above rounding.
constexpr double kSlack = 1.0e-8;
/// Relative error of the kernels for skew steps, some hundred roundings.
constexpr double kRounding = 1.0e-13;

struct Tile {
  Index row_begin, row_end, column_begin, column_end;
  int colour;  ///< tiles of one colour share no side
};

/// Sides of a tile whose values changed.
struct Sides {
  bool south = false, north = false, west = false, east = false;
  std::int64_t n_updates = 0;
  bool any() const { return n_updates > 0; }
};

/// Value at which |grad u| = slope, from the lower neighbour in each direction at the distances dx
/// and dy (Godunov's upwind scheme; Osher & Sethian 1988): both sides or one.
inline double upwind(double a, double b, double dx, double dy, double slope) {
  if (a + slope * dx <= b) return a + slope * dx;
  if (b + slope * dy <= a) return b + slope * dy;
  const double wa = 1.0 / (dx * dx), wb = 1.0 / (dy * dy), sum = wa + wb;
  const double square = sum * slope * slope - wa * wb * (a - b) * (a - b);
  return (wa * a + wb * b + std::sqrt(std::max(square, 0.0))) / sum;
}

/// The steps from a node to two of its neighbours and the cosine of the angle between them.
struct Corner {
  double dx, dy, cosine;
};

/// The same when the steps meet at an angle: within the triangle of the node and its neighbours a
/// and b the slope of the linear h is `slope`; the front must come from inside the triangle,
/// else it came along one of the sides.
inline double upwind_skew(double a, double b, const Corner& corner, double slope) {
  const auto [dx, dy, cosine] = corner;
  const double along = std::min(a + slope * dx, b + slope * dy);
  const double sine2 = 1.0 - cosine * cosine;
  const double wa = 1.0 / (dx * dx * sine2), wb = 1.0 / (dy * dy * sine2);
  const double wc = -cosine / (dx * dy * sine2);
  const double sum = wa + wb + 2.0 * wc;
  const double half = wa * a + wb * b + wc * (a + b);
  const double rest = wa * a * a + wb * b * b + 2.0 * wc * a * b - slope * slope;
  const double square = half * half - sum * rest;
  if (!(square >= 0.0)) return along;
  const double u = (half + std::sqrt(square)) / sum;
  const bool is_inside =
      wa * (u - a) + wc * (u - b) >= 0.0 && wb * (u - b) + wc * (u - a) >= 0.0 && u > a && u > b;
  return is_inside ? std::min(u, along) : along;
}

/// False when upwind_skew() is certainly not below v: v is within reach along both sides, and
/// |grad|^2 of the linear h with v at the node is below slope^2 by more than upwind_skew() may err.
/// Everything is multiplied by dx^2 dy^2 sin^2, so that nothing is divided.
inline bool may_be_below(double v, double a, double b, const Corner& corner, double slope) {
  const auto [dx, dy, cosine] = corner;
  if (v > a + slope * dx || v > b + slope * dy) return true;
  if (v <= a || v <= b) return false;
  const double xx = dx * dx, yy = dy * dy, xy = cosine * dx * dy, p = v - a, q = v - b;
  const double gradient2 = yy * p * p + xx * q * q - 2.0 * xy * p * q;
  const double sum = xx + yy - 2.0 * xy, most = xx + yy + 2.0 * std::abs(xy);
  const double bound = slope * slope * xx * yy * (1.0 - cosine * cosine) * (1.0 - kRounding);
  return gradient2 * sum + kRounding * most * most * v * v > bound * sum;
}

class Limiter {
 public:
  Limiter(TableMetric metric, double slope, LatLonField& field)
      : slope_(slope),
        field_(field),
        n_lon_(field.n_lon),
        last_row_(field.n_lat_cells),
        metric_(std::move(metric)) {
    build_tiles();
  }

  GradientLimitReport run(Context& context);

 private:
  void build_tiles();
  void mark_neighbours(std::size_t tile, const Sides& sides);
  Sides limit_tile(const Tile& tile);
  bool limit_row(const Tile& tile, Index row, Sides& sides);
  bool limit_pole(Index pole, Sides& sides);
  bool limit_node(Index row, Index column);
  template <bool kForward>
  std::int64_t sweep_row(const Tile& tile, Index row, Sides& sides);
  double* row(Index j) { return field_.values.data() + field_.at(j, 0); }

  double slope_;
  LatLonField& field_;
  Index n_lon_, last_row_;
  TableMetric metric_;
  std::vector<Tile> tiles_;
  Index n_tile_columns_ = 1, n_tile_rows_ = 0;  ///< of the tiles between the polar ones
  std::vector<char> is_due_;
};

void Limiter::build_tiles() {
  const Index polar = std::min(kPolarRows, (last_row_ + 1) / 2);
  const Index south = polar, north = last_row_ + 1 - polar;  // rows between the polar tiles
  const Index n_rows = north - south;
  // An even number of columns of tiles, so that two colours go round.
  n_tile_columns_ = std::max<Index>(2, n_lon_ / (2 * kTileColumns) * 2);
  n_tile_rows_ = (n_rows + kTileRows - 1) / kTileRows;
  const bool is_apart = n_tile_rows_ > 0;
  // A checkerboard. The odd tiles beside the polar ones come first, so that the two polar tiles,
  // some ten times as long as others, are swept together with all the other odd ones.
  const auto colour_of = [&](Index r, Index c) {
    const bool is_beside_polar = r == 0 || r == n_tile_rows_ - 1;
    return (r + c) % 2 == 0 ? 0 : is_beside_polar ? 1 : 2;
  };
  tiles_.push_back({0, south, 0, n_lon_, 2});
  for (Index r = 0; r < n_tile_rows_; ++r) {
    for (Index c = 0; c < n_tile_columns_; ++c) {
      tiles_.push_back({south + n_rows * r / n_tile_rows_, south + n_rows * (r + 1) / n_tile_rows_,
                        static_cast<Index>(std::int64_t{n_lon_} * c / n_tile_columns_),
                        static_cast<Index>(std::int64_t{n_lon_} * (c + 1) / n_tile_columns_),
                        colour_of(r, c)});
    }
  }
  tiles_.push_back({south + n_rows, last_row_ + 1, 0, n_lon_, is_apart ? 2 : 3});
  is_due_.assign(tiles_.size(), 1);
}

void Limiter::mark_neighbours(std::size_t tile, const Sides& sides) {
  const std::size_t last = tiles_.size() - 1;
  const auto columns = static_cast<std::size_t>(n_tile_columns_);
  if (n_tile_rows_ == 0) {
    is_due_[last - tile] = is_due_[last - tile] || sides.north || sides.south;
    return;
  }
  if (tile == 0 || tile == last) {
    const std::size_t begin = tile == 0 ? 1 : last - columns;
    if (tile == 0 ? sides.north : sides.south) {
      std::fill_n(is_due_.begin() + static_cast<std::ptrdiff_t>(begin), columns, 1);
    }
    return;
  }
  const std::size_t c = (tile - 1) % columns, row_begin = tile - c;
  if (sides.west) is_due_[row_begin + (c + columns - 1) % columns] = 1;
  if (sides.east) is_due_[row_begin + (c + 1) % columns] = 1;
  if (sides.south) is_due_[tile > columns ? tile - columns : 0] = 1;
  if (sides.north) is_due_[std::min(tile + columns, last)] = 1;
}

/// One direction along a row, in place: a lowered node lowers the next one at once.
template <bool kForward>
std::int64_t Limiter::sweep_row(const Tile& tile, Index j, Sides& sides) {
  double* here = row(j);
  const double* below = row(j - 1);
  const double* above = row(j + 1);
  const auto at = static_cast<std::size_t>(j);
  const double dx = metric_.dx[at], dy = metric_.dy[at], slope = slope_;
  const double inverse_dx = 1.0 / dx, inverse_dy = 1.0 / dy;
  const double limit = slope * slope * (1.0 + kSlack);
  const Index n = tile.column_end - tile.column_begin;
  std::int64_t n_updates = 0;
  for (Index k = 0; k < n; ++k) {
    const Index i = kForward ? tile.column_begin + k : tile.column_end - 1 - k;
    const double west = here[i == 0 ? n_lon_ - 1 : i - 1];
    const double east = here[i + 1 == n_lon_ ? 0 : i + 1];
    const double a = std::min(west, east), b = std::min(below[i], above[i]), u = here[i];
    const double p = std::max(u - a, 0.0) * inverse_dx, q = std::max(u - b, 0.0) * inverse_dy;
    if (p * p + q * q <= limit) continue;
    const double lowered = upwind(a, b, dx, dy, slope);
    if (!(lowered < u)) continue;
    here[i] = lowered;
    ++n_updates;
    sides.west = sides.west || i == tile.column_begin;
    sides.east = sides.east || i + 1 == tile.column_end;
  }
  return n_updates;
}

bool Limiter::limit_node(Index j, Index i) {
  const Index west = i == 0 ? n_lon_ - 1 : i - 1, east = i + 1 == n_lon_ ? 0 : i + 1;
  const std::size_t node = field_.at(j, i);
  const double dx = metric_.dx[node], dy = metric_.dy[node], cosine = metric_.cosine[node];
  const double* here = row(j);
  const double s = row(j - 1)[i], n = row(j + 1)[i], e = here[east], w = here[west], u = here[i];
  // Along the shorter step the slack of the other kernel, as a length.
  const double enough = u - kSlack * slope_ * std::min(dx, dy);
  const double v = enough + kRounding * u;
  double best = enough;
  const auto try_corner = [&](double a, double b, double cosine_between) {
    const Corner corner{dx, dy, cosine_between};
    if (may_be_below(v, a, b, corner, slope_)) {
      best = std::min(best, upwind_skew(a, b, corner, slope_));
    }
  };
  try_corner(e, n, cosine);
  try_corner(w, n, -cosine);
  try_corner(w, s, cosine);
  try_corner(e, s, -cosine);
  if (!(best < enough)) return false;
  field_.values[node] = best;
  return true;
}

bool Limiter::limit_pole(Index pole, Sides& sides) {
  const Index ring = pole == 0 ? 1 : last_row_ - 1;
  const double* values = row(ring);
  double lowest = row(pole)[0];
  for (Index i = 0; i < n_lon_; ++i) {
    lowest = std::min(lowest, values[i] + slope_ * metric_.dy[metric_.at(field_, pole, i)]);
  }
  if (!(lowest < row(pole)[0] * (1.0 - 1e-15))) return false;
  std::fill_n(row(pole), n_lon_, lowest);
  ++sides.n_updates;
  return true;
}

/// Whether the row changed.
bool Limiter::limit_row(const Tile& tile, Index j, Sides& sides) {
  if (j == 0 || j == last_row_) return limit_pole(j, sides);
  std::int64_t n_updates = 0;
  if (metric_.is_triaxial) {
    for (Index i = tile.column_begin; i < tile.column_end; ++i) n_updates += limit_node(j, i);
    if (n_updates > 0) {
      for (Index i = tile.column_end; i-- > tile.column_begin;) n_updates += limit_node(j, i);
      sides.west = sides.east = true;
    }
  } else {
    n_updates = sweep_row<true>(tile, j, sides);
    if (n_updates > 0) n_updates += sweep_row<false>(tile, j, sides);
  }
  sides.n_updates += n_updates;
  return n_updates > 0;
}

/// Sweeps up and down over the rows that a change has reached, until none is left.
Sides Limiter::limit_tile(const Tile& tile) {
  Sides sides;
  const Index n = tile.row_end - tile.row_begin;
  std::vector<char> is_active(static_cast<std::size_t>(n) + 2, 1);  // one row more at each end
  const auto visit = [&](Index k) {
    char* active = is_active.data() + k + 1;
    if (!*active) return false;
    *active = 0;
    if (!limit_row(tile, tile.row_begin + k, sides)) return false;
    active[-1] = active[0] = active[1] = 1;
    sides.south = sides.south || k == 0;
    sides.north = sides.north || k == n - 1;
    return true;
  };
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (Index k = 0; k < n; ++k) has_changed = visit(k) || has_changed;
    for (Index k = n; k-- > 0;) has_changed = visit(k) || has_changed;
  }
  return sides;
}

GradientLimitReport Limiter::run(Context& context) {
  GradientLimitReport report;
  constexpr int kColours = 4;
  for (bool has_changed = true; has_changed; ++report.n_rounds) {
    has_changed = false;
    for (int colour = 0; colour < kColours; ++colour) {
      context.monitor.check_cancelled();
      std::vector<std::size_t> due;
      for (std::size_t t = 0; t < tiles_.size(); ++t) {
        if (is_due_[t] && tiles_[t].colour == colour) due.push_back(t);
      }
      // One long tile begins the list, the other goes to where a second thread begins.
      if (due.size() > 2 && due.back() + 1 == tiles_.size())
        std::swap(due.back(), due[due.size() / 2]);
      std::vector<Sides> sides(due.size());
      parallel::for_index(context.exec, static_cast<std::int64_t>(due.size()), 1,
                          [&](std::int64_t k) {
                            const auto at = static_cast<std::size_t>(k);
                            sides[at] = limit_tile(tiles_[due[at]]);
                          });
      for (const std::size_t t : due) is_due_[t] = 0;
      for (std::size_t k = 0; k < due.size(); ++k) {
        if (sides[k].any()) mark_neighbours(due[k], sides[k]);
        has_changed = has_changed || sides[k].any();
        report.n_updates += sides[k].n_updates;
      }
    }
  }
  return report;
}

}  // namespace

GradientLimitReport limit_gradient(Context& context, const Ellipsoid& surface,
                                   LatitudeKind latitude, double slope, LatLonField& spacing_m) {
  DELOS_CHECK(std::isfinite(slope) && slope > 0.0, ErrorKind::config, "gradient limit is ", slope,
              ": it must be > 0 (metres of spacing per metre; 0.15 is usual)");
  DELOS_CHECK(spacing_m.n_lat_cells >= 2 && spacing_m.n_lon >= 4, ErrorKind::config,
              "a spacing table of ", spacing_m.n_rows(), " x ", spacing_m.n_lon,
              " nodes is too small to limit: at least 3 x 4");
  unify_poles_to_min(spacing_m);
  TableMetric metric(context.exec, surface, latitude, spacing_m);
  return Limiter(std::move(metric), slope, spacing_m).run(context);
}

}  // namespace delos
