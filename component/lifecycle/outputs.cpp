// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/outputs.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>

#include "core/error.hpp"
#include "dual/build.hpp"
#include "geometry/conformal.hpp"
#include "io/atomic_file.hpp"
#include "io/esmf_mesh.hpp"
#include "io/fesom.hpp"
#include "io/gmsh.hpp"
#include "io/graph_file.hpp"
#include "io/jigsaw.hpp"
#include "io/mpas.hpp"
#include "io/part_file.hpp"
#include "io/provenance.hpp"
#include "io/scrip.hpp"
#include "io/spacing_file.hpp"
#include "io/ugrid.hpp"
#include "io/vtu.hpp"
#include "lifecycle/culled.hpp"
#include "lifecycle/edge_spacing.hpp"
#include "lifecycle/require.hpp"
#include "lifecycle/version.hpp"
#include "triangulation/flip.hpp"

namespace delos {
namespace {

namespace fs = std::filesystem;

constexpr char kRejectedJson[] = ".rejected.report.json";
constexpr char kRejectedText[] = ".rejected.report.txt";

std::int64_t now_s() {
  return std::chrono::duration_cast<std::chrono::seconds>(
             std::chrono::system_clock::now().time_since_epoch())
      .count();
}

FileExtreme file_extreme(const Extreme& extreme) {
  FileExtreme out;
  out.value = extreme.value;
  out.ids = {extreme.id, extreme.other};
  out.lon_lat_deg = {extreme.where.lon_rad * kDegPerRad, extreme.where.lat_rad * kDegPerRad};
  return out;
}

Provenance provenance_of(const OutputContent& content) {
  const FileNotes& notes = content.notes;
  Provenance out;
  out.version = library_version();
  out.config = content.settings.text;
  out.digest = notes.digest;
  for (const InputRecord& file : notes.inputs) out.inputs.push_back({file.path, file.sha256});
  out.history = history_now(notes.command);
  out.certificate = file_certificate(notes.certificate);
  return out;
}

/// The certificate of the grid as it was carried to a sphere, which is not that of the original.
Certificate certify_carried(Context& context, const Settings& settings, const Quality& quality) {
  const std::string missed =
      missed_message("the grid on the sphere of equal area, which MPAS needs,", settings,
                     missed_requirements(settings.require.bounds, quality));
  DELOS_CHECK(missed.empty() || settings.require.keep, ErrorKind::quality, missed,
              " Nothing was written.");
  if (!missed.empty()) context.monitor.log(LogLevel::warning, missed);
  return certificate(quality);
}

/// The grid on the sphere of equal area. The map keeps angles (or, on Earth, nearly), so that the
/// same triangles are Delaunay there but for ties, which flips settle.
Grid carry_to_sphere(Context& context, const OutputContent& content, Provenance& provenance) {
  const Ellipsoid& surface = content.settings.surface;
  const SphereMap map(surface);
  const Ellipsoid sphere = map.sphere();
  Mesh mesh = content.mesh;
  constexpr std::int64_t kVerticesPerTask = 4096;  // some milliseconds
  parallel::for_index(context.exec, mesh.n_vertices(), kVerticesPerTask, [&](std::int64_t i) {
    Vertex& vertex = mesh.vertices[static_cast<std::size_t>(i)];
    const Vec3 p = vertex.position();
    const Vec3 image = map(p);
    vertex = {image.x(), image.y(), image.z(), vertex.spacing * map.stretch(p)};
  });
  const std::int64_t n_flips = restore_delaunay_everywhere(context.exec, mesh, sphere);
  const Vec3 radii_m = surface.scale_m() * surface.radii();
  provenance.history +=
      text("\ncarried from the ellipsoid with radii ", radii_m.x(), " ", radii_m.y(), " ",
           radii_m.z(), " m to the sphere of equal area, ",
           map.kind() == SphereMapKind::conformal ? "angles" : "longitudes and latitudes",
           " kept; sides flipped: ", n_flips);
  context.monitor.check_cancelled();
  Grid grid = build_grid(context, sphere, LatitudeKind::geocentric, mesh);
  grid.edge_spacing_m = spacing_at_edges(
      context.exec, {surface, content.spacing, content.mesh.vertices}, grid.cells_on_edge,
      [&](const Vec3& p) { return map.stretch(p) * sphere.scale_m(); });
  Quality quality;
  if (content.domain == nullptr) {
    const SideSpacing spacing =
        spacing_by_side(mesh, {grid.cells_on_edge, EdgeEnds::vertices, grid.edge_spacing_m},
                        grid.surface.scale_m());
    quality = measure_quality(context, grid.surface, spacing, mesh, grid.latitude);
  } else {
    cull_to_cells(context, content.domain->cells, grid);
    grid.cell_ring = content.grid->cell_ring;
    quality = measure_culled(context, grid);
  }
  provenance.certificate = file_certificate(certify_carried(context, content.settings, quality));
  return grid;
}

std::int64_t n_levels(const Settings& settings) {
  return settings.layers ? settings.layers->n_levels() : 0;
}

/// Layers as MPAS files have them.
class MpasColumns {
 public:
  explicit MpasColumns(const Layers* layers) : layers_(layers) {
    if (layers_ == nullptr) return;
    if (layers_->ocean) {
      const domain::Stack& stack = *layers_->ocean;
      ocean_ = {stack.levels.interface_m, stack.n_layers, stack.bottom_depth_m,
                [&stack](std::int64_t cell, std::int64_t k) { return stack.thickness_m(cell, k); }};
    } else {
      const domain::TerrainLayers& terrain = *layers_->terrain;
      terrain_ = {
          terrain.n_levels(), terrain.ground_m,
          [&terrain](std::int64_t cell, std::int64_t k) { return terrain.height_m(cell, k); }};
    }
  }
  /// The options refer to this from then on.
  void show(MpasOptions& options) const {
    if (layers_ == nullptr) return;
    if (layers_->ocean) {
      options.ocean = &ocean_;
    } else {
      options.terrain = &terrain_;
    }
  }

