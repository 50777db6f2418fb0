// SPDX-License-Identifier: BSD-3-Clause
#include "partition/kway.hpp"

#include "core/error.hpp"

#ifdef DELOS_HAVE_METIS
#include <metis.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>
#endif

namespace delos::kway {

#ifdef DELOS_HAVE_METIS
namespace {

// Any number does; it must stay the same.
constexpr idx_t kSeed = 1;

/// METIS draws from the C library's rand(), which is its host's: it gets a state of its own here,
/// and the host's sequence goes on afterwards as if nothing had happened.
class OwnRandomState {
 public:
  OwnRandomState() : host_(initstate(kSeed, own_.data(), own_.size())) {}
  ~OwnRandomState() { setstate(host_); }
  OwnRandomState(const OwnRandomState&) = delete;
  OwnRandomState& operator=(const OwnRandomState&) = delete;

 private:
  std::array<char, 128> own_{};  // the size of the C library's own state
  char* host_;
};

/// Whole numbers in proportion to the weights: themselves where they are whole and their sum is
/// small enough for METIS to add up.
std::vector<idx_t> whole_weights(std::span<const double> weight) {
  constexpr double kLargestSum = 1 << 30;  // METIS multiplies sums by 1.03 in 32 bits
  constexpr double kSteps = 1 << 20;       // of the largest weight, when they are not whole
  double sum = 0.0, largest = 0.0;
  bool are_whole = true;
  for (const double w : weight) {
    sum += w;
    largest = std::max(largest, w);
    are_whole = are_whole && w == std::floor(w);
  }
  const double finest = are_whole ? 1.0 : kSteps / largest;
  const double scale = std::min(finest, kLargestSum / sum);
  std::vector<idx_t> out;
  out.reserve(weight.size());
  for (const double w : weight) out.push_back(static_cast<idx_t>(std::floor(w * scale + 0.5)));
  return out;
}

/// Whether each cell can be reached from the first.
bool is_connected(const std::vector<idx_t>& offsets, const std::vector<idx_t>& neighbours) {
  std::vector<bool> is_reached(offsets.size() - 1, false);
  std::vector<std::size_t> front{0};
  is_reached[0] = true;
  std::size_t n_reached = 1;
  while (!front.empty()) {
    const std::size_t cell = front.back();
    front.pop_back();
    for (auto k = static_cast<std::size_t>(offsets[cell]);
         k < static_cast<std::size_t>(offsets[cell + 1]); ++k) {
      const auto next = static_cast<std::size_t>(neighbours[k]);
      if (is_reached[next]) continue;
      is_reached[next] = true;
      ++n_reached;
      front.push_back(next);
    }
  }
  return n_reached == is_reached.size();
}

}  // namespace

bool is_available() { return true; }

std::vector<Index> partition(const Grid& grid, Index n_parts, std::span<const double> weight) {
  constexpr auto kMost = static_cast<std::int64_t>(std::numeric_limits<idx_t>::max());
  DELOS_CHECK(2 * grid.n_edges() <= kMost, ErrorKind::resource, "the grid has ", grid.n_cells(),
              " cells with more neighbours than METIS can count (", kMost,
              "): use the partition method \"curve\".");
  std::vector<idx_t> offsets{0}, neighbours;
  offsets.reserve(static_cast<std::size_t>(grid.n_cells()) + 1);
  neighbours.reserve(2 * static_cast<std::size_t>(grid.n_edges()));
  for (Index cell = 0; cell < grid.n_cells(); ++cell) {
    for (const Index neighbour : grid.cells_on_cell.row(cell)) {
      if (neighbour != kNone) neighbours.push_back(neighbour);  // else the cell is at a border
    }
    offsets.push_back(static_cast<idx_t>(neighbours.size()));
  }
  std::vector<idx_t> weights = whole_weights(weight);
  std::vector<idx_t> part(static_cast<std::size_t>(grid.n_cells()));
  idx_t n_cells = static_cast<idx_t>(grid.n_cells()), n_constraints = 1, parts = n_parts, cut = 0;
  std::array<idx_t, METIS_NOPTIONS> options{};
  METIS_SetDefaultOptions(options.data());
  options[METIS_OPTION_NUMBERING] = 0;
  options[METIS_OPTION_SEED] = kSeed;
  // A part in two pieces has a longer border; METIS refuses the wish where the grid has pieces.
  options[METIS_OPTION_CONTIG] = is_connected(offsets, neighbours) ? 1 : 0;
  const OwnRandomState random;
  const int status =
      METIS_PartGraphKway(&n_cells, &n_constraints, offsets.data(), neighbours.data(),
                          weights.empty() ? nullptr : weights.data(), nullptr, nullptr, &parts,
                          nullptr, nullptr, options.data(), &cut, part.data());
  DELOS_CHECK(status == METIS_OK, ErrorKind::resource, "METIS could not cut ", n_cells,
              " cells into ", n_parts, " parts (status ", status,
              "): it probably lacked memory; use the partition method \"curve\".");
  return {part.begin(), part.end()};
}

#else

bool is_available() { return false; }

std::vector<Index> partition(const Grid& grid, Index n_parts, std::span<const double> weight) {
  static_cast<void>(grid);
  static_cast<void>(n_parts);
  static_cast<void>(weight);
  throw Error(ErrorKind::config,
              "the partition method is \"kway\", but this library was built without METIS: use "
              "\"curve\", or install METIS (libmetis-dev) and build delos anew.");
}

#endif

}  // namespace delos::kway
