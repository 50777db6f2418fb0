// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "app/commands.hpp"
#include "app/exit_status.hpp"
#include "app/loaded_grid.hpp"
#include "dual/validate.hpp"
#include "triangulation/validate.hpp"

namespace delos::app {
namespace {

// Files hold degrees or metres, so points come back to some units in the last place only.
constexpr double kSurfaceTolerance = 1e-9;
constexpr double kOwnTolerance = 1e-9;
// MPAS-Tools computes in single precision here and there.
constexpr double kForeignTolerance = 1e-6;
constexpr std::size_t kMaxDefects = 20;

std::vector<std::string> defects_of(Context& context, const LoadedGrid& loaded) {
  std::vector<std::string> out;
  const GridFile& file = loaded.file;
  if (file.mesh) {
    // Ties that rounding broke are no defect, so Delaunay is judged by the measured angles.
    const ValidateOptions options{kSurfaceTolerance, false, kMaxDefects};
    for (const Defect& defect : validate(*file.mesh, file.surface, options)) {
      out.push_back(defect.text);
    }
    const std::int64_t n_illegal = loaded.report.quality.n_non_delaunay;
    if (n_illegal > 0) out.push_back(text(n_illegal, " sides are not Delaunay"));
  }
  const double tolerance = file.origin.digest.empty() ? kForeignTolerance : kOwnTolerance;
  for (const BrokenRule& rule : check_grid(context, loaded.grid, tolerance)) {
    out.push_back(to_string(rule));
  }
  return out;
}

}  // namespace

int run_check(const Arguments& arguments, const std::atomic<bool>& cancel) {
  parallel::Executor exec(arguments.threads);
  Monitor monitor({}, {}, &cancel);
  Context context{exec, monitor};
  int status = kSuccess;
  for (const std::string& path : grid_files(arguments.file)) {
    const LoadedGrid loaded = load_grid(context, path);
    const std::vector<std::string> defects = defects_of(context, loaded);
    if (loaded.file.mesh) std::printf("%s", report_text(loaded.report).c_str());
    for (const std::string& defect : defects) std::printf("defect: %s\n", defect.c_str());
    std::printf("%s: %s (%s, %lld cells%s)\n\n", path.c_str(),
                defects.empty() ? "sound" : text(defects.size(), " kinds of defect").c_str(),
                loaded.file.origin.format.c_str(), static_cast<long long>(loaded.grid.n_cells()),
                loaded.file.mesh ? "" : ", with a border: the triangulation is not measured");
    if (!defects.empty()) status = kDefects;
  }
  return status;
}

}  // namespace delos::app