 private:
  const Layers* layers_;
  MpasOceanLayers ocean_;  // the one that there is
  MpasTerrainLayers terrain_;
};

void write_mpas_file(Context& context, const OutputContent& content, const std::string& path) {
  DELOS_ASSERT(content.grid != nullptr);
  const OutputSettings& output = content.settings.output;
  MpasOptions options{output.compress ? netcdf::Format::netcdf4 : netcdf::Format::cdf5,
                      output.unit_sphere, &context.exec};
  const MpasColumns columns(content.layers);
  columns.show(options);
  Provenance provenance = provenance_of(content);
  if (content.settings.surface.is_sphere()) {
    write_mpas(path, *content.grid, provenance, options);
  } else {
    const Grid grid = carry_to_sphere(context, content, provenance);
    write_mpas(path, grid, provenance, options);
  }
}

netcdf::Format format_of(const OutputContent& content) {
  return content.settings.output.compress ? netcdf::Format::netcdf4 : netcdf::Format::cdf5;
}

UgridOptions ugrid_options(Context& context, const OutputContent& content) {
  // CDO's bounds double the file, and no such tool opens grids of this size.
  constexpr Index kMaxVerticesWithBounds = 50'000'000;
  return {format_of(content), content.mesh.n_vertices() <= kMaxVerticesWithBounds, &context.exec};
}

/// Of a culled grid the triangles alone, with a certificate of these.
void write_ugrid_triangles_file(Context& context, const OutputContent& content,
                                const std::string& path) {
  const UgridSurface surface{content.settings.surface, content.settings.latitude, &content.spacing};
  Provenance provenance = provenance_of(content);
  if (content.domain == nullptr) {
    return write_ugrid_triangles(path, content.mesh, surface, provenance,
                                 ugrid_options(context, content));
  }
  const CulledMesh part(context.exec, *content.grid, CulledMesh::Part::triangles);
  provenance.certificate = file_certificate(certificate(measure_quality(context, part.subject())));
  write_ugrid_triangles(path, part.subject().mesh, surface, provenance,
                        ugrid_options(context, content));
}

/// Of a culled grid the wet part, without points of no triangle, as FESOM2 wants it; with the
/// depths of an ocean's layers.
TriangleSet wet_triangles(parallel::Executor& exec, const OutputContent& content) {
  const Settings& settings = content.settings;
  const bool is_culled = content.domain != nullptr;
  const Mesh part = is_culled ? triangles_of(exec, *content.grid) : Mesh();
  TriangleSet set =
      triangle_set(settings.surface, settings.latitude, is_culled ? part : content.mesh);
  if (content.layers != nullptr && content.layers->ocean) {
    const domain::Stack& stack = *content.layers->ocean;
    set.depth_m.assign(stack.bottom_depth_m.begin(), stack.bottom_depth_m.end());
    set.level_m = stack.levels.interface_m;
  }
  if (is_culled) drop_lone_points(set);
  return set;
}

/// Folders made on the way to `directory`, removed again unless kept.
class NewFolders {
 public:
  explicit NewFolders(const fs::path& directory) {
    fs::path folder = fs::absolute(directory).lexically_normal();
    std::error_code error;
    for (; !folder.empty() && !fs::exists(folder, error); folder = folder.parent_path()) {
      made_.push_back(folder);
    }
    fs::create_directories(directory, error);
    DELOS_CHECK(!error, ErrorKind::output, "the folder ", directory.string(),
                " can't be made: ", error.message(), ". Choose another directory.");
  }
  ~NewFolders() {
    std::error_code ignored;
    for (const fs::path& folder : made_) fs::remove(folder, ignored);
  }
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;
  void keep() { made_.clear(); }

