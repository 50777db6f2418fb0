// SPDX-License-Identifier: BSD-3-Clause
#include "io/part_file.hpp"

#include <array>
#include <charconv>

#include "core/error.hpp"
#include "io/atomic_file.hpp"

namespace delos {

std::string part_file_ending(std::int64_t n_parts) { return text("graph.info.part.", n_parts); }

void write_parts(const std::string& path, std::span<const Index> part_of_cell) {
  constexpr std::size_t kUsualBytes = 5;  // a line, of some thousand parts
  std::string lines;
  lines.reserve(kUsualBytes * part_of_cell.size());
  for (const Index part : part_of_cell) {
    std::array<char, 16> digits{};
    lines.append(digits.begin(), std::to_chars(digits.begin(), digits.end(), part).ptr);
    lines += '\n';
  }
  write_text_atomically(path, lines);
}

}  // namespace delos
