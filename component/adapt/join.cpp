// SPDX-License-Identifier: BSD-3-Clause
#include "adapt/join.hpp"

#include <algorithm>

namespace delos {
namespace {

constexpr std::int64_t kCopyGrain = 16384;  // vertices or triangles a task: some ten microseconds
constexpr std::size_t kLeastRoom = 64, kRoomShare = 16;  // polish adds below 1 % of new vertices
constexpr std::int64_t kHoleGrain = 1;  // a filling is at least some hundred triangles

// The id after compaction by the id before, kNone where is_gone(id), and how many are left.
struct NewIds {
  std::vector<Index> of;
  Index n_left = 0;
};

template <class IsGone>
NewIds count_up(parallel::Executor& exec, std::size_t n, const IsGone& is_gone) {
  const auto n_blocks = (static_cast<std::int64_t>(n) + kCopyGrain - 1) / kCopyGrain;
  const auto end_of = [&](std::int64_t block) {
    return std::min(static_cast<std::int64_t>(n), (block + 1) * kCopyGrain);
  };
  const auto first = parallel::exclusive_scan(exec, n_blocks, 1, [&](std::int64_t block) {
    std::int64_t count = 0;
    for (std::int64_t i = block * kCopyGrain; i < end_of(block); ++i) count += is_gone(i) ? 0 : 1;
    return count;
  });
  NewIds out{std::vector<Index>(n), static_cast<Index>(first.back())};
  parallel::for_index(exec, n_blocks, 1, [&](std::int64_t block) {
    auto next = static_cast<Index>(first[at(block)]);
    for (std::int64_t i = block * kCopyGrain; i < end_of(block); ++i) {
      out.of[at(i)] = is_gone(i) ? kNone : next++;
    }
  });
  return out;
}

// Where the filling of a hole begins.
struct Place {
  Index vertex, triangle;
};

class Joiner {
 public:
  Joiner(parallel::Executor& exec, const OldMesh& old, const Holes& holes,
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
  const Holes& holes_;
  const std::vector<TileMesh>& fillings_;
  NewIds vertex_, triangle_;
  std::vector<Place> places_;
  Joined out_;
};

void Joiner::number() {
  // Gone are the vertices of the holes' triangles that the emptied hole has no more.
  std::vector<char> is_gone(old_.vertices.size(), 0);
  for (const Hole& hole : holes_.holes) {
    for (const Index tri : hole.old_triangles) {
      for (const Index v : old_.triangle(tri).vertex) is_gone[at(v)] = 1;
    }
  }
  for (const Hole& hole : holes_.holes) {
    for (const Index v : hole.vertices) is_gone[at(v)] = 0;
  }
  vertex_ =
      count_up(exec_, old_.vertices.size(), [&](std::int64_t v) { return is_gone[at(v)] != 0; });
  triangle_ = count_up(exec_, old_.triangles.size(),
                       [&](std::int64_t tri) { return holes_.place_of[at(tri)] != kNone; });
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
  const std::vector<Index>& survivors = holes_.holes[hole].vertices;
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
    const Hole::BorderSide& outer = holes_.holes[hole].border[i];
    const Index inside = place.triangle + inner.triangle, outside = triangle_.of[at(outer.outside)];
    out_.mesh.triangle(inside).neighbour[at(inner.side)] = outside;
    out_.mesh.triangle(outside).neighbour[at(outer.side)] = inside;
  }
}

}  // namespace

Joined join(parallel::Executor& exec, const OldMesh& old, const Holes& holes,
            const std::vector<TileMesh>& fillings) {
  return Joiner(exec, old, holes, fillings).run();
}

}  // namespace delos