 private:
  std::vector<fs::path> made_;  // deepest first
};

/// The files of settings.output one after the other.
class OutputWriter {
 public:
  OutputWriter(Context& context, const OutputContent& content, const fs::path& directory)
      : context_(context), content_(content), directory_(directory) {}

  void write_grids() {
    const OutputSettings& output = content_.settings.output;
    const std::int64_t n_cells =
        content_.domain != nullptr ? content_.grid->n_cells() : content_.mesh.n_vertices();
    const std::uint64_t ugrid_bytes =
        ugrid_triangles_size_bytes(n_cells, ugrid_options(context_, content_));
    if (output.mpas)
      write_grid(FileKind::mpas, "mpas.nc", mpas_size_bytes(n_cells, n_levels(content_.settings)));
    if (output.ugrid_triangles) {
      write_grid(FileKind::ugrid_triangles, "ugrid_triangles.nc", ugrid_bytes);
    }
    if (output.ugrid_cells) write_grid(FileKind::ugrid_cells, "ugrid_cells.nc", ugrid_bytes);
    for (const FileKind kind : output.more) {
      if (kind == FileKind::fesom) {
        write_fesom_folder();
      } else {
        write_grid(kind, file_ending(kind), ugrid_bytes);
      }
    }
    if (output.graph) {
      add("graph.info", [&](const std::string& path) { write_graph_info(path, *content_.grid); });
    }
    for (const GridPartition& made : content_.partitions) {
      add(part_file_ending(made.n_parts),
          [&](const std::string& path) { write_parts(path, made.part_of_cell); });
    }
  }

  void write_notes() {
    const OutputSettings& output = content_.settings.output;
    if (output.spacing && content_.spacing_table_m != nullptr) {
      add("spacing.nc", [&](const std::string& path) {
        write_spacing(path, *content_.spacing_table_m, provenance_of(content_));
      });
    }
    for (const std::string& picture : output.pictures) {
      if (!content_.draw) break;
      add(picture + ".png", [&](const std::string& path) { content_.draw(picture, path); });
    }
    if (output.report) {
      add_text("report.json", content_.notes.report_json);
      add_text("report.txt", content_.notes.report_text);
    }
  }

  std::vector<std::string> commit() {
    context_.monitor.check_cancelled();
    files_.commit();
    if (fesom_folder_) fesom_folder_->keep();
    // What was said about an earlier grid of this name would be taken for this one.
    std::error_code ignored;
    for (const char* const kind : {kRejectedJson, kRejectedText}) {
      fs::remove(directory_ / text(content_.settings.output.name, kind), ignored);
    }
    return paths_;
  }

