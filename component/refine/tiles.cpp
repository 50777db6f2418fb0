// SPDX-License-Identifier: BSD-3-Clause
#include "refine/tiles.hpp"

#include <cmath>

#include "core/error.hpp"

namespace delos {
namespace {

// Every face is measured at this level of the tree (20 * 4^4 triangles of about 440 km on the
// Earth, 9 samples in each), so that a small fine patch inside a large face is not overlooked.
constexpr int kMeasuredLevel = 4;
constexpr int kMeasuredPerFace = 256;       // 4^kMeasuredLevel
constexpr std::size_t kSamplesPerSide = 3;  // sub-triangles along a side of a measured triangle
constexpr int kMaxLevel = 24;               // the icosahedron's side over 2^24 is below one metre
constexpr std::int64_t kMeasureGrain = 16;  // triangles a task: about 20 microseconds

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

// Expected vertices, integral of 2 / (sqrt(3) h^2), of a surface triangle by the midpoint rule.
double measure(const Ellipsoid& surface, const SpacingField& spacing, const Triple& t) {
  constexpr std::size_t kPerSide = kSamplesPerSide;
  std::array<std::array<Vec3, kPerSide + 1>, kPerSide + 1> at;
  for (std::size_t i = 0; i <= kPerSide; ++i) {
    for (std::size_t j = 0; j <= kPerSide - i; ++j) {
      at[i][j] = surface.project(static_cast<double>(kPerSide - i - j) * t[0] +
                                 static_cast<double>(i) * t[1] + static_cast<double>(j) * t[2]);
    }
  }
  // Centres and twice the areas of the sub-triangles first, then all spacings in one batch.
  std::array<Vertex, kPerSide * kPerSide> centre;
  std::array<double, kPerSide * kPerSide> twice_area;
  std::size_t count = 0;
  const auto add = [&](const Vec3& p, const Vec3& q, const Vec3& r) {
    const Vec3 c = surface.project(p + q + r);
    centre[count] = {c.x(), c.y(), c.z(), 0.0};
    twice_area[count++] = (q - p).cross(r - p).norm();
  };
  for (std::size_t i = 0; i < kPerSide; ++i) {
    for (std::size_t j = 0; j < kPerSide - i; ++j) {
      add(at[i][j], at[i + 1][j], at[i][j + 1]);
      if (i + j + 1 < kPerSide) add(at[i + 1][j], at[i + 1][j + 1], at[i][j + 1]);
    }
  }
  spacing.evaluate(centre);
  double total = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    total += twice_area[i] / (centre[i].spacing * centre[i].spacing);
  }
  return total / std::sqrt(3.0);  // 2 / sqrt(3) times half the cross products
}

// Measures all descendants of the faces at kMeasuredLevel; result [20 * kMeasuredPerFace], the
// children of node i of one level are nodes 4 i .. 4 i + 3 of the next.
std::vector<double> measure_faces(parallel::Executor& exec, const Ellipsoid& surface,
                                  const SpacingField& spacing, const std::vector<Vec3>& corners) {
  std::vector<double> mass(kFaces.size() * kMeasuredPerFace);
  const auto n = static_cast<std::int64_t>(mass.size());
  parallel::for_index(exec, n, kMeasureGrain, [&](std::int64_t i) {
    const auto& face = kFaces[static_cast<std::size_t>(i / kMeasuredPerFace)];
    Triple t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = corners[static_cast<std::size_t>(face[k])];
    for (int level = kMeasuredLevel - 1; level >= 0; --level) {
      t = split(surface, t)[static_cast<std::size_t>((i >> (2 * level)) & 3)];
    }
    mass[static_cast<std::size_t>(i)] = measure(surface, spacing, t);
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
      return measure(surface_, spacing_,
                     {p[static_cast<std::size_t>(c[0])], p[static_cast<std::size_t>(c[1])],
                      p[static_cast<std::size_t>(c[2])]});
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
