// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/face_mesh.hpp"
#include "io/mpas.hpp"

namespace delos {
namespace {

/// The tables of one file, checked: the rest of the library may index with what comes from here.
class MpasTables {
 public:
  explicit MpasTables(const std::string& path) : file_(path) {
    const std::string sphere = file_.text_attribute("", "on_a_sphere").value_or("missing");
    DELOS_CHECK(sphere == "YES", ErrorKind::input, path, ": attribute on_a_sphere is ", sphere,
                ", only MPAS meshes on a sphere (YES) can be read. Give such a file.");
    n_cells_ = length("nCells");
    n_edges_ = length("nEdges");
    n_vertices_ = length("nVertices");
    DELOS_CHECK(length("vertexDegree") == 3, ErrorKind::input, path, ": vertexDegree is ",
                length("vertexDegree"), ", only 3 (cells of a triangulation) can be read.");
    const auto radius = file_.number_attribute("", "sphere_radius");
    DELOS_CHECK(
        radius && radius->size() == 1 && std::isfinite(radius->front()) && radius->front() > 0.0,
        ErrorKind::input, path,
        ": attribute sphere_radius must be one number > 0. Add it to the file.");
    radius_ = radius->front();
  }

  Grid grid() const;

 private:
  std::int64_t length(const std::string& dimension) const {
    const std::size_t n = file_.dimension(dimension).length;
    constexpr std::size_t kMost = 2147483646;  // ids are 32 bit
    DELOS_CHECK(n > 0 && n <= kMost, ErrorKind::input, file_.path(), ": dimension ", dimension,
                " is ", n, ", must be in [1, ", kMost, "].");
    return static_cast<std::int64_t>(n);
  }
  void check_shape(const std::string& name, std::int64_t rows, std::int64_t width) const;
  std::vector<double> numbers(const std::string& name, std::int64_t rows,
                              std::int64_t width = 1) const;
  std::vector<Index> ids(const std::string& name, std::int64_t rows, std::int64_t width,
                         std::int64_t n_targets) const;
  RowOffsets offsets(const std::string& name, std::int64_t rows, std::int64_t width) const;
  Array<double> measure(const std::string& name, std::int64_t rows) const;
  template <class T>
  static Ragged<T> pack(const RowOffsets& offsets, const std::vector<T>& padded);
  template <std::size_t kWidth, class T>
  static Array<std::array<T, kWidth>> rows_of(const std::vector<T>& values);
  void read_places(Grid& grid) const;
  void read_tables(Grid& grid) const;
  void read_measures(Grid& grid) const;
  Array<Vec3> positions(const std::string& entity, std::int64_t rows) const;
  Array<LonLat> lon_lats(const std::string& entity, std::int64_t rows) const;
  Array<double> spacing(const Grid& grid) const;

