// SPDX-License-Identifier: BSD-3-Clause
// What is said of a grid with a border is of that grid, in the report and in its files.
#include <doctest/doctest.h>

#include <algorithm>
#include <filesystem>

#include "lifecycle/culled.hpp"
#include "lifecycle/domain.hpp"
#include "lifecycle/outputs.hpp"
#include "metrics/certificate.hpp"
#include "support/products.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using delos::testing::made;
using delos::testing::TemporaryFolder;

namespace {

// Nothing is searched for, so that the embedded bathymetry serves on every machine.
const std::string kOcean =
    "data_path: []\nsizing: {sources: [{type: constant, spacing: 600 km}]}\n"
    "domain: {remove: [bays]}\n";
const std::string kRegion =
    "sizing: {sources: [{type: constant, spacing: 200 km}]}\n"
    "region: {disc: {centre: [175 deg, 80 deg], radius: 2000 km}}\n";
const std::string kFiles =
    "output: {name: g, formats: [mpas, ugrid_cells, ugrid_triangles], pictures: []}\n";

std::vector<Extreme> extremes(const Quality& q) {
  return {q.area_length_min,   q.angle_min_deg,  q.angle_max_deg,   q.radius_edge_max,
          q.grading_max,       q.dual_ratio_min, q.stagger_max,     q.relative_edge_min,
          q.relative_edge_max, q.degree_min,     q.cell_area_min_m2};
}

bool is_in(const Grid& grid, const Extreme& extreme) {
  if (extreme.id < 0) return false;
  if (extreme.element == Element::cell) return extreme.id < grid.n_cells();
  if (extreme.element == Element::triangle) {
    if (extreme.id >= grid.n_vertices()) return false;
    const auto& cells = grid.cells_on_vertex[at(extreme.id)];
    return std::find(cells.begin(), cells.end(), kNone) == cells.end();
  }
  const auto neighbours = grid.cells_on_cell.row(extreme.id);
  return std::find(neighbours.begin(), neighbours.end(), extreme.other) != neighbours.end();
}

/// Recorded from 0 again: the place, as a point.
Vec3 place_of(const Grid& grid, const Extreme& extreme) {
  if (extreme.element == Element::cell) return grid.cell_position[at(extreme.id)];
  Vec3 sum = Vec3::Zero();
  if (extreme.element == Element::edge) {
    sum = grid.cell_position[at(extreme.id)] + grid.cell_position[at(extreme.other)];
  } else {
    for (const Index cell : grid.cells_on_vertex[at(extreme.id)]) {
      sum += grid.cell_position[at(cell)];
    }
  }
  return grid.surface.project(sum);
}

void check_counts(const Grid& grid, const Quality& quality) {
  const auto count = [](const auto& table, auto&& is_it) {
    return std::count_if(table.begin(), table.end(), is_it);
  };
  const auto has_none = [](const auto& cells) {
    return std::find(cells.begin(), cells.end(), kNone) != cells.end();
  };
  CHECK(quality.n_vertices == grid.n_cells());
  CHECK(quality.n_border_edges == count(grid.cells_on_edge, has_none));
  CHECK(quality.n_edges + quality.n_border_edges == grid.n_edges());
  CHECK(quality.n_border_vertices == count(grid.cells_on_vertex, has_none));
  CHECK(quality.n_triangles + quality.n_border_vertices == grid.n_vertices());
  std::int64_t n_in_bins = 0;
  for (const std::int64_t n : quality.angle_deg.counts) n_in_bins += n;
  CHECK(n_in_bins == 3 * quality.n_triangles);
  double area_m2 = 0.0;
  for (const double area : grid.cell_area_m2) area_m2 += area;
  CHECK(quality.total_area_m2 == doctest::Approx(area_m2).epsilon(1e-12));
}

struct Scene {
  parallel::Executor exec{2};
  Monitor monitor;
  Context context{exec, monitor};
};

void check_same(const std::vector<Extreme>& a, const std::vector<Extreme>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    CAPTURE(i);
    CHECK(a[i].value == doctest::Approx(b[i].value).epsilon(1e-9));
    CHECK(a[i].id == b[i].id);
    CHECK(a[i].other == b[i].other);
  }
}

/// What the arrays of a file do not bear out of its certificate, or of this one.
std::vector<std::string> defects(Context& context, const GridFile& file,
                                 const Certificate& recorded) {
  return visit_mesh(context, file, [&](const CertifiedMesh& mesh) {
    return certificate_defects(context, mesh, measure_quality(context, mesh), recorded);
  });
}

}  // namespace

TEST_CASE("the worst elements of a culled grid are elements of it, at their places") {
  for (const std::string& config : {kOcean, kRegion, kRegion + "surface: {shape: wgs84}\n"}) {
    CAPTURE(config);
    const Product product = made(config, 2);
    const Grid& grid = *product.grid;
    const Quality& quality = product.report.quality;
    check_counts(grid, quality);
    for (const Extreme& extreme : extremes(quality)) {
      REQUIRE(is_in(grid, extreme));
      const Vec3 said = grid.surface.point(extreme.where, grid.latitude);
      CHECK((said - place_of(grid, extreme)).norm() < 1e-12);
    }
    CHECK(product.report.n_cells_made == product.mesh.n_vertices());
    CHECK(report_json(product.report).find("\"border_edges\"") != std::string::npos);
  }
}

TEST_CASE("what a culled grid's files say is what the run reported, and is found when altered") {
  const TemporaryFolder folder;
  Scene scene;
  for (const std::string& config : {kOcean, kRegion}) {
    CAPTURE(config);
    const Product product = made(config + kFiles, 2);
    write_outputs(scene.context, output_content(product, "test"), folder.file("out"));
    for (const char* const kind : {"mpas", "ugrid_cells", "ugrid_triangles"}) {
      CAPTURE(kind);
      const GridFile file =
          read_grid_file(scene.context, folder.file("out/g." + std::string(kind) + ".nc"));
      REQUIRE(file.origin.certificate);
      CHECK(defects(scene.context, file, *file.origin.certificate) == std::vector<std::string>());
      Certificate altered = *file.origin.certificate;
      altered.dual_ratio_min.value *= 1.01;
      altered.angle_max_deg.id += 1;
      altered.n_obtuse += 1;
      CHECK(defects(scene.context, file, altered).size() >= 3);
      if (std::string(kind) == "ugrid_triangles")
        continue;  // dual edges at the border are not there
      const Quality read = visit_mesh(scene.context, file, [&](const CertifiedMesh& mesh) {
        return measure_quality(scene.context, mesh);
      });
      check_same(extremes(read), extremes(product.report.quality));
      check_counts(*product.grid, read);
    }
  }
}

TEST_CASE(
    "a part that is the whole is as good as the whole, and a part of no triangle is refused") {
  const std::string sizing = "sizing: {sources: [{type: constant, spacing: 900 km}]}\n";
  const Product whole = made(sizing, 2);
  Scene scene;
  const Quality again = measure_culled(scene.context, *whole.grid);
  CHECK(again.euler == 2);
  CHECK_FALSE(again.has_border());
  check_same(extremes(again), extremes(whole.report.quality));
  CHECK(again.angle_deg.counts == whole.report.quality.angle_deg.counts);
  CHECK(again.relative_edge.counts == whole.report.quality.relative_edge.counts);

  Grid lone = *whole.grid;
  const std::vector<Index> one{0};
  cull_to_cells(scene.context, one, lone);
  CHECK_THROWS_AS(measure_culled(scene.context, lone), Error);
}
