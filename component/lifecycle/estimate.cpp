// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/estimate.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/mpas.hpp"
#include "io/ugrid.hpp"

namespace delos {
namespace {

namespace fs = std::filesystem;

constexpr double kMaxCells = 7e8;  // two triangles a cell stay within 32-bit ids, with room
// Peaks, bytes a cell, a tenth above what was measured: triangulation with its work space (174 at
// 9.2 M cells), and what C-grid tables, weights and the writers add (960 at 0.66 M cells, and 24
// for the spacing at the edges).
constexpr double kMeshBytes = 190.0;
constexpr double kDualBytes = 1090.0;
constexpr double kReportBytes = 1e6;
constexpr double kGraphBytes = 50.0;  // a cell: six neighbours of up to eight digits
constexpr double kPartBytes = 6.0;    // a cell and partition: a number and a line end

double read_number(const char* path) {
  std::ifstream file(path);
  double value = 0.0;
  return file >> value ? value : std::numeric_limits<double>::infinity();
}

double system_available_bytes() {
  std::ifstream file("/proc/meminfo");
  std::string key, unit;
  double kib = 0.0;
  while (file >> key >> kib) {
    std::getline(file, unit);
    if (key == "MemAvailable:") return 1024.0 * kib;
  }
  return std::numeric_limits<double>::infinity();
}

std::string gib(double bytes) {
  constexpr double kGib = 1024.0 * 1024.0 * 1024.0;
  return text(std::ceil(bytes / kGib * 10.0) / 10.0, " GiB");
}

}  // namespace

Estimate estimate_cost(const Settings& settings, double n_cells, bool with_dual) {
  Estimate out;
  out.n_cells = n_cells;
  out.memory_bytes = n_cells * (kMeshBytes + (with_dual ? kDualBytes : 0.0));
  // An MPAS file of an ellipsoid is written from a copy of the grid carried to the sphere.
  if (with_dual && settings.output.mpas && !settings.surface.is_sphere()) {
    out.memory_bytes += n_cells * kDualBytes;
  }
  const auto count = static_cast<std::int64_t>(std::min(n_cells, kMaxCells));
  const OutputSettings& output = settings.output;
  const std::int64_t n_levels = settings.layers ? settings.layers->n_levels() : 0;
  out.disk_bytes = kReportBytes;
  if (output.mpas) out.disk_bytes += static_cast<double>(mpas_size_bytes(count, n_levels));
  if (output.ugrid_triangles) {
    out.disk_bytes += static_cast<double>(ugrid_triangles_size_bytes(count));
  }
  // Half as many faces with twice the corners: about the same.
  if (output.ugrid_cells) out.disk_bytes += static_cast<double>(ugrid_triangles_size_bytes(count));
  out.disk_bytes += kPartBytes * static_cast<double>(count) *
                    static_cast<double>(output.partitions.n_parts.size());
  if (output.graph) out.disk_bytes += kGraphBytes * static_cast<double>(count);
  return out;
}

std::string describe(const Estimate& estimate) {
  return text("about ", std::round(estimate.n_cells), " cells, ", gib(estimate.memory_bytes),
              " of memory, ", gib(estimate.disk_bytes), " on disk");
}

void check_estimate(const Estimate& estimate, double available_bytes) {
  DELOS_CHECK(estimate.n_cells <= kMaxCells, ErrorKind::resource, "the spacing asks for about ",
              estimate.n_cells, " cells and ", gib(estimate.memory_bytes),
              " of memory; at most 7e8 cells fit 32-bit ids. Use a larger spacing, or set ",
              "sizing.cells to the number of cells that you want.");
  DELOS_CHECK(estimate.memory_bytes <= available_bytes, ErrorKind::resource,
              "the spacing asks for ", describe(estimate), ", but only ", gib(available_bytes),
              " of memory are available. Use a larger spacing, fewer sizing.cells, or only the "
              "output format ugrid_triangles, which needs no dual.");
}

void check_table(double resolution_rad, double available_bytes) {
  // Rows from pole to pole, twice as many columns; sources, smoothing and the limiter work in the
  // table and one more of its size (17 bytes a node measured at 0.05 degrees).
  constexpr double kNodeBytes = 20.0;
  const double rows = std::ceil(kPi / resolution_rad);
  const double n_nodes = 2.0 * rows * (rows + 1.0);
  DELOS_CHECK(n_nodes * kNodeBytes <= available_bytes, ErrorKind::resource,
              "sizing.resolution: a table of spacings every ", resolution_rad * kDegPerRad,
              " degrees has ", n_nodes, " nodes and needs ", gib(n_nodes * kNodeBytes),
              " of memory, but only ", gib(available_bytes),
              " are available. Ask for a coarser resolution.");
}

double available_memory_bytes() {
  const double group_left = read_number("/sys/fs/cgroup/memory.max") -
                            std::min(read_number("/sys/fs/cgroup/memory.current"), 1e18);
  return std::min(system_available_bytes(), group_left);
}

void check_output_folder(const std::string& directory, double disk_bytes) {
  std::error_code ignored;
  fs::path folder = fs::absolute(directory).lexically_normal();
  while (!fs::exists(fs::symlink_status(folder, ignored)) && folder.has_relative_path()) {
    folder = folder.parent_path();
  }
  DELOS_CHECK(fs::is_directory(folder, ignored), ErrorKind::output,
              "output.directory = ", directory, ": ", folder.string(),
              " is no folder. Choose another directory (-o).");
  check_free_space(folder, static_cast<std::uint64_t>(disk_bytes));
  const AtomicFile probe(folder / "delos-probe");  // removed again when it is left uncommitted
}

}  // namespace delos
