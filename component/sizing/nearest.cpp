// SPDX-License-Identifier: BSD-3-Clause
#include "sizing/nearest.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "sizing/nodes.hpp"

namespace delos {
namespace {

/// Points of a leaf at most: a short scan is cheaper than more levels.
constexpr std::size_t kLeafSize = 12;
/// Deeper than any tree of 2^31 points halved at each level.
constexpr std::size_t kMaxDepth = 64;
/// Blocks that a level of the tree is split in: enough for many threads.
constexpr std::size_t kBlocksPerLevel = 256;
/// Squared chords (at most 4) of unit vectors are known to better than this.
constexpr double kRounding = 1.0e-13;

/// Nodes a side of the tiles that the search starts from.
constexpr Index kTileSide = 64;
/// A tile is searched point by point when it has no more nodes or points than these.
constexpr Index kFewNodes = 64;
constexpr std::size_t kFewPoints = 6;

bool is_nearer(const NearestPoint::Hit& a, const NearestPoint::Hit& b) {
  return a.chord2 < b.chord2 || (a.chord2 == b.chord2 && a.point < b.point);
}

/// The point p is nowhere in the ball the nearest when some p0 is nearer all over it: by
/// |q - p|^2 - |q - p0|^2 = 2 q (p0 - p), of which q in the ball can change only
/// 2 radius |p0 - p| from its value at the centre.
struct Rival {
  double chord2;     ///< of p0 from the centre
  double diameter2;  ///< squared diameter of the ball
  double reach2;     ///< squared chord from the centre beyond which no point counts
  bool is_beaten(double chord2_of_point, double chord2_between) const {
    const double lead = chord2_of_point - chord2 - kRounding;
    return chord2_of_point > reach2 || (lead > 0.0 && lead * lead > diameter2 * chord2_between);
  }
};

double square(double x) { return x * x; }

Rival make_rival(const NearestPoint::Ball& ball, double chord2) {
  return {chord2, square(2.0 * ball.radius), square(ball.reach + ball.radius) + kRounding};
}

}  // namespace

NearestPoint::NearestPoint(parallel::Executor& exec, const std::vector<Vec3>& points)
    : entries_(points.size()) {
  if (points.empty()) return;
  for (std::size_t k = 0; k < points.size(); ++k) entries_[k] = {points[k], static_cast<Index>(k)};
  std::size_t n_leaves = 1;
  while (n_leaves * kLeafSize < points.size()) n_leaves *= 2;
  boxes_.resize(2 * n_leaves - 1);
  for (std::size_t n = 1; n <= n_leaves; n *= 2) {
    const auto grain = static_cast<std::int64_t>(std::max<std::size_t>(n / kBlocksPerLevel, 1));
    parallel::for_index(exec, static_cast<std::int64_t>(n), grain, [&](std::int64_t i) {
      const auto at = static_cast<std::size_t>(i);
      split(n - 1 + at, points.size() * at / n, points.size() * (at + 1) / n);
    });
  }
}

/// The box of a node, and its points parted between its children.
void NearestPoint::split(std::size_t node, std::size_t begin, std::size_t end) {
  Box box{entries_[begin].position, entries_[begin].position};
  for (std::size_t k = begin; k < end; ++k) {
    box.low = box.low.cwiseMin(entries_[k].position);
    box.high = box.high.cwiseMax(entries_[k].position);
  }
  boxes_[node] = box;
  if (is_leaf(node)) return;
  // Where the ranges of the children meet: n (2 i + 1) / (2 m) of all n for node i of m.
  std::size_t n_level = 1;
  while (2 * n_level - 1 <= node) n_level *= 2;
  const std::size_t i = node - (n_level - 1);
  const std::size_t middle = entries_.size() * (2 * i + 1) / (2 * n_level);
  int axis = 0;
  (box.high - box.low).maxCoeff(&axis);
  const auto at = [&](std::size_t k) { return entries_.begin() + static_cast<std::ptrdiff_t>(k); };
  std::nth_element(at(begin), at(middle), at(end), [axis](const Entry& a, const Entry& b) {
    const double ka = a.position[axis], kb = b.position[axis];
    return ka < kb || (ka == kb && a.point < b.point);
  });
}

std::span<const NearestPoint::Entry> NearestPoint::points_of_leaf(std::size_t node) const {
  const std::size_t n = n_leaves(), leaf = node - (n - 1);
  const std::size_t begin = entries_.size() * leaf / n;
  return std::span(entries_).subspan(begin, entries_.size() * (leaf + 1) / n - begin);
}

const NearestPoint::Entry* NearestPoint::find_entry(const Vec3& query, Hit& best) const {
  struct Visit {
    std::size_t node;
    double gap2;  ///< no point below the node is nearer than this
  };
  const Entry* nearest = nullptr;
  std::array<Visit, kMaxDepth> stack;
  std::size_t depth = 0;
  if (!boxes_.empty()) stack[depth++] = {0, boxes_[0].gap2(query)};
  while (depth > 0) {
    const Visit visit = stack[--depth];
    if (visit.gap2 > best.chord2) continue;
    if (is_leaf(visit.node)) {
      for (const Entry& entry : points_of_leaf(visit.node)) {
        const Hit hit{(query - entry.position).squaredNorm(), entry.point};
        if (!is_nearer(hit, best)) continue;
        best = hit;
        nearest = &entry;
      }
      continue;
    }
    const std::size_t child = 2 * visit.node + 1;
    const Visit left{child, boxes_[child].gap2(query)};
    const Visit right{child + 1, boxes_[child + 1].gap2(query)};
    const bool left_first = left.gap2 <= right.gap2;
    stack[depth++] = left_first ? right : left;
    stack[depth++] = left_first ? left : right;
  }
  return nearest;
}

NearestPoint::Hit NearestPoint::find(const Vec3& query, double below_chord2) const {
  Hit best{below_chord2, kNone};
  find_entry(query, best);
  return best;
}

void NearestPoint::collect(const Ball& ball, std::vector<Entry>& found) const {
  Hit best{square(ball.reach + ball.radius) + kRounding, kNone};
  const Entry* nearest = find_entry(ball.centre, best);
  if (nearest == nullptr) return;
  const Rival rival = make_rival(ball, best.chord2);
  // A point p of the ball's surroundings is at most |p - c| + |p0 - c| from the nearest, p0.
  const double farthest = std::sqrt(best.chord2) + 2.0 * ball.radius;
  const double bound2 = std::min(square(farthest) + kRounding, rival.reach2);
  std::array<std::size_t, kMaxDepth> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const std::size_t node = stack[--depth];
    if (boxes_[node].gap2(ball.centre) > bound2) continue;
    if (!is_leaf(node)) {
      stack[depth++] = 2 * node + 2;
      stack[depth++] = 2 * node + 1;
      continue;
    }
    for (const Entry& entry : points_of_leaf(node)) {
      const double chord2 = (ball.centre - entry.position).squaredNorm();
      const double between2 = (nearest->position - entry.position).squaredNorm();
      if (!rival.is_beaten(chord2, between2)) found.push_back(entry);
    }
  }
}