 private:
  void add(const std::string& kind, const std::function<void(const std::string&)>& write,
           std::uint64_t bytes = 0) {
    add_path(directory_ / text(content_.settings.output.name, ".", kind), write, bytes);
  }
  void add_path(const fs::path& path, const std::function<void(const std::string&)>& write,
                std::uint64_t bytes) {
    context_.monitor.check_cancelled();
    files_.add(path, bytes, write);
    paths_.push_back(path.string());
    context_.monitor.advance(1);
  }
  void add_text(const std::string& kind, const std::string& value) {
    add(kind, [&](const std::string& path) { write_text_atomically(path, value); });
  }
  void write_fesom_folder() {
    const TriangleSet set = wet_triangles(context_.exec, content_);
    const std::string folder = text(content_.settings.output.name, ".fesom");
    fesom_folder_.emplace(directory_ / folder);
    for (const FesomFile& file : fesom_files(set)) {
      add_path(directory_ / folder / file.name, file.write, 0);
    }
  }
  void write_grid(FileKind kind, const std::string& name, std::uint64_t bytes) {
    add(
        name, [&](const std::string& path) { write_grid_file(context_, content_, kind, path); },
        bytes);
  }

  Context& context_;
  const OutputContent& content_;
  fs::path directory_;
  std::optional<NewFolders> fesom_folder_;  // outlives its files
  OutputSet files_;
  std::vector<std::string> paths_;
};

}  // namespace

FileCertificate file_certificate(const Certificate& certificate) {
  FileCertificate out;
  out.well_centred = certificate.well_centred;
  out.n_obtuse = static_cast<std::int32_t>(certificate.n_obtuse);
  out.angle_max_deg = file_extreme(certificate.angle_max_deg);
  out.dual_ratio_min = file_extreme(certificate.dual_ratio_min);
  out.stagger_max = file_extreme(certificate.stagger_max);
  if (certificate.relative_edge_min) {
    out.relative_edge_min = file_extreme(*certificate.relative_edge_min);
  }
  return out;
}

std::string history_now(const std::string& command) {
  return history_line(history_time(now_s()), command);
}

std::vector<std::string> write_outputs(Context& context, const OutputContent& content,
                                       const std::string& directory) {
  const OutputSettings& output = content.settings.output;
  const std::int64_t n_files = output.mpas + output.ugrid_triangles + output.ugrid_cells +
                               output.graph + output.spacing + 2 * output.report +
                               static_cast<std::int64_t>(output.more.size()) +
                               static_cast<std::int64_t>(content.partitions.size()) +
                               static_cast<std::int64_t>(output.pictures.size());
  const Phase phase(context.monitor, "write", n_files);
  NewFolders folders(directory);
  OutputWriter writer(context, content, directory);
  writer.write_grids();
  writer.write_notes();
  std::vector<std::string> paths = writer.commit();
  folders.keep();
  return paths;
}

void write_grid_file(Context& context, const OutputContent& content, FileKind kind,
                     const std::string& path) {
  const netcdf::Format format = format_of(content);
  const auto triangles = [&] { return wet_triangles(context.exec, content); };
  switch (kind) {
    case FileKind::mpas:
      write_mpas_file(context, content, path);
      return;
    case FileKind::ugrid_triangles:
      return write_ugrid_triangles_file(context, content, path);
    case FileKind::ugrid_cells:
      DELOS_ASSERT(content.grid != nullptr);
      write_ugrid_cells(path, *content.grid, provenance_of(content),
                        ugrid_options(context, content));
      return;
    case FileKind::scrip:
      return write_scrip(path, *content.grid, provenance_of(content), {format, &context.exec});
    case FileKind::esmf:
      return write_esmf_mesh(path, *content.grid, provenance_of(content), {format, &context.exec});
    case FileKind::vtu:
      return write_vtu_cells(path, *content.grid);
    case FileKind::gmsh:
      return write_gmsh(path, triangles());
    case FileKind::jigsaw:
      return write_jigsaw(path, triangles());
    case FileKind::fesom:
      return write_fesom(path, triangles());
  }
}

std::string write_rejected_report(const OutputSettings& output, const FileNotes& notes,
                                  const std::string& directory) {
  NewFolders folders(directory);
  OutputSet files;
  const fs::path json = fs::path(directory) / (output.name + kRejectedJson);
  const fs::path screen = fs::path(directory) / (output.name + kRejectedText);
  files.add(json, 0,
            [&](const std::string& path) { write_text_atomically(path, notes.report_json); });
  files.add(screen, 0,
            [&](const std::string& path) { write_text_atomically(path, notes.report_text); });
  files.commit();
  folders.keep();
  return screen.string();
}

}  // namespace delos
