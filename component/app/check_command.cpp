// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>

#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/loaded_grid.hpp"
#include "dual/edge_angles.hpp"
#include "dual/validate.hpp"
#include "lifecycle/culled.hpp"
#include "lifecycle/require.hpp"
#include "metrics/open_mesh.hpp"
#include "triangulation/validate.hpp"

namespace delos::app {
namespace {

// Files hold degrees or metres, so points come back to some units in the last place only.
constexpr double kSurfaceTolerance = 1e-9;
constexpr double kOwnTolerance = 1e-9;  // where the edges are not known
// MPAS-Tools computes in single precision here and there.
constexpr double kForeignTolerance = 1e-6;
constexpr std::size_t kMaxDefects = 20;

/// The other kinds have no place for what a certificate is about.
bool certifies(const FileOrigin& origin) {
  return origin.format == "MPAS" || origin.format == "UGRID";
}

/// What the file says about itself against what its arrays say.
void add_certificate_defects(Context& context, const LoadedGrid& loaded,
                             std::vector<std::string>& out) {
  const GridFile& file = loaded.file;
  if (file.origin.certificate && certifies(file.origin)) {
    std::vector<std::string> defects = visit_mesh(context, file, [&](const CertifiedMesh& mesh) {
      return certificate_defects(context, mesh, loaded.report.quality, *file.origin.certificate);
    });
    std::move(defects.begin(), defects.end(), std::back_inserter(out));
  } else if (!file.origin.digest.empty() && certifies(file.origin)) {
    out.emplace_back("the file has a digest by delos, but no certificate.");
  }
}

/// What the grid must meet: by the file's own configuration, then by the command line.
Requirements requirements_of(const Arguments& arguments, const FileOrigin& origin,
                             std::vector<std::string>& defects) {
  ConfigNode root;
  root.kind = ConfigNode::Kind::map;
  try {
    if (!origin.config.empty() && certifies(origin))
      root = parse_config(origin.config, "attribute delos_config");
    static_cast<void>(read_require(root));
  } catch (const Error& error) {
    defects.push_back(text("what was required can't be read: ", error.what()));
    root = ConfigNode{};
  }
  for (const auto& [key, value] : arguments.require) {
    override_config(root, "require." + key, value);
  }
  return read_require(root).bounds;
}

/// What is no defect but worth knowing.
using Notes = std::vector<std::string>;

/// A published definition beside ours: said, and no defect.
bool is_other_definition(Context& context, const Grid& grid, const BrokenRule& broken,
                         double tolerance, Notes& notes) {
  if (broken.rule != kEdgeAngleRule) return false;
  const auto found = angles_by_latitude(context, grid, tolerance);
  if (!found) return false;
  notes.push_back(
      text("the angles of edges are arccos(rise in latitude / length), as the converter "
           "of MPAS-Tools has them: up to ",
           found->worst_rad, " rad (edge ", found->worst_edge + 1,
           ") from the direction of the normal."));
  return true;
}

std::vector<std::string> defects_of(Context& context, const LoadedGrid& loaded, Notes& notes) {
  std::vector<std::string> out;
  const GridFile& file = loaded.file;
  if (file.mesh) {
    // Ties that rounding broke are no defect, so Delaunay is judged by the measured angles.
    const ValidateOptions options{kSurfaceTolerance, false, kMaxDefects};
    for (const Defect& defect : validate(*file.mesh, file.surface, options)) {
      out.push_back(defect.text);
    }
  }
  const std::int64_t n_illegal = loaded.report.quality.n_non_delaunay;
  if (n_illegal > 0) out.push_back(text(n_illegal, " sides are not Delaunay"));
  add_certificate_defects(context, loaded, out);
  if (loaded.grid.n_cells() == 0) return out;  // faces with a border
  const double tolerance = std::max(file.origin.digest.empty() ? kForeignTolerance : kOwnTolerance,
                                    rounding_tolerance(file.surface, loaded.report.quality));
  for (const BrokenRule& rule : check_grid(context, loaded.grid, tolerance)) {
    if (is_other_definition(context, loaded.grid, rule, tolerance, notes)) continue;
    out.push_back(to_string(rule));
  }
  return out;
}

std::string counted(std::size_t n, const char* what) {
  return text(n, " ", what, n == 1 ? "" : "s");
}

std::string verdict(std::size_t n_defects, std::size_t n_missed) {
  const std::string out = n_defects == 0 ? "sound" : counted(n_defects, "defect");
  return n_missed == 0 ? out : out + ", misses " + counted(n_missed, "requirement");
}

const char* certificate_note(const GridFile& file, bool is_sound) {
  if (!file.origin.certificate) return ", no certificate recorded";
  return is_sound && certifies(file.origin) ? ", as certified" : "";
}

/// Triangles with a border: no C-grid, so numbers and what no mesh may have.
int check_triangles(Context& context, GridFile file) {
  const TriangleSet& set = *file.triangles;
  const OpenMeshReport report = measure_open_mesh(file.surface, set.position, set.corners);
  std::vector<std::string> defects = report.defects;
  if (file.open_mesh && file.origin.certificate) {
    add_certificate_defects(context, load_grid(context, file), defects);
  }
  std::printf("%s", report_text(report).c_str());
  for (const std::string& defect : defects) std::printf("defect: %s\n", defect.c_str());
  std::printf("%s: %s (%s, %lld triangles with a border%s%s)\n\n", file.path.c_str(),
              verdict(defects.size(), 0).c_str(), file.origin.format.c_str(),
              static_cast<long long>(report.n_triangles),
              file.n_turned == 0 ? "" : ", clockwise in the file",
              file.open_mesh ? certificate_note(file, defects.empty()) : "");
  return defects.empty() ? kSuccess : kDefects;
}

int check_grid_file(Context& context, const Arguments& arguments, GridFile file) {
  LoadedGrid loaded = load_grid(context, std::move(file));
  Notes notes;
  std::vector<std::string> defects = defects_of(context, loaded, notes);
  const Requirements required = requirements_of(arguments, loaded.file.origin, defects);
  std::vector<std::string>& missed = loaded.report.missed;
  missed = missed_requirements(required, loaded.report.quality);
  std::printf("%s", report_text(loaded.report).c_str());
  for (const std::string& defect : defects) std::printf("defect: %s\n", defect.c_str());
  for (const std::string& note : notes) std::printf("note: %s\n", note.c_str());
  for (const std::string& sentence : missed) std::printf("missed: %s\n", sentence.c_str());
  std::printf("%s: %s (%s, %lld cells%s%s)\n\n", loaded.file.path.c_str(),
              verdict(defects.size(), missed.size()).c_str(), loaded.file.origin.format.c_str(),
              static_cast<long long>(loaded.report.quality.n_vertices),
              loaded.report.quality.has_border() ? ", with a border" : "",
              certificate_note(loaded.file, defects.empty()));
  if (!defects.empty()) return kDefects;
  return missed.empty() ? kSuccess : exit_status(ErrorKind::quality);
}

}  // namespace

int run_check(const Arguments& arguments, const std::atomic<bool>& cancel) {
  parallel::Executor exec(arguments.threads);
  Monitor monitor({}, {}, &cancel);
  Context context{exec, monitor};
  int status = kSuccess;
  for (const std::string& path : grid_files(arguments.file)) {
    GridFile file = read_grid_file(context, path);
    const bool is_triangles = file.triangles.has_value();
    const int found = is_triangles ? check_triangles(context, std::move(file))
                                   : check_grid_file(context, arguments, std::move(file));
    if (status == kSuccess || found == kDefects) status = found;
  }
  return status;
}

}  // namespace delos::app
