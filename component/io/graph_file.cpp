// SPDX-License-Identifier: BSD-3-Clause
#include "io/graph_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>

#include "core/error.hpp"
#include "io/atomic_file.hpp"

namespace delos {

void write_graph_info(const std::string& path, const Grid& grid) {
  constexpr std::size_t kFlushBytes = std::size_t{1} << 20;
  AtomicFile target(path);
  std::ofstream stream(target.temporary(), std::ios::binary | std::ios::trunc);
  const auto n_internal =
      std::count_if(grid.cells_on_edge.begin(), grid.cells_on_edge.end(),
                    [](const auto& cells) { return cells[0] != kNone && cells[1] != kNone; });
  std::string lines = text(grid.n_cells(), " ", n_internal, "\n");
  const auto append = [&lines](Index neighbour) {
    std::array<char, 16> digits{};
    const auto end = std::to_chars(digits.begin(), digits.end(), neighbour + 1).ptr;
    lines.append(digits.begin(), end);
    lines += ' ';
  };
  for (std::int64_t cell = 0; cell < grid.n_cells(); ++cell) {
    for (const Index neighbour : grid.cells_on_cell.row(cell)) {
      if (neighbour != kNone) append(neighbour);
    }
    lines += '\n';
    if (lines.size() < kFlushBytes && cell + 1 < grid.n_cells()) continue;
    stream.write(lines.data(), static_cast<std::streamsize>(lines.size()));
    lines.clear();
  }
  stream.close();
  DELOS_CHECK(stream.good(), ErrorKind::output, "can't write ", path,
              ": the disk may be full. Free some space, or choose another output folder.");
  target.commit();
}

}  // namespace delos
