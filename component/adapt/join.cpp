// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/join.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>

namespace delos {
namespace {

constexpr std::int64_t kCopyGrain = 16384;  // vertices or triangles a task: some ten microseconds
constexpr std::size_t kLeastRoom = 64, kRoomShare = 16;  // polish adds below 1 % of new vertices
constexpr std::int64_t kHoleGrain = 1;  // a filling is at least some hundred triangles

// The id after compaction by the id before, kNone for what is gone, and how many are left.
struct NewIds {
  Array<Index> of;
  Index n_left = 0;
};

// Ids of which some go; the others close up in their order.
class Leaving {
 public:
  explicit Leaving(std::size_t n_ids) : n_ids_(n_ids), gone_((n_ids + kWordIds - 1) / kWordIds) {}

  void take_out(Index id) { gone_[at(id / kWordIds)] |= bit_of(id); }
  void put_back(Index id) { gone_[at(id / kWordIds)] &= ~bit_of(id); }
  /// Their new ids, kNone for those that go.
  NewIds new_ids(parallel::Executor& exec) const {
    NewIds out{Array<Index>(n_ids_), 0};
    std::vector<Index> first;
    for (const std::uint64_t gone : gone_) {
      first.push_back(out.n_left);
      out.n_left += kWordIds - static_cast<Index>(std::popcount(gone));
    }
    out.n_left -= static_cast<Index>(gone_.size() * kWordIds - n_ids_);
    parallel::for_index(exec, static_cast<std::int64_t>(gone_.size()), kCopyGrain / kWordIds,
                        [&](std::int64_t word) { write_word(at(word), first[at(word)], out.of); });
    return out;
  }

 private:
  static constexpr Index kWordIds = 64;
  static std::uint64_t bit_of(Index id) { return std::uint64_t{1} << (id % kWordIds); }
  void write_word(std::size_t word, Index next, Array<Index>& of) const {
    const std::size_t begin = word * kWordIds, end = std::min(begin + kWordIds, n_ids_);
    if (gone_[word] == 0) return std::iota(of.begin() + begin, of.begin() + end, next);
    for (std::size_t id = begin; id < end; ++id) {
      of[id] = (gone_[word] >> (id - begin) & 1) != 0 ? kNone : next++;
    }
  }

  std::size_t n_ids_;
  std::vector<std::uint64_t> gone_;  // a bit an id
};

// Where the filling of a hole begins.
struct Place {
  Index vertex, triangle;
};

class Joiner {
 public:
  Joiner(parallel::Executor& exec, const OldMesh& old, const std::vector<Hole>& holes,
         const std::vector<TileMesh>& fillings)
      : exec_(exec),
        old_(old.mesh),
        at_old_vertex_(old.at_vertex),
        holes_(holes),
        fillings_(fillings) {}

  Joined run() {
    number();
    copy_vertices();
    copy_triangles();
    parallel::for_index(exec_, static_cast<std::int64_t>(fillings_.size()), kHoleGrain,
                        [&](std::int64_t hole) { write_filling(at(hole)); });
    for (std::size_t hole = 0; hole < fillings_.size(); ++hole) {
      for (const TriangleSide& side : fillings_[hole].border) {
        out_.hole_sides.push_back(places_[hole].triangle + side.triangle);
      }
    }
    // One after the other: fillings share vertices.
    for (Index tri = out_.first_filling; tri < out_.mesh.n_triangles(); ++tri) {
      for (const Index v : out_.mesh.triangle(tri).vertex) out_.at_vertex[at(v)] = tri;
    }
    std::sort(out_.hole_sides.begin(), out_.hole_sides.end());
    out_.new_id = std::move(vertex_.of);
    return std::move(out_);
  }

 private:
  void number();
  void copy_vertices();
  void copy_triangles();
  void write_filling(std::size_t hole);