  netcdf::Reader file_;
  std::int64_t n_cells_ = 0, n_edges_ = 0, n_vertices_ = 0;
  double radius_ = 1.0;
};

void MpasTables::check_shape(const std::string& name, std::int64_t rows, std::int64_t width) const {
  const netcdf::Variable& variable = file_.variable(name);
  DELOS_CHECK(variable.n_values() == at(rows * width) &&
                  (variable.dimensions.empty() || variable.dimensions[0].length == at(rows)),
              ErrorKind::input, file_.path(), ": variable '", name, "' is ", variable.shape_text(),
              ", expected ", rows, " rows of ", width, ". The file is no MPAS mesh, or damaged.");
}

std::vector<double> MpasTables::numbers(const std::string& name, std::int64_t rows,
                                        std::int64_t width) const {
  check_shape(name, rows, width);
  std::vector<double> values = file_.read_double(name);
  const auto bad = std::find_if_not(values.begin(), values.end(),
                                    [](double value) { return std::isfinite(value); });
  DELOS_CHECK(bad == values.end(), ErrorKind::input, file_.path(), ": variable '", name,
              "' is not a number at row ", (bad - values.begin()) / width + 1,
              " (from 1). The file is damaged.");
  return values;
}

std::vector<Index> MpasTables::ids(const std::string& name, std::int64_t rows, std::int64_t width,
                                   std::int64_t n_targets) const {
  check_shape(name, rows, width);
  std::vector<Index> values = file_.read_int32(name);
  for (std::size_t i = 0; i < values.size(); ++i) {
    DELOS_CHECK(values[i] >= 0 && values[i] <= n_targets, ErrorKind::input, file_.path(),
                ": variable '", name, "' names ", values[i], " at row ",
                static_cast<std::int64_t>(i) / width + 1, " (from 1), outside 0..", n_targets,
                ". The file is damaged.");
    --values[i];
  }
  return values;
}

Array<double> MpasTables::measure(const std::string& name, std::int64_t rows) const {
  const std::vector<double> values = numbers(name, rows);
  return {values.begin(), values.end()};
}

RowOffsets MpasTables::offsets(const std::string& name, std::int64_t rows,
                               std::int64_t width) const {
  check_shape(name, rows, 1);
  const std::vector<std::int32_t> counts = file_.read_int32(name);
  Array<std::int64_t> result(at(rows) + 1, 0);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    DELOS_CHECK(counts[i] >= 0 && counts[i] <= width, ErrorKind::input, file_.path(),
                ": variable '", name, "' is ", counts[i], " at row ", i + 1,
                " (from 1), outside 0..", width, ". The file is damaged.");
    result[i + 1] = result[i] + counts[i];
  }
  return RowOffsets(std::move(result));
}

template <class T>
Ragged<T> MpasTables::pack(const RowOffsets& offsets, const std::vector<T>& padded) {
  const std::int64_t rows = offsets.n_rows();
  const auto width = static_cast<std::int64_t>(padded.size()) / rows;
  Ragged<T> result{offsets, Array<T>(at(offsets.n_values()))};
  for (std::int64_t i = 0; i < rows; ++i) {
    std::copy_n(padded.begin() + i * width, offsets.length_of(i), result.row(i).begin());
  }
  return result;
}

template <std::size_t kWidth, class T>
Array<std::array<T, kWidth>> MpasTables::rows_of(const std::vector<T>& values) {
  Array<std::array<T, kWidth>> rows(values.size() / kWidth);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(i * kWidth), kWidth, rows[i].begin());
  }
  return rows;
}

Array<Vec3> MpasTables::positions(const std::string& entity, std::int64_t rows) const {
  Array<Vec3> result(at(rows));
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> values = numbers(std::string(1, "xyz"[axis]) + entity, rows);
    for (std::size_t i = 0; i < values.size(); ++i) result[i][axis] = values[i] / radius_;
  }
  return result;
}

Array<LonLat> MpasTables::lon_lats(const std::string& entity, std::int64_t rows) const {
  const std::vector<double> lon = numbers("lon" + entity, rows);
  const std::vector<double> lat = numbers("lat" + entity, rows);
  Array<LonLat> result(at(rows));
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = {lon[i], lat[i]};
  return result;
}

void MpasTables::read_places(Grid& grid) const {
  grid.cell_position = positions("Cell", n_cells_);
  grid.edge_position = positions("Edge", n_edges_);
  grid.vertex_position = positions("Vertex", n_vertices_);
  grid.cell_lon_lat = lon_lats("Cell", n_cells_);
  grid.edge_lon_lat = lon_lats("Edge", n_edges_);
  grid.vertex_lon_lat = lon_lats("Vertex", n_vertices_);
}

