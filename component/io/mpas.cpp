// SPDX-License-Identifier: BSD-3-Clause
#include "io/mpas.hpp"

#include <algorithm>
#include <functional>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/blocks.hpp"
#include "io/face_mesh.hpp"
#include "io/mpas_diagnostics.hpp"

namespace delos {
namespace {

using netcdf::DimensionId;
using netcdf::Type;
using netcdf::VariableId;

// Values that are gathered before they go to the file, a few megabytes, and rows at most.
constexpr std::int64_t kBlockValues = std::int64_t{1} << 20;
constexpr std::int64_t kBlockRows = 65536;
constexpr int kVertexDegree = 3;

template <class T>
constexpr Type type_of() {
  return std::is_same_v<T, double> ? Type::float64 : Type::int32;
}

std::int64_t levels_of(const MpasOptions& options) {
  if (options.ocean != nullptr) {
    return static_cast<std::int64_t>(options.ocean->interface_m.size()) - 1;
  }
  return options.terrain != nullptr ? options.terrain->n_levels : 0;
}

/// An MPAS file in the making: add() defines a variable and remembers how to fill it, finish()
/// fills all in the order of their definition, which is the order in the file.
class MpasFile {
 public:
  MpasFile(parallel::Executor& exec, const std::string& path, const Grid& grid,
           const MpasOptions& options)
      : exec_(exec), grid_(grid), file_(path, options.format) {
    const double radius_m = grid.surface.scale_m();
    unit_m_ = options.on_unit_sphere ? radius_m : 1.0;
    radius_ = radius_m / unit_m_;
    max_edges_ = longest_row(grid.edges_on_cell.offsets);
    cells_ = file_.define_dimension("nCells", at(grid.n_cells()));
    edges_ = file_.define_dimension("nEdges", at(grid.n_edges()));
    vertices_ = file_.define_dimension("nVertices", at(grid.n_vertices()));
    max_edges_dim_ = file_.define_dimension("maxEdges", max_edges_);
    max_edges2_dim_ = file_.define_dimension("maxEdges2", 2 * max_edges_);
    two_ = file_.define_dimension("TWO", 2);
    vertex_degree_ = file_.define_dimension("vertexDegree", kVertexDegree);
    time_ = file_.define_dimension("Time", netcdf::kUnlimited);
    n_levels_ = levels_of(options);
    if (n_levels_ == 0) return;
    levels_ = file_.define_dimension("nVertLevels", at(n_levels_));
    interfaces_ = file_.define_dimension("nVertLevelsP1", at(n_levels_ + 1));
  }

  void add_attributes(const Provenance& provenance);
  void add_places();
  void add_cell_tables();
  void add_edge_tables();
  void add_vertex_tables();
  void add_measures();
  void add_diagnostics();
  void add_rings();
  void add_layers(const MpasOceanLayers& layers);
  void add_layers(const MpasTerrainLayers& layers);
  void finish();

