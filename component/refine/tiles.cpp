// SPDX-License-Identifier: BSD-3-Clause
#include "refine/tiles.hpp"

#include <cmath>
#include <span>

#include "core/error.hpp"

namespace delos {
namespace {

// Every face is measured at this level of the tree (20 * 4^4 triangles of about 440 km on the
// Earth, 9 samples in each), so that a small fine patch inside a large face is not overlooked.
constexpr int kMeasuredLevel = 4;
constexpr int kMeasuredPerFace = 256;       // 4^kMeasuredLevel
constexpr std::size_t kSamplesPerSide = 3;  // sub-triangles along a side of a measured triangle
constexpr std::size_t kSamplesPerTriangle = kSamplesPerSide * kSamplesPerSide;
constexpr int kMaxLevel = 24;              // the icosahedron's side over 2^24 is below one metre
constexpr std::size_t kMeasureGrain = 16;  // triangles a task and batch: some microseconds

constexpr std::array<std::array<Index, 3>, 20> kFaces = {
    {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
     {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
     {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};

std::vector<Vec3> icosahedron_corners() {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  return {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
          {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
}

using Triple = std::array<Vec3, 3>;

// The four children of a triangle whose side k has the middle point m[k].
std::array<Triple, 4> split(const Ellipsoid& surface, const Triple& t) {
  const Vec3 m0 = surface.project(t[1] + t[2]);
  const Vec3 m1 = surface.project(t[2] + t[0]);
  const Vec3 m2 = surface.project(t[0] + t[1]);
  return {{{t[0], m2, m1}, {m2, t[1], m0}, {m1, m0, t[2]}, {m2, m0, m1}}};
}

// The samples of a triangle: the centres of its kSamplesPerSide^2 sub-triangles, as places on the
// surface, each with twice the area of the surface for which it stands.
struct Samples {
  Vertex* place;
  double* twice_area;
};

// Where the ray through a point q of the triangle's plane meets the surface, p = s q with
// s = |q|_W^-1 and W = diag(1 / r^2), an element of the plane widens by s^3 |Wp| (q.n): the solid
// angle that it fills, (q.n) / |q|^3, times |p|^2 over the cosine of the surface's slant, which is
// 1 / (|p| |Wp|). So one projection serves for place and area.
void sample(const Ellipsoid& surface, const Triple& t, const Samples& out) {
  constexpr double kThird = 1.0 / (3.0 * kSamplesPerSide);
  const Vec3& w = surface.inverse_square();
  const Vec3 u = t[1] - t[0], v = t[2] - t[0], normal = u.cross(v);
  const double scaled_area = t[0].dot(normal) / kSamplesPerTriangle;
  std::size_t count = 0;
  const auto add = [&](std::size_t i, std::size_t j) {  // i, j in thirds of a sub-triangle's side
    const Vec3 q = t[0] + static_cast<double>(i) * kThird * u + static_cast<double>(j) * kThird * v;
    const Vec3 wq = q.cwiseProduct(w);
    const double s = 1.0 / std::sqrt(wq.dot(q));
    out.place[count] = {s * q.x(), s * q.y(), s * q.z(), 0.0};
    const double slant = surface.is_sphere() ? 1.0 : s * wq.norm();
    out.twice_area[count++] = s * s * s * slant * scaled_area;
  };
  for (std::size_t i = 0; i < kSamplesPerSide; ++i) {
    for (std::size_t j = 0; j < kSamplesPerSide - i; ++j) {
      add(3 * i + 1, 3 * j + 1);
      if (i + j + 1 < kSamplesPerSide) add(3 * i + 2, 3 * j + 2);
    }
  }
}

// Expected vertices, integral of 2 / (sqrt(3) h^2), of each surface triangle by the midpoint rule.
// All spacings in one batch, which is several times faster than a few at a time.
void measure(const Ellipsoid& surface, const SpacingField& spacing,
             std::span<const Triple> triangles, std::span<double> mass) {
  constexpr std::size_t kN = kSamplesPerTriangle;
  std::array<Vertex, kN * kMeasureGrain> place;
  std::array<double, kN * kMeasureGrain> twice_area;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    sample(surface, triangles[i], {&place[kN * i], &twice_area[kN * i]});
  }
  spacing.evaluate(std::span(place).first(kN * triangles.size()));
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    double total = 0.0;
    for (std::size_t k = kN * i; k < kN * (i + 1); ++k) {
      total += twice_area[k] / (place[k].spacing * place[k].spacing);
    }
    mass[i] = total / std::sqrt(3.0);  // 2 / sqrt(3) times half of twice the areas
  }
}

// Measures all descendants of the faces at kMeasuredLevel; result [20 * kMeasuredPerFace], the
// children of node i of one level are nodes 4 i .. 4 i + 3 of the next.
std::vector<double> measure_faces(parallel::Executor& exec, const Ellipsoid& surface,
                                  const SpacingField& spacing, const std::vector<Vec3>& corners) {
  static_assert(kMeasureGrain == 16, "a task measures the grandchildren of one node");
  std::vector<double> mass(kFaces.size() * kMeasuredPerFace);
  const auto n_nodes = static_cast<std::int64_t>(mass.size() / kMeasureGrain);
  constexpr std::int64_t kNodesPerFace = kMeasuredPerFace / kMeasureGrain;
  parallel::for_index(exec, n_nodes, 1, [&](std::int64_t node) {
    const auto& face = kFaces[static_cast<std::size_t>(node / kNodesPerFace)];
    Triple t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = corners[static_cast<std::size_t>(face[k])];
    for (int level = kMeasuredLevel - 3; level >= 0; --level) {
      t = split(surface, t)[static_cast<std::size_t>((node >> (2 * level)) & 3)];
    }
    std::array<Triple, kMeasureGrain> grandchildren;
    std::size_t count = 0;
    for (const Triple& child : split(surface, t)) {
      for (const Triple& grandchild : split(surface, child)) grandchildren[count++] = grandchild;
    }
    measure(surface, spacing, grandchildren,
            std::span(mass).subspan(static_cast<std::size_t>(node) * kMeasureGrain, kMeasureGrain));
  });
  return mass;
}

class TileTree {
 public:
  TileTree(const Ellipsoid& surface, const SpacingField& spacing, double tile_vertices,
           Tiling& tiling, std::vector<double> measured)
      : surface_(surface),
        spacing_(spacing),
        tile_vertices_(tile_vertices),
        tiling_(tiling),
        measured_(std::move(measured)) {}

  void grow(const std::array<Index, 3>& c, int level, std::int64_t node) {
    const double mass = expected(c, level, node);
    if ((mass <= tile_vertices_ && !reaches_round(c)) || level >= kMaxLevel) {
      tiling_.tiles.push_back({c, mass});
      return;
    }
    const Index m0 = middle(c[1], c[2]), m1 = middle(c[2], c[0]), m2 = middle(c[0], c[1]);
    grow({c[0], m2, m1}, level + 1, 4 * node);
    grow({m2, c[1], m0}, level + 1, 4 * node + 1);
    grow({m2, m0, m1}, level + 1, 4 * node + 3);
    grow({m1, m0, c[2]}, level + 1, 4 * node + 2);
  }

 private:
  // Whether the normals at two corners differ by more than 135 degrees: such a tile lies on both
  // faces of a flat body, and the first triangles across it run through the inside.
  bool reaches_round(const std::array<Index, 3>& c) const {
    constexpr double kLeastCosine = -0.7071067811865476;
    std::array<Vec3, 3> normal;
    for (std::size_t k = 0; k < 3; ++k) {
      normal[k] = surface_.normal(tiling_.corners[static_cast<std::size_t>(c[k])]);
    }
    return normal[0].dot(normal[1]) < kLeastCosine || normal[1].dot(normal[2]) < kLeastCosine ||
           normal[2].dot(normal[0]) < kLeastCosine;
  }

  double expected(const std::array<Index, 3>& c, int level, std::int64_t node) const {
    if (level > kMeasuredLevel) {
      const auto& p = tiling_.corners;
      const Triple t = {p[static_cast<std::size_t>(c[0])], p[static_cast<std::size_t>(c[1])],
                        p[static_cast<std::size_t>(c[2])]};
      double mass = 0.0;
      measure(surface_, spacing_, {&t, 1}, {&mass, 1});
      return mass;
    }
    const std::int64_t width = std::int64_t{1} << (2 * (kMeasuredLevel - level));
    double mass = 0.0;
    for (std::int64_t i = node * width; i < (node + 1) * width; ++i) {
      mass += measured_[static_cast<std::size_t>(i)];
    }
    return mass;
  }

  Index middle(Index a, Index b) {
    const auto [entry, is_new] =
        tiling_.middles.try_emplace(side_key(a, b), static_cast<Index>(tiling_.corners.size()));
    if (is_new) {
      tiling_.corners.push_back(surface_.project(tiling_.corners[static_cast<std::size_t>(a)] +
                                                 tiling_.corners[static_cast<std::size_t>(b)]));
    }
    return entry->second;
  }

  const Ellipsoid& surface_;
  const SpacingField& spacing_;
  double tile_vertices_;
  Tiling& tiling_;
  std::vector<double> measured_;
};

}  // namespace

Index Tiling::middle_of(Index a, Index b) const {
  const auto entry = middles.find(side_key(a, b));
  return entry == middles.end() ? kNone : entry->second;
}

Tiling make_tiles(parallel::Executor& exec, const Ellipsoid& surface, const SpacingField& spacing,
                  double tile_vertices, double max_vertices) {
  Tiling tiling;
  for (const Vec3& corner : icosahedron_corners()) {
    tiling.corners.push_back(surface.project(corner));
  }
  std::vector<double> measured = measure_faces(exec, surface, spacing, tiling.corners);
  for (const double mass : measured) tiling.expected_vertices += mass;
  DELOS_CHECK(tiling.expected_vertices <= max_vertices, ErrorKind::resource,
              "the spacing asks for about ", tiling.expected_vertices,
              " cells, more than the limit of ", max_vertices,
              ". Make the spacing coarser, or give a cell budget (sizing.cells).");
  TileTree tree(surface, spacing, tile_vertices, tiling, std::move(measured));
  for (std::size_t face = 0; face < kFaces.size(); ++face) {
    tree.grow(kFaces[face], 0, static_cast<std::int64_t>(face));
  }
  return tiling;
}

}  // namespace delos