namespace {

/// The descent from one of the first tiles. The points that a tile keeps stand behind those of the
/// tile that it is a part of, and make room when it is done.
class TileSearch {
 public:
  TileSearch(const NearestPoint& points, const NodeDirections& nodes, const LatLonField& like,
             const NodeSearch& search)
      : points_(points),
        nodes_(nodes),
        search_(search),
        lat_step_(kPi / like.n_lat_cells),
        lon_step_(2.0 * kPi / like.n_lon),
        reach_(std::sqrt(search.below_chord2)) {}

  void run(const TableTile& tile);

 private:
  struct Extent {
    double lat, lon;  ///< half of the tile's, as lengths
  };
  Extent extent(const TableTile& tile, Index middle_row, Index middle_column) const;
  NearestPoint::Ball ball(const TableTile& tile) const;
  void descend(const TableTile& tile, std::size_t begin);
  void keep(const TableTile& tile, std::size_t begin);
  void halve(const TableTile& tile, std::size_t begin);
  void answer(const TableTile& tile, std::size_t begin);
  void answer_row(Index row, const TableTile& tile, std::size_t begin);
  bool is_wanted(const TableTile& tile) const {
    return !search_.is_wanted || search_.is_wanted(tile);
  }
  std::size_t n_points() const { return x_.size(); }
  void resize(std::size_t n);