 private:
  /// fill(row, values): the `width` values of one row, zero before; rows side by side.
  template <class T>
  using Fill = std::function<void(std::int64_t, std::span<T>)>;
  template <class T>
  VariableId add_table(const std::string& name, DimensionId rows, DimensionId columns,
                       Fill<T> fill) {
    const auto id = file_.define_variable(name, type_of<T>(), {rows, columns});
    const Shape shape{n_of(rows), width_of(columns), 2};
    puts_.push_back([=, this] { put_rows<T>(id, shape, fill); });
    return id;
  }
  template <class T, class Value>
  VariableId add(const std::string& name, DimensionId rows, Value value) {
    const auto id = file_.define_variable(name, type_of<T>(), {rows});
    puts_.push_back([=, this] {
      put_rows<T>(id, {n_of(rows), 1, 1},
                  [&](std::int64_t i, std::span<T> out) { out[0] = static_cast<T>(value(i)); });
    });
    return id;
  }
  /// Of a variable: rank 1 [rows], 2 [rows, width], 3 [Time, rows, width] at the first time.
  struct Shape {
    std::int64_t rows;
    std::size_t width;
    std::size_t rank;
  };
  template <class T>
  void put_rows(VariableId id, const Shape& shape, const Fill<T>& fill);
  void explain(VariableId id, const char* units, const char* long_name) {
    file_.attribute(id, "units", units);
    file_.attribute(id, "long_name", long_name);
  }
  void add_ragged(const std::string& name, DimensionId rows, DimensionId columns,
                  const Ragged<Index>& table) {
    add_table<std::int32_t>(name, rows, columns,
                            [&table](std::int64_t i, std::span<std::int32_t> out) {
                              const auto row = table.row(i);
                              std::transform(row.begin(), row.end(), out.begin(), id_from_one);
                            });
  }
  template <std::size_t kWidth>
  void add_ids(const std::string& name, DimensionId rows, DimensionId columns,
               const Array<std::array<Index, kWidth>>& table) {
    add_table<std::int32_t>(name, rows, columns,
                            [&table](std::int64_t i, std::span<std::int32_t> out) {
                              const auto& row = table[at(i)];
                              std::transform(row.begin(), row.end(), out.begin(), id_from_one);
                            });
  }
  void add_place(const std::string& entity, DimensionId rows, const Array<Vec3>& position,
                 const Array<LonLat>& lon_lat);
  static std::int32_t id_from_one(Index id) { return id + 1; }

  std::int64_t n_of(DimensionId rows) const {
    return rows.id == cells_.id        ? grid_.n_cells()
           : rows.id == edges_.id      ? grid_.n_edges()
           : rows.id == levels_.id     ? n_levels_
           : rows.id == interfaces_.id ? n_levels_ + 1
                                       : grid_.n_vertices();
  }
  std::size_t width_of(DimensionId columns) const {
    return columns.id == max_edges_dim_.id    ? max_edges_
           : columns.id == max_edges2_dim_.id ? 2 * max_edges_
           : columns.id == two_.id            ? 2
           : columns.id == levels_.id         ? at(n_levels_)
           : columns.id == interfaces_.id     ? at(n_levels_ + 1)
                                              : kVertexDegree;
  }
  double length(double metres) const { return metres / unit_m_; }
  double area(double square_metres) const { return square_metres / (unit_m_ * unit_m_); }

