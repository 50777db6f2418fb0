// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Nearest of many points on the unit sphere: a k-d tree with boxes, and the search for all nodes of
// a table at once.
#include <functional>
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "core/types.hpp"
#include "sizing/spacing.hpp"

namespace delos {

class NearestPoint {
 public:
  struct Hit {
    double chord2 = 0.0;  ///< squared chord to the point
    Index point = kNone;  ///< id = place in the constructor's array; the lowest among equals
  };
  struct Entry {
    Vec3 position;
    Index point;
  };
  /// Queries within `radius` of `centre`, of which only points nearer than `reach` count (chords).
  struct Ball {
    Vec3 centre;
    double radius, reach;
  };

  NearestPoint(parallel::Executor& exec, const std::vector<Vec3>& points);

  /// The nearest point whose squared chord is below the one given; {that, kNone} when there is
  /// none.
  Hit find(const Vec3& query, double below_chord2) const;
  /// Appends every point that may be the nearest of some query in the ball: those that no other
  /// point beats all over the ball, and a few more.
  void collect(const Ball& ball, std::vector<Entry>& found) const;

 private:
  struct Box {
    Vec3 low, high;
    double gap2(const Vec3& query) const {
      return (low - query).cwiseMax(query - high).cwiseMax(0.0).squaredNorm();
    }
  };
  std::size_t n_leaves() const { return (boxes_.size() + 1) / 2; }
  bool is_leaf(std::size_t node) const { return 2 * node + 1 >= boxes_.size(); }
  std::span<const Entry> points_of_leaf(std::size_t node) const;
  const Entry* find_entry(const Vec3& query, Hit& best) const;
  void split(std::size_t node, std::size_t begin, std::size_t end);

  std::vector<Entry> entries_;  ///< in tree order
  std::vector<Box> boxes_;      ///< a complete binary tree: the children of k are 2k + 1 and 2k + 2
};

/// Nodes [row_begin, row_end) x [column_begin, column_end) of a table.
struct TableTile {
  Index row_begin, row_end, column_begin, column_end;
};

struct NodeSearch {
  double below_chord2 = 5.0;  ///< only points nearer than this count; above the longest: all do
  /// Whether a node of the tile needs an answer; all do when empty.
  std::function<bool(const TableTile&)> is_wanted;
  /// Gets the answers of the nodes (row, column), (row, column + 1), ..., also of those that are
  /// not wanted in a tile that is. Called from many threads, never twice for a node.
  std::function<void(Index row, Index column, std::span<const NearestPoint::Hit>)> take;
};

/// The answers that find() would give for the unit vectors of the nodes of a table of the size of
/// `like`, to the last bit. Tiles of nodes are halved again and again, and each half keeps only the
/// points that may be the nearest of one of its nodes: a few in the end.
void find_nearest(parallel::Executor& exec, const NearestPoint& points, const LatLonField& like,
                  const NodeSearch& search);

}  // namespace delos