  const NearestPoint& points_;
  const NodeDirections& nodes_;
  const NodeSearch& search_;
  double lat_step_, lon_step_, reach_;
  std::vector<double> x_, y_, z_, id_;  ///< ids as numbers, so that loops of one width vectorise
  std::vector<double> chord2_;
};

void TileSearch::resize(std::size_t n) {
  for (std::vector<double>* values : {&x_, &y_, &z_, &id_}) values->resize(n);
}

TileSearch::Extent TileSearch::extent(const TableTile& tile, Index middle_row,
                                      Index middle_column) const {
  double widest = 0.0;  // cosine of the latitude nearest to the equator
  for (Index row = tile.row_begin; row < tile.row_end; ++row) {
    widest = std::max(widest, nodes_.lat[static_cast<std::size_t>(row)].cos);
  }
  const Index rows = std::max(middle_row - tile.row_begin, tile.row_end - 1 - middle_row);
  const Index columns =
      std::max(middle_column - tile.column_begin, tile.column_end - 1 - middle_column);
  return {rows * lat_step_, widest * columns * lon_step_};
}

/// Round the middle node: |q - c|^2 = 4 sin^2(d_lat / 2) + 4 cos cos sin^2(d_lon / 2).
NearestPoint::Ball TileSearch::ball(const TableTile& tile) const {
  const Index row = tile.row_begin + (tile.row_end - tile.row_begin) / 2;
  const Index column = tile.column_begin + (tile.column_end - tile.column_begin) / 2;
  const Extent half = extent(tile, row, column);
  const double radius = std::sqrt(half.lat * half.lat + half.lon * half.lon);
  return {nodes_.direction(row, column), radius * (1.0 + kRounding), reach_};
}

void TileSearch::run(const TableTile& tile) {
  if (!is_wanted(tile)) return;
  std::vector<NearestPoint::Entry> found;
  points_.collect(ball(tile), found);
  resize(found.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    x_[k] = found[k].position.x();
    y_[k] = found[k].position.y();
    z_[k] = found[k].position.z();
    id_[k] = found[k].point;
  }
  halve(tile, 0);
}

/// A tile whose points begin at `begin` and end the list.
void TileSearch::halve(const TableTile& tile, std::size_t begin) {
  const Index n_rows = tile.row_end - tile.row_begin;
  const Index n_columns = tile.column_end - tile.column_begin;
  if (n_rows * n_columns <= kFewNodes || n_points() - begin <= kFewPoints) {
    answer(tile, begin);
    return;
  }
  TableTile first = tile, second = tile;
  const Extent whole = extent(tile, tile.row_begin, tile.column_begin);
  if (n_columns == 1 || (n_rows > 1 && whole.lat >= whole.lon)) {
    first.row_end = second.row_begin = tile.row_begin + n_rows / 2;
  } else {
    first.column_end = second.column_begin = tile.column_begin + n_columns / 2;
  }
  for (const TableTile& half : {first, second}) {
    if (!is_wanted(half)) continue;
    const std::size_t end = n_points();
    keep(half, begin);
    halve(half, end);
    resize(end);
  }
}

/// Appends those of the last points, from `begin` on, that may be the nearest of a node.
void TileSearch::keep(const TableTile& tile, std::size_t begin) {
  const std::size_t end = n_points(), n = end - begin;
  const NearestPoint::Ball around = ball(tile);
  const Vec3 c = around.centre;
  resize(end + n);
  chord2_.resize(n);
  const double *x = x_.data() + begin, *y = y_.data() + begin, *z = z_.data() + begin;
  for (std::size_t k = 0; k < n; ++k) {
    chord2_[k] = square(c.x() - x[k]) + (square(c.y() - y[k]) + square(c.z() - z[k]));
  }
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < n; ++k) nearest = chord2_[k] < chord2_[nearest] ? k : nearest;
  const Rival rival = make_rival(around, chord2_[nearest]);
  const Vec3 p(x[nearest], y[nearest], z[nearest]);
  std::size_t to = end;
  for (std::size_t k = 0; k < n; ++k) {
    const double between2 = square(p.x() - x[k]) + (square(p.y() - y[k]) + square(p.z() - z[k]));
    x_[to] = x[k];
    y_[to] = y[k];
    z_[to] = z[k];
    id_[to] = id_[begin + k];
    to += rival.is_beaten(chord2_[k], between2) ? 0 : 1;
  }
  resize(to);
}

void TileSearch::answer(const TableTile& tile, std::size_t begin) {
  for (Index row = tile.row_begin; row < tile.row_end; ++row) answer_row(row, tile, begin);
}

/// All points for all nodes of a row of the tile, so that the loop over the nodes vectorises.
void TileSearch::answer_row(Index row, const TableTile& tile, std::size_t begin) {
  constexpr auto kLanes = static_cast<std::size_t>(kTileSide);
  std::array<double, kLanes> x, y, z, chord2, id;
  const auto n = static_cast<std::size_t>(tile.column_end - tile.column_begin);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 q = nodes_.direction(row, tile.column_begin + static_cast<Index>(i));
    x[i] = q.x();
    y[i] = q.y();
    z[i] = q.z();
    chord2[i] = search_.below_chord2;
    id[i] = kNone;
  }
  for (std::size_t k = begin; k < n_points(); ++k) {
    const double px = x_[k], py = y_[k], pz = z_[k], point = id_[k];
    for (std::size_t i = 0; i < n; ++i) {
      // Added up as squaredNorm() of a Vec3 does.
      const double c = square(x[i] - px) + (square(y[i] - py) + square(z[i] - pz));
      const double best = chord2[i], best_id = id[i];
      const bool is_better = (c < best) | ((c == best) & (point < best_id));
      chord2[i] = is_better ? c : best;
      id[i] = is_better ? point : best_id;
    }
  }
  std::array<NearestPoint::Hit, kLanes> hits;
  for (std::size_t i = 0; i < n; ++i) hits[i] = {chord2[i], static_cast<Index>(id[i])};
  search_.take(row, tile.column_begin, std::span(hits.data(), n));
}

}  // namespace

void find_nearest(parallel::Executor& exec, const NearestPoint& points, const LatLonField& like,
                  const NodeSearch& search) {
  const NodeDirections nodes(like);
  const Index n_rows = (like.n_rows() + kTileSide - 1) / kTileSide;
  const Index n_columns = (like.n_lon + kTileSide - 1) / kTileSide;
  parallel::for_index(exec, std::int64_t{n_rows} * n_columns, 1, [&](std::int64_t t) {
    const auto row = static_cast<Index>(t / n_columns) * kTileSide;
    const auto column = static_cast<Index>(t % n_columns) * kTileSide;
    TileSearch(points, nodes, like, search)
        .run({row, std::min(row + kTileSide, like.n_rows()), column,
              std::min(column + kTileSide, like.n_lon)});
  });
}

}  // namespace delos