  parallel::Executor& exec_;
  const Grid& grid_;
  netcdf::Writer file_;
  std::vector<std::function<void()>> puts_;
  double unit_m_ = 1.0;  // metres per unit of length of the file
  double radius_ = 1.0;  // of the sphere, in that unit
  std::size_t max_edges_ = 0;
  std::int64_t n_levels_ = 0;
  DimensionId cells_, edges_, vertices_, max_edges_dim_, max_edges2_dim_, two_, vertex_degree_;
  DimensionId time_, levels_, interfaces_;
};

template <class T>
void MpasFile::put_rows(VariableId id, const Shape& shape, const Fill<T>& fill) {
  const std::int64_t n = shape.rows;
  const auto width = static_cast<std::int64_t>(shape.width);
  const std::int64_t block_rows =
      std::min(kBlockRows, std::max(kBlockValues / width, std::int64_t{1}));
  const auto rows_of = [=](std::int64_t k) { return std::min(block_rows, n - k * block_rows); };
  const auto convert = [&](std::vector<T>& block, std::int64_t k) {
    block.assign(at(rows_of(k) * width), T{0});
    parallel::for_index(exec_, rows_of(k), kConvertGrain, [&](std::int64_t i) {
      fill(k * block_rows + i, std::span<T>(block.data() + at(i * width), shape.width));
    });
  };
  const auto put = [&](const std::vector<T>& block, std::int64_t k) {
    const std::array<std::size_t, 3> start = {0, at(k * block_rows), 0},
                                     count = {1, at(rows_of(k)), shape.width};
    const std::size_t first = shape.rank == 3 ? 0 : 1;
    file_.put_block(id, std::span(start).subspan(first, shape.rank),
                    std::span(count).subspan(first, shape.rank), std::span<const T>(block));
  };
  stream_blocks<std::vector<T>>(exec_, (n + block_rows - 1) / block_rows, convert, put);
}

void MpasFile::add_attributes(const Provenance& provenance) {
  const netcdf::VariableId all = netcdf::kGlobal;
  file_.attribute(all, "on_a_sphere", "YES");
  file_.attribute(all, "sphere_radius", radius_);
  file_.attribute(all, "is_periodic", "NO");
  file_.attribute(all, "mesh_spec", "1.0");
  file_.attribute(all, "Conventions", "MPAS");
  file_.attribute(all, "source", "delos " + provenance.version);
  file_.attribute(all, "file_id", file_id(provenance.digest));
  if (!provenance.parent_id.empty()) file_.attribute(all, "parent_id", provenance.parent_id);
  write_provenance(file_, provenance, {"nVertices", "nCells"});
}

void MpasFile::add_place(const std::string& entity, DimensionId rows, const Array<Vec3>& position,
                         const Array<LonLat>& lon_lat) {
  add<double>("lat" + entity, rows, [&](std::int64_t i) { return lon_lat[at(i)].lat_rad; });
  add<double>("lon" + entity, rows, [&](std::int64_t i) { return lon_lat[at(i)].lon_rad; });
  for (int axis = 0; axis < 3; ++axis) {
    add<double>(
        std::string(1, "xyz"[axis]) + entity, rows,
        [this, &position, axis](std::int64_t i) { return position[at(i)][axis] * radius_; });
  }
  add<std::int32_t>("indexTo" + entity + "ID", rows, [](std::int64_t i) { return i + 1; });
}

void MpasFile::add_places() {
  add_place("Cell", cells_, grid_.cell_position, grid_.cell_lon_lat);
  add_place("Edge", edges_, grid_.edge_position, grid_.edge_lon_lat);
  add_place("Vertex", vertices_, grid_.vertex_position, grid_.vertex_lon_lat);
}

void MpasFile::add_cell_tables() {
  add_ragged("cellsOnCell", cells_, max_edges_dim_, grid_.cells_on_cell);
  add_ragged("edgesOnCell", cells_, max_edges_dim_, grid_.edges_on_cell);
  add_ragged("verticesOnCell", cells_, max_edges_dim_, grid_.vertices_on_cell);
  add<std::int32_t>("nEdgesOnCell", cells_,
                    [this](std::int64_t i) { return grid_.edges_on_cell.row(i).size(); });
}

void MpasFile::add_edge_tables() {
  add_ragged("edgesOnEdge", edges_, max_edges2_dim_, grid_.edges_on_edge);
  add_ids("cellsOnEdge", edges_, two_, grid_.cells_on_edge);
  add_ids("verticesOnEdge", edges_, two_, grid_.vertices_on_edge);
  add<std::int32_t>("nEdgesOnEdge", edges_,
                    [this](std::int64_t i) { return grid_.edges_on_edge.row(i).size(); });
}

void MpasFile::add_vertex_tables() {
  add_ids("cellsOnVertex", vertices_, vertex_degree_, grid_.cells_on_vertex);
  add_ids("edgesOnVertex", vertices_, vertex_degree_, grid_.edges_on_vertex);
  add<std::int32_t>("boundaryVertex", vertices_, [this](std::int64_t i) {
    const auto& cells = grid_.cells_on_vertex[at(i)];
    return std::any_of(cells.begin(), cells.end(), [](Index cell) { return cell == kNone; });
  });
}

void MpasFile::add_measures() {
  const Grid& grid = grid_;
  add<double>("areaCell", cells_, [&](std::int64_t i) { return area(grid.cell_area_m2[at(i)]); });
  add<double>("angleEdge", edges_, [&](std::int64_t i) { return grid.edge_angle_rad[at(i)]; });
  add<double>("dcEdge", edges_,
              [&](std::int64_t i) { return length(grid.cell_distance_m[at(i)]); });
  add<double>("dvEdge", edges_,
              [&](std::int64_t i) { return length(grid.vertex_distance_m[at(i)]); });
  add_table<double>("weightsOnEdge", edges_, max_edges2_dim_,
                    [&grid](std::int64_t i, std::span<double> out) {
                      const auto row = grid.weights_on_edge.row(i);
                      std::copy(row.begin(), row.end(), out.begin());
                    });
  add<double>("areaTriangle", vertices_,
              [&](std::int64_t i) { return area(grid.triangle_area_m2[at(i)]); });
  add_table<double>("kiteAreasOnVertex", vertices_, vertex_degree_,
                    [this](std::int64_t i, std::span<double> out) {
                      const auto& kites = grid_.kite_area_m2[at(i)];
                      std::transform(kites.begin(), kites.end(), out.begin(),
                                     [this](double kite) { return area(kite); });
                    });
}

void MpasFile::add_diagnostics() {
  const Grid& grid = grid_;
  add<double>("cellQuality", cells_, [&](std::int64_t i) { return mpas::cell_quality(grid, i); });
  add<double>("gridSpacing", cells_,
              [&](std::int64_t i) { return length(mpas::mean_distance_m(grid, i)); });
  add<double>("triangleQuality", vertices_,
              [&](std::int64_t i) { return mpas::triangle_quality(grid, i); });
  add<double>("triangleAngleQuality", vertices_,
              [&](std::int64_t i) { return mpas::triangle_angle_quality(grid, i); });
  add<std::int32_t>("obtuseTriangle", vertices_,
                    [&](std::int64_t i) { return mpas::is_obtuse(grid, i); });
  const Array<double>& spacing = grid.cell_spacing_m;
  const double finest = spacing.empty() ? 0.0 : *std::min_element(spacing.begin(), spacing.end());
  add<double>("meshDensity", cells_, [&spacing, finest](std::int64_t i) {
    if (spacing.empty()) return 1.0;
    const double ratio = finest / spacing[at(i)];
    return ratio * ratio * ratio * ratio;
  });
  if (!spacing.empty()) {
    add<double>("delos_spacing", cells_,
                [this, &spacing](std::int64_t i) { return length(spacing[at(i)]); });
  }
  if (!grid.edge_spacing_m.empty()) {
    add<double>("delos_edge_spacing", edges_,
                [this, &grid](std::int64_t i) { return length(grid.edge_spacing_m[at(i)]); });
  }
}

void MpasFile::add_rings() {
  const Grid& grid = grid_;
  if (grid.cell_ring.empty()) return;
  explain(add<std::int32_t>("bdyMaskCell", cells_,
                            [&](std::int64_t i) { return grid.cell_ring[at(i)]; }),
          "1", "ring of the cell: 0 inside, then from there to the border");
  explain(
      add<std::int32_t>("bdyMaskEdge", edges_,
                        [&](std::int64_t i) { return ring_of(grid, grid.cells_on_edge[at(i)]); }),
      "1", "the innermost ring of the edge's cells");
  explain(
      add<std::int32_t>("bdyMaskVertex", vertices_,
                        [&](std::int64_t i) { return ring_of(grid, grid.cells_on_vertex[at(i)]); }),
      "1", "the innermost ring of the vertex's cells");
}

void MpasFile::add_layers(const MpasOceanLayers& layers) {
  const std::span<const double> z = layers.interface_m;
  explain(add<double>("refBottomDepth", levels_, [z](std::int64_t k) { return z[at(k) + 1]; }), "m",
          "depth of the bottom of each level where the sea is deeper");
  explain(add<double>("refZMid", levels_,
                      [z](std::int64_t k) { return -0.5 * (z[at(k)] + z[at(k) + 1]); }),
          "m", "height of the middle of each level, negative below the surface");
  explain(add<double>("refInterfaces", interfaces_, [z](std::int64_t k) { return z[at(k)]; }), "m",
          "depth of the interfaces between the levels");
  explain(add<double>("vertCoordMovementWeights", levels_, [](std::int64_t) { return 1.0; }), "1",
          "share of each level in the motion of the surface");
  explain(add<std::int32_t>("maxLevelCell", cells_,
                            [&layers](std::int64_t i) { return layers.n_layers[at(i)]; }),
          "1", "lowest level of the sea in each cell, from 1; 0 on land");
  explain(add<double>("bottomDepth", cells_,
                      [&layers](std::int64_t i) { return layers.bottom_depth_m[at(i)]; }),
          "m", "depth of the bottom of the sea, positive down");
  const Fill<double> thickness = [&layers](std::int64_t i, std::span<double> out) {
    for (std::size_t k = 0; k < out.size(); ++k) {
      out[k] = layers.thickness_m(i, static_cast<std::int64_t>(k));
    }
  };
  explain(add_table<double>("restingThickness", cells_, levels_, thickness), "m",
          "thickness of the layers of a sea at rest");
  const auto id = file_.define_variable("layerThickness", Type::float64, {time_, cells_, levels_});
  explain(id, "m", "thickness of the layers");
  const Shape shape{grid_.n_cells(), at(n_levels_), 3};
  puts_.push_back([=, this] { put_rows<double>(id, shape, thickness); });
}

void MpasFile::add_layers(const MpasTerrainLayers& layers) {
  explain(add<double>("ter", cells_, [&layers](std::int64_t i) { return layers.ground_m[at(i)]; }),
          "m", "height of the ground above sea level");
  explain(add_table<double>("zgrid", cells_, interfaces_,
                            [&layers](std::int64_t i, std::span<double> out) {
                              for (std::size_t k = 0; k < out.size(); ++k) {
                                out[k] = layers.height_m(i, static_cast<std::int64_t>(k));
                              }
                            }),
          "m", "height of the interfaces between the layers above sea level");
}

void MpasFile::finish() {
  file_.end_definitions();
  for (const auto& put : puts_) put();
  file_.close();
}

std::uint64_t size_bytes(std::int64_t n_cells, std::size_t max_edges, std::int64_t n_levels) {
  constexpr std::uint64_t kReal = 8, kId = 4, kPlace = 5 * kReal + kId;
  const std::uint64_t cell = kPlace + 5 * kReal + kId * (1 + 3 * max_edges);
  const std::uint64_t edge = kPlace + 4 * kReal + 5 * kId + 2 * max_edges * (kId + kReal);
  const std::uint64_t vertex = kPlace + 3 * (2 * kId + kReal) + 3 * kReal + 2 * kId;
  const std::uint64_t column = 2 * kReal * static_cast<std::uint64_t>(n_levels);
  return static_cast<std::uint64_t>(n_cells) * (cell + 3 * edge + 2 * vertex + column);
}

}  // namespace

void write_mpas(const std::string& path, const Grid& grid, const Provenance& provenance,
                const MpasOptions& options) {
  DELOS_CHECK(grid.surface.is_sphere(), ErrorKind::output, path,
              ": MPAS files know spheres only, "
              "this grid is on an ellipsoid. Map it to the sphere first, or write UGRID.");
  AtomicFile target(path, size_bytes(grid.n_cells(), longest_row(grid.edges_on_cell.offsets),
                                     levels_of(options)));
  parallel::Executor alone(1);
  parallel::Executor& exec = options.exec != nullptr ? *options.exec : alone;
  target.fill([&](const std::string& temporary) {
    MpasFile file(exec, temporary, grid, options);
    file.add_attributes(provenance);
    file.add_places();
    file.add_cell_tables();
    file.add_edge_tables();
    file.add_vertex_tables();
    file.add_measures();
    file.add_diagnostics();
    file.add_rings();
    if (options.ocean != nullptr) file.add_layers(*options.ocean);
    if (options.terrain != nullptr) file.add_layers(*options.terrain);
    file.finish();
  });
  target.commit();
}

std::uint64_t mpas_size_bytes(std::int64_t n_cells, std::int64_t n_levels) {
  constexpr std::size_t kUsualMaxEdges = 7;
  return size_bytes(n_cells, kUsualMaxEdges, n_levels);
}

}  // namespace delos