void MpasTables::read_tables(Grid& grid) const {
  const std::int64_t width = length("maxEdges"), width2 = length("maxEdges2");
  const auto on_cell = offsets("nEdgesOnCell", n_cells_, width);
  grid.edges_on_cell = pack(on_cell, ids("edgesOnCell", n_cells_, width, n_edges_));
  grid.vertices_on_cell = pack(on_cell, ids("verticesOnCell", n_cells_, width, n_vertices_));
  grid.cells_on_cell = pack(on_cell, ids("cellsOnCell", n_cells_, width, n_cells_));
  grid.cells_on_edge = rows_of<2>(ids("cellsOnEdge", n_edges_, 2, n_cells_));
  grid.vertices_on_edge = rows_of<2>(ids("verticesOnEdge", n_edges_, 2, n_vertices_));
  grid.cells_on_vertex = rows_of<3>(ids("cellsOnVertex", n_vertices_, 3, n_cells_));
  grid.edges_on_vertex = rows_of<3>(ids("edgesOnVertex", n_vertices_, 3, n_edges_));
  const auto on_edge = offsets("nEdgesOnEdge", n_edges_, width2);
  grid.edges_on_edge = pack(on_edge, ids("edgesOnEdge", n_edges_, width2, n_edges_));
  grid.weights_on_edge = pack(on_edge, numbers("weightsOnEdge", n_edges_, width2));
}

void MpasTables::read_measures(Grid& grid) const {
  grid.cell_area_m2 = measure("areaCell", n_cells_);
  grid.triangle_area_m2 = measure("areaTriangle", n_vertices_);
  grid.kite_area_m2 = rows_of<3>(numbers("kiteAreasOnVertex", n_vertices_, 3));
  grid.cell_distance_m = measure("dcEdge", n_edges_);
  grid.vertex_distance_m = measure("dvEdge", n_edges_);
  grid.edge_angle_rad = measure("angleEdge", n_edges_);
  grid.cell_spacing_m = spacing(grid);
  if (file_.has_variable("delos_edge_spacing")) {
    grid.edge_spacing_m = measure("delos_edge_spacing", n_edges_);
  }
  const std::vector<std::int32_t> rings = read_rings(file_, n_cells_);
  grid.cell_ring.assign(rings.begin(), rings.end());
}

Array<double> MpasTables::spacing(const Grid& grid) const {
  for (const char* name : {"delos_spacing", "gridSpacing"}) {
    if (file_.has_variable(name)) return measure(name, n_cells_);
  }
  Array<double> mean(at(n_cells_), 0.0);
  for (std::int64_t cell = 0; cell < n_cells_; ++cell) {
    const auto edges = grid.edges_on_cell.row(cell);
    for (const Index edge : edges) {
      if (edge != kNone) mean[at(cell)] += grid.cell_distance_m[at(edge)];
    }
    mean[at(cell)] /= std::max<double>(1.0, static_cast<double>(edges.size()));
  }
  return mean;
}

Grid MpasTables::grid() const {
  Grid grid;
  grid.surface = Ellipsoid::sphere(radius_);
  read_places(grid);
  read_tables(grid);
  read_measures(grid);
  return grid;
}

}  // namespace

Grid read_mpas(const std::string& path) { return MpasTables(path).grid(); }

std::vector<Index> read_mpas_layers(const std::string& path) {
  const netcdf::Reader file(path);
  if (!file.has_variable("maxLevelCell")) return {};
  const std::vector<std::int32_t> out = file.read_int32("maxLevelCell");
  const auto n_cells = file.dimension("nCells").length;
  DELOS_CHECK(out.size() == n_cells, ErrorKind::input, path, ": maxLevelCell has ", out.size(),
              " values for ", n_cells, " cells.");
  const auto bad = std::find_if(out.begin(), out.end(), [](Index n) { return n < 0; });
  DELOS_CHECK(bad == out.end(), ErrorKind::input, path, ": maxLevelCell of cell ",
              bad - out.begin() + 1, " is ", *bad, ": levels count from 1, 0 is land.");
  return {out.begin(), out.end()};
}

std::string mpas_parent_id(const std::string& path) {
  const netcdf::Reader file(path);
  const std::string id = file.text_attribute("", "file_id").value_or("");
  const std::string older = file.text_attribute("", "parent_id").value_or("");
  return id.empty() || older.empty() ? id : id + "\n" + older;
}

}  // namespace delos
