// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/partitions.hpp"

#include <cmath>

#include "core/error.hpp"
#include "partition/kway.hpp"

namespace delos {
namespace {

/// A value with so many decimals, without the zeros at the end.
double rounded(double value, double scale) { return std::round(value * scale) / scale; }

}  // namespace

void check_partitions(const PartitionWishes& wishes, double n_cells) {
  for (const std::int64_t n_parts : wishes.n_parts) {
    DELOS_CHECK(static_cast<double>(n_parts) <= n_cells, ErrorKind::config,
                "output.partitions asks for ", n_parts, " parts of a grid of about ",
                std::round(n_cells), " cells: ask for fewer parts or a finer grid.");
  }
  DELOS_CHECK(
      wishes.n_parts.empty() || wishes.method != PartitionMethod::kway || kway::is_available(),
      ErrorKind::config,
      "output.partition_method is kway, but this library was built without METIS: use "
      "curve, or install METIS (libmetis-dev) and build delos anew.");
}

std::vector<GridPartition> make_partitions(Context& context, const Grid& grid,
                                           const PartitionWishes& wishes,
                                           std::span<const double> weight) {
  std::vector<GridPartition> out;
  if (wishes.n_parts.empty()) return out;
  const Phase phase(context.monitor, "partition", static_cast<std::int64_t>(wishes.n_parts.size()));
  for (const std::int64_t n_parts : wishes.n_parts) {
    context.monitor.check_cancelled();
    Partitioned made = partition_by(context.exec, grid, {n_parts, wishes.method, weight});
    const PartitionBalance balance = measure_partition(grid, made.part_of_cell, n_parts, weight);
    out.push_back({n_parts, made.method, std::move(made.part_of_cell), balance});
    context.monitor.advance(1);
  }
  return out;
}

ReportPartition report_entry(const GridPartition& partition) {
  const PartitionBalance& balance = partition.balance;
  return {partition.n_parts,   to_string(partition.method),
          balance.n_cut_edges, balance.cut_share,
          balance.heaviest,    balance.lightest};
}

std::string describe(const GridPartition& partition) {
  return text(partition.n_parts, " parts (", to_string(partition.method),
              "): ", rounded(100.0 * partition.balance.cut_share, 100.0),
              " % of the edges cut, heaviest ", rounded(partition.balance.heaviest, 1000.0),
              " and lightest ", rounded(partition.balance.lightest, 1000.0), " of the mean");
}

}  // namespace delos
