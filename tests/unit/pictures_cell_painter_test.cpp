// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/cell_painter.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "core/hash.hpp"
#include "dual/build.hpp"
#include "metrics/quality.hpp"
#include "pictures/globe.hpp"
#include "pictures/histograms.hpp"
#include "pictures/map.hpp"
#include "triangulation/delaunay.hpp"
#include "triangulation/flip.hpp"
#include "triangulation/seeds.hpp"

using namespace delos;
using namespace delos::pictures;

namespace {

Mesh triangulated(parallel::Executor& exec, const Ellipsoid& body) {
  Mesh mesh = delaunay(exec, fibonacci_points(700, body));
  restore_delaunay_everywhere(exec, mesh, body);
  return mesh;
}

struct Example {
  parallel::Executor exec{2};
  Monitor monitor;
  Context context{exec, monitor};
  Ellipsoid surface;
  Mesh mesh;
  Grid grid;

  explicit Example(const Ellipsoid& body)
      : surface(body),
        mesh(triangulated(exec, body)),
        grid(build_grid(context, body, LatitudeKind::geodetic, mesh)) {}
};

Index nearest_cell(const Grid& grid, const Vec3& p) {
  Index best = 0;
  for (Index cell = 1; cell < grid.n_cells(); ++cell) {
    if ((grid.cell_position[static_cast<std::size_t>(cell)] - p).squaredNorm() <
        (grid.cell_position[static_cast<std::size_t>(best)] - p).squaredNorm()) {
      best = cell;
    }
  }
  return best;
}

/// Width and height that the PNG header states; zeros when it is no PNG.
std::pair<int, int> png_size(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (bytes.size() < 1000 || bytes.compare(0, 4, "\x89PNG") != 0) return {0, 0};
  const auto word = [&](std::size_t at) {
    int value = 0;
    for (std::size_t i = at; i < at + 4; ++i)
      value = 256 * value + static_cast<unsigned char>(bytes[i]);
    return value;
  };
  return {word(16), word(20)};
}

}  // namespace

TEST_CASE("the painter finds the nearest cell from any start, on a sphere and on an ellipsoid") {
  for (const Ellipsoid& body : {Ellipsoid(), Ellipsoid(Vec3(7.6e6, 6.4e6, 5.1e6), Vec3(0, 0, 0))}) {
    const Example example(body);
    const CellPainter painter(example.grid, nullptr);
    Index walking = 0;
    for (std::uint64_t i = 0; i < 500; ++i) {
      const Vec3 p =
          body.project(Vec3(uniform01(1, i) - 0.5, uniform01(2, i) - 0.5, uniform01(3, i) - 0.5));
      const Index wanted = nearest_cell(example.grid, p);
      painter.colour(p, walking);
      CHECK(walking == wanted);
      auto from_afar = static_cast<Index>(hash64(4, i) % 700);
      const Colour colour = painter.colour(p, from_afar);
      CHECK(from_afar == wanted);
      const Colour own =
          painter.scale().colour(painter.sizes_km()[static_cast<std::size_t>(wanted)]);
      CHECK(colour.r == own.r);
      CHECK(colour.b == own.b);
    }
  }
}

TEST_CASE("cell size is the neighbour distance of the hexagon of that area") {
  const Example example{Ellipsoid::sphere(6371220.0)};
  const auto sizes = cell_sizes_km(example.grid);
  double area_km2 = 0.0;
  for (const double size : sizes) area_km2 += std::sqrt(3.0) / 2.0 * size * size;
  CHECK(area_km2 == doctest::Approx(4.0 * kPi * 6371.22 * 6371.22));
}

TEST_CASE("land is greyer than the cell under it and sea is not") {
  const Example example{Ellipsoid::sphere(6371220.0)};
  Raster raster;
  raster.lat_deg = {-90.0, 0.0, 90.0};
  raster.lon_deg = {0.0, 90.0, 180.0, 270.0};
  raster.periodic = true;
  raster.values = {-100, -100, -100, -100, -100, -100, -100, -100, 800, 800, 800, 800};
  const LandMask land(raster);
  const CellPainter bare(example.grid, nullptr), covered(example.grid, &land);
  const auto greyness = [](const Colour& c) {
    return std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b});
  };
  Index a = 0, b = 0;
  const Vec3 north = Vec3(0.3, 0.1, 1.0).normalized(), south = Vec3(0.3, 0.1, -1.0).normalized();
  CHECK(greyness(covered.colour(north, a)) < 0.5 * greyness(bare.colour(north, b)));
  CHECK(covered.colour(south, a).g == bare.colour(south, b).g);
}

TEST_CASE("globe, map and histograms are PNG files of the size asked for") {
  const Example example{Ellipsoid::wgs84()};
  Monitor monitor;
  parallel::Executor exec(2);
  Context context{exec, monitor};
  const Quality quality = measure_quality(context, example.surface, nullptr, example.mesh);
  PictureOptions options;
  options.title = "seven hundred cells";
  options.width = 480;
  options.height = 300;
  const std::string path = "pictures_cell_painter_test.png";
  const auto wanted = std::pair{480, 300};
  draw_globe(example.grid, options, path);
  CHECK(png_size(path) == wanted);
  draw_map(example.grid, options, path);
  CHECK(png_size(path) == wanted);
  draw_histograms(quality, options, path);
  CHECK(png_size(path) == wanted);
  std::remove(path.c_str());
  CHECK_THROWS_AS(draw_map(example.grid, options, "/nonexistent/a.png"), Error);
  CHECK_THROWS_AS(draw_globe(example.grid, options, "/nonexistent/a.png"), Error);
  CHECK_THROWS_AS(draw_histograms(quality, options, "/nonexistent/a.png"), Error);
}