  parallel::Executor& exec_;
  const Mesh& old_;
  const std::vector<Index>& at_old_vertex_;
  const std::vector<Hole>& holes_;
  const std::vector<TileMesh>& fillings_;
  NewIds vertex_, triangle_;
  std::vector<Place> places_;
  Joined out_;
};

void Joiner::number() {
  // Gone are the vertices of the holes' triangles that the emptied hole has no more.
  Leaving vertices(old_.vertices.size()), triangles(old_.triangles.size());
  for (const Hole& hole : holes_) {
    for (const Index tri : hole.old_triangles) {
      triangles.take_out(tri);
      for (const Index v : old_.triangle(tri).vertex) vertices.take_out(v);
    }
  }
  for (const Hole& hole : holes_) {
    for (const Index v : hole.vertices) vertices.put_back(v);
  }
  vertex_ = vertices.new_ids(exec_);
  triangle_ = triangles.new_ids(exec_);
  out_.first_inserted = vertex_.n_left;
  out_.first_filling = triangle_.n_left;
  Place next{vertex_.n_left, triangle_.n_left};
  for (const TileMesh& filling : fillings_) {
    places_.push_back(next);
    next.vertex += static_cast<Index>(filling.inserted.size());
    next.triangle += static_cast<Index>(filling.triangles.size());
  }
  // Room for what relaxation puts in, so that nothing is copied again for a few vertices.
  const std::size_t room = kLeastRoom + at(next.vertex - vertex_.n_left) / kRoomShare;
  out_.mesh.vertices.reserve(at(next.vertex) + room);
  out_.mesh.triangles.reserve(at(next.triangle) + 2 * room);
  out_.mesh.vertices.resize(at(next.vertex));
  out_.mesh.triangles.resize(at(next.triangle));
  out_.at_vertex.reserve(at(next.vertex) + room);
  out_.at_vertex.resize(at(next.vertex));
}

void Joiner::copy_vertices() {
  parallel::for_index(exec_, old_.n_vertices(), kCopyGrain, [&](std::int64_t v) {
    const Index id = vertex_.of[at(v)];
    if (id == kNone) return;
    out_.mesh.vertices[at(id)] = old_.vertices[at(v)];
    out_.at_vertex[at(id)] = triangle_.of[at(at_old_vertex_[at(v)])];
  });
}

void Joiner::copy_triangles() {
  parallel::for_index(exec_, old_.n_triangles(), kCopyGrain, [&](std::int64_t tri) {
    const Index id = triangle_.of[at(tri)];
    if (id == kNone) return;
    Triangle t = old_.triangles[at(tri)];
    for (Index& v : t.vertex) v = vertex_.of[at(v)];
    for (Index& n : t.neighbour) n = triangle_.of[at(n)];
    out_.mesh.triangles[at(id)] = t;
  });
}

// After copy_triangles(), which leaves kNone across the holes' borders.
void Joiner::write_filling(std::size_t hole) {
  const TileMesh& filling = fillings_[hole];
  const std::vector<Index>& survivors = holes_[hole].vertices;
  const Place& place = places_[hole];
  const auto n_survivors = static_cast<Index>(filling.skeleton_vertices.size());
  std::copy(filling.inserted.begin(), filling.inserted.end(),
            out_.mesh.vertices.begin() + place.vertex);
  for (std::size_t i = 0; i < filling.triangles.size(); ++i) {
    Triangle t = filling.triangles[i];
    for (Index& v : t.vertex) {
      v = v < n_survivors ? vertex_.of[at(survivors[at(filling.skeleton_vertices[at(v)])])]
                          : v - n_survivors + place.vertex;
    }
    for (Index& n : t.neighbour) n = n < 0 ? kNone : n + place.triangle;
    out_.mesh.triangles[at(place.triangle) + i] = t;
  }
  for (std::size_t i = 0; i < filling.border.size(); ++i) {
    const TriangleSide& inner = filling.border[i];
    const Hole::BorderSide& outer = holes_[hole].border[i];
    const Index inside = place.triangle + inner.triangle, outside = triangle_.of[at(outer.outside)];
    out_.mesh.triangle(inside).neighbour[at(inner.side)] = outside;
    out_.mesh.triangle(outside).neighbour[at(outer.side)] = inside;
  }
}

}  // namespace

Joined join(parallel::Executor& exec, const OldMesh& old, const std::vector<Hole>& holes,
            const std::vector<TileMesh>& fillings) {
  return Joiner(exec, old, holes, fillings).run();
}

}  // namespace delos
