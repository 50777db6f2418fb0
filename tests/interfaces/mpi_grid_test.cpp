// SPDX-License-Identifier: BSD-3-Clause
// Run by mpiexec with 1, 2, 3 and 4 processes; every case is collective.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <ctime>
#include <delos/mpi.hpp>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <thread>

#include "mpi_support.hpp"

using delos::Location;
using delos::mpi::DistributedGrid;
using namespace mpi_support;

namespace {

constexpr char kSmall[] =
    "sizing: {sources: [{type: constant, spacing: 600 km}]}\n"
    "refine: {tile_vertices: 500}\n";
constexpr Location kLocations[] = {Location::cell, Location::edge, Location::vertex};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

delos::Config small() { return delos::Config::from_text(kSmall); }

delos::mpi::Options options(int halo_layers = 1, int root = 0) {
  delos::mpi::Options out;
  out.generate.threads = 2;
  out.root = root;
  out.halo_layers = halo_layers;
  return out;
}

DistributedGrid small_grid(const delos::mpi::Options& how = options()) {
  return delos::mpi::generate(MPI_COMM_WORLD, small, how);
}

/// A number that says which entity and which component it is of.
double mark(std::int32_t id, int component) { return 1000.0 * id + component + 0.125; }

template <class Number>
std::vector<Number> marked(const DistributedGrid& grid, Location at, int n_components,
                           bool with_halo) {
  std::vector<Number> out;
  const auto ids = grid.local().global_id(at);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const bool is_known = with_halo || static_cast<std::int64_t>(i) < grid.local().n_owned(at);
    for (int c = 0; c < n_components; ++c) {
      out.push_back(static_cast<Number>(is_known ? mark(ids[i], c) : -1.0));
    }
  }
  return out;
}

template <class Number>
void check_exchange(const DistributedGrid& grid, Location at, int n_components) {
  auto values = marked<Number>(grid, at, n_components, false);
  grid.exchange(std::span<Number>(values), at, n_components);
  CHECK((values == marked<Number>(grid, at, n_components, true)));
}

std::span<const std::int32_t> row(std::span<const std::int64_t> offsets,
                                  std::span<const std::int32_t> ids, std::size_t i) {
  return ids.subspan(static_cast<std::size_t>(offsets[i]),
                     static_cast<std::size_t>(offsets[i + 1] - offsets[i]));
}

/// A table of local ids as global ones, in doubles, rows filled up with -1.
std::vector<double> global_table(std::span<const std::int64_t> offsets,
                                 std::span<const std::int32_t> ids,
                                 std::span<const std::int32_t> global_id, std::size_t width) {
  std::vector<double> out((offsets.size() - 1) * width, -1.0);
  for (std::size_t i = 0; i + 1 < offsets.size(); ++i) {
    const auto from = row(offsets, ids, i);
    for (std::size_t j = 0; j < from.size(); ++j) {
      const bool is_local = from[j] >= 0;
      const std::int32_t id = global_id.empty() ? from[j]
                              : is_local        ? global_id[static_cast<std::size_t>(from[j])]
                                                : -1;
      out[i * width + j] = id;
    }
  }
  return out;
}

std::vector<std::int64_t> even_offsets(std::size_t n_values, std::int64_t width) {
  std::vector<std::int64_t> out{0};
  while (out.back() < static_cast<std::int64_t>(n_values)) out.push_back(out.back() + width);
  return out;
}

/// Gathers a table and compares it with the whole grid's, bit for bit.
class Union {
 public:
  explicit Union(const DistributedGrid& grid) : grid_(grid), local_(grid.local()) {}

  void compare(Location at, std::span<const double> part, std::span<const double> all) const {
    const auto n = static_cast<std::size_t>(local_.n_local(at));
    REQUIRE(part.size() % n == 0);
    const std::vector<double> gathered = grid_.gather(part, at, static_cast<int>(part.size() / n));
    if (rank() != grid_.root()) {
      CHECK(gathered.empty());
      return;
    }
    REQUIRE(gathered.size() == all.size());
    const auto same = [](double a, double b) {
      return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
    };
    CHECK(std::equal(all.begin(), all.end(), gathered.begin(), same));
  }

  struct Table {
    std::span<const std::int64_t> offsets;
    std::span<const std::int32_t> ids;
  };
  void compare(Location at, Location of, const Table& part, const Table& all) const {
    constexpr std::size_t kWidest = 24;  // edges on an edge: two cells of at most 12 edges
    compare(at, global_table(part.offsets, part.ids, local_.global_id(of), kWidest),
            rank() == grid_.root() ? global_table(all.offsets, all.ids, {}, kWidest)
                                   : std::vector<double>());
  }
  void compare_rows(Location at, Location of, std::span<const std::int32_t> part,
                    std::span<const std::int32_t> all) const {
    const auto n = static_cast<std::size_t>(local_.n_local(at));
    const auto width = static_cast<std::int64_t>(part.size() / n);
    const auto offsets = even_offsets(part.size(), width), whole = even_offsets(all.size(), width);
    compare(at, of, Table{offsets, part}, Table{whole, all});
  }

 private:
  const DistributedGrid& grid_;
  const delos::LocalGrid& local_;
};

/// `whole` is the serial grid on the root.
void compare_with(const DistributedGrid& grid, const std::optional<delos::Grid>& whole) {
  const Union all(grid);
  const delos::LocalGrid& own = grid.local();
#define DELOS_COMPARE(at, name) \
  all.compare(Location::at, own.name(), whole ? whole->name() : std::span<const double>())
  DELOS_COMPARE(cell, cell_position);
  DELOS_COMPARE(cell, cell_lon_lat);
  DELOS_COMPARE(cell, cell_area_m2);
  DELOS_COMPARE(cell, cell_spacing_m);
  DELOS_COMPARE(edge, edge_position);
  DELOS_COMPARE(edge, edge_lon_lat);
  DELOS_COMPARE(edge, cell_distance_m);
  DELOS_COMPARE(edge, vertex_distance_m);
  DELOS_COMPARE(edge, edge_angle_rad);
  DELOS_COMPARE(edge, edge_spacing_m);
  DELOS_COMPARE(vertex, vertex_position);
  DELOS_COMPARE(vertex, vertex_lon_lat);
  DELOS_COMPARE(vertex, triangle_area_m2);
  DELOS_COMPARE(vertex, kite_area_m2);
#undef DELOS_COMPARE
#define DELOS_COMPARE(at, of, name)                        \
  all.compare_rows(Location::at, Location::of, own.name(), \
                   whole ? whole->name() : std::span<const std::int32_t>())
  DELOS_COMPARE(edge, cell, cells_on_edge);
  DELOS_COMPARE(edge, vertex, vertices_on_edge);
  DELOS_COMPARE(vertex, cell, cells_on_vertex);
  DELOS_COMPARE(vertex, edge, edges_on_vertex);
#undef DELOS_COMPARE
#define DELOS_COMPARE(at, of, offsets, name)                                       \
  all.compare(Location::at, Location::of, Union::Table{own.offsets(), own.name()}, \
              whole ? Union::Table{whole->offsets(), whole->name()} : Union::Table{})
  DELOS_COMPARE(cell, edge, cell_offsets, edges_on_cell);
  DELOS_COMPARE(cell, vertex, cell_offsets, vertices_on_cell);
  DELOS_COMPARE(cell, cell, cell_offsets, cells_on_cell);
  DELOS_COMPARE(edge, edge, edge_offsets, edges_on_edge);
#undef DELOS_COMPARE
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(own.radii_m()[i] == doctest::Approx(6371220.0));
    CHECK(own.centre_m()[i] == 0.0);
  }
}

}  // namespace

TEST_CASE("what the processes own is the serial grid, bit for bit") {
  for (const int root : {0, n_ranks() - 1}) {
    const DistributedGrid grid = small_grid(options(1, root));
    std::optional<delos::Grid> serial;
    if (rank() == root) serial = delos::generate(small(), {.threads = 1});
    compare_with(grid, serial);
    CHECK(grid.root() == root);
    CHECK(grid.generation() == 1);
    CHECK(is_same_everywhere(grid.digest()));
    CHECK(is_same_everywhere(grid.config_text()));
    if (serial) CHECK(grid.digest() == serial->digest());
    CHECK(grid.local().part() == rank());
    CHECK(grid.local().n_parts() == n_ranks());
    CHECK_FALSE(grid.whole());
    for (const Location at : kLocations) {
      // A halo of one layer is small, and no process has the rest.
      if (n_ranks() > 1) CHECK(grid.local().n_local(at) < grid.local().n_global(at));
      const std::int64_t owned = grid.local().n_owned(at);
      std::int64_t sum = 0;
      MPI_Allreduce(&owned, &sum, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
      CHECK(sum == grid.local().n_global(at));
    }
  }
}

TEST_CASE("the whole grid stays on the generating process when it is asked to") {
  delos::mpi::Options how = options();
  how.keep_whole_grid = true;
  const DistributedGrid grid = small_grid(how);
  CHECK(grid.whole().has_value() == (rank() == 0));
  if (grid.whole()) CHECK(grid.whole()->digest() == grid.digest());
}

TEST_CASE("an exchange sets the halo to the owners' values") {
  for (const int halo_layers : {1, 2, 3}) {
    delos::mpi::Options how = options(halo_layers);
    how.method =
        halo_layers == 2 ? delos::PartitionMethod::curve : delos::PartitionMethod::automatic;
    const DistributedGrid grid = small_grid(how);
    CHECK(grid.local().halo_layers() == halo_layers);
    for (const Location at : kLocations) {
      check_exchange<double>(grid, at, 1);
      check_exchange<double>(grid, at, 3);
      check_exchange<float>(grid, at, 2);
      check_exchange<std::int32_t>(grid, at, 1);
    }
  }
}

TEST_CASE("gather and scatter are each other's reverse, and owners' values win") {
  const DistributedGrid grid = small_grid();
  for (const Location at : kLocations) {
    for (const int n_components : {1, 2}) {
      auto values = marked<double>(grid, at, n_components, true);
      const auto n_owned = static_cast<std::size_t>(grid.local().n_owned(at) * n_components);
      for (std::size_t i = n_owned; i < values.size(); ++i) values[i] = kNan;
      const auto whole = grid.gather(values, at, n_components);
      const auto again = grid.gather(std::span(values).first(n_owned), at, n_components);
      CHECK((whole == again));
      if (rank() == 0) {
        REQUIRE(static_cast<std::int64_t>(whole.size()) ==
                grid.local().n_global(at) * n_components);
        bool are_right = true;
        for (std::size_t i = 0; i < whole.size(); ++i) {
          const auto id = static_cast<std::int32_t>(i) / n_components;
          are_right = are_right && whole[i] == mark(id, static_cast<int>(i) % n_components);
        }
        CHECK(are_right);
      }
      CHECK(
          (grid.scatter(whole, at, n_components) == marked<double>(grid, at, n_components, true)));
    }
  }
}

TEST_CASE("a field moves to another distribution of the same grid, and to no other grid") {
  const DistributedGrid from = small_grid();
  delos::mpi::Options how = options(2);
  how.method = delos::PartitionMethod::curve;
  how.cell_weight = [](const delos::Grid& grid) {
    std::vector<double> layers(static_cast<std::size_t>(grid.n_cells()));
    for (std::size_t i = 0; i < layers.size(); ++i) {
      layers[i] = std::max(0.0, std::floor(40.0 * grid.cell_position()[3 * i + 2]));
    }
    return layers;
  };
  const DistributedGrid to = small_grid(how);
  for (const Location at : kLocations) {
    CHECK((from.redistribute(marked<double>(from, at, 2, false), to, at, 2) ==
           marked<double>(to, at, 2, true)));
  }
  const DistributedGrid other = delos::mpi::generate(
      MPI_COMM_WORLD,
      [] {
        delos::Config config = small();
        config.set("sizing.sources.0.spacing", "900 km");
        return config;
      },
      options());
  const std::string refused = thrown([&] {
    static_cast<void>(
        from.redistribute(marked<double>(from, Location::cell, 1, true), other, Location::cell));
  });
  CHECK(begins(refused, "state: redistribute to another grid"));
}

TEST_CASE("a failure on the generating process is thrown by all, with its text") {
  using delos::mpi::generate;
  const auto all_throw = [&](const std::string& beginning, const std::function<delos::Config()>& by,
                             const delos::mpi::Options& how) {
    CAPTURE(beginning);
    const std::string found = thrown([&] { static_cast<void>(generate(MPI_COMM_WORLD, by, how)); });
    CHECK_MESSAGE(begins(found, beginning), found);
    CHECK(is_same_everywhere(found));
  };
  all_throw(
      "config: world.yaml:1 sizng: unknown key",
      [] { return delos::Config::from_text("sizng: {}\n", "world.yaml"); }, options());
  all_throw(
      "input: the configuration /nowhere/x.yaml can't be opened",
      [] { return delos::Config::from_file("/nowhere/x.yaml"); }, options());
  delos::mpi::Options how = options();
  const std::atomic<bool> cancel{true};
  how.generate.cancel = &cancel;
  all_throw("cancelled: ", small, how);
  how = options();
  how.cell_weight = [](const delos::Grid&) { return std::vector<double>{1.0}; };
  all_throw("config: there are 1 cell weights", small, how);
  how.cell_weight = [](const delos::Grid&) { return std::vector<double>(); };
  all_throw("config: cell_weight gave no weights", small, how);
  all_throw("config: halo_layers = 0: must be between 1 and", small, options(0));
  all_throw("config: root = -1: must be a rank", small, options(1, -1));
  all_throw("config: root = " + std::to_string(n_ranks()), small, options(1, n_ranks()));
  // What is no Error comes back as it was thrown, and as Error(internal) elsewhere.
  const std::string found = thrown([] {
    static_cast<void>(generate(
        MPI_COMM_WORLD, []() -> delos::Config { throw std::runtime_error("the host's own"); },
        options()));
  });
  CHECK(found == (rank() == 0 ? "other: the host's own" : "internal: the host's own"));
  // And nothing is left behind that a next grid could stumble over.
  CHECK(small_grid().local().n_owned(Location::cell) > 0);
}

TEST_CASE("options that differ between processes are refused by all") {
  if (n_ranks() == 1) return;
  for (const auto& how : {options(1 + rank() % 2), options(1, rank() % 2)}) {
    CHECK(begins(thrown([&] { static_cast<void>(small_grid(how)); }),
                 "config: the processes gave different roots or halo layers"));
  }
}

TEST_CASE("fields of a wrong size or place are refused") {
  const DistributedGrid grid = small_grid();
  std::vector<double> values(3);
  CHECK(begins(thrown([&] { grid.exchange(std::span(values), Location::cell); }),
               "input: the field has 3 values, but "));
  CHECK(begins(thrown([&] { grid.exchange(std::span(values), Location::cell, 0); }), "input: "));
  CHECK(begins(thrown([&] { grid.exchange(std::span(values), Location::lat_lon); }),
               "config: location \"lat_lon\""));
  // One process is wrong, all are told.
  auto field = marked<double>(grid, Location::edge, 1, true);
  if (rank() == n_ranks() - 1) field.pop_back();
  const auto refused = thrown([&] { static_cast<void>(grid.gather(field, Location::edge)); });
  CHECK(begins(refused, "input: the field has "));
  CHECK(is_same_everywhere(refused));
  CHECK(begins(thrown([&] { static_cast<void>(grid.scatter({}, Location::cell)); }),
               "input: the field has 0 values"));
}

TEST_CASE("groups of processes have grids of their own, and outsiders are told so") {
  MPI_Comm half = MPI_COMM_NULL;
  MPI_Comm_split(MPI_COMM_WORLD, rank() == 0 ? MPI_UNDEFINED : rank() % 2, 0, &half);
  const auto make = [&] { return delos::mpi::generate(half, small, options()); };
  if (half == MPI_COMM_NULL) {
    CHECK(begins(thrown([&] { static_cast<void>(make()); }),
                 "state: the communicator is MPI_COMM_NULL"));
  } else {
    const DistributedGrid grid = make();
    int size = 0;
    MPI_Comm_size(half, &size);
    CHECK(grid.local().n_parts() == size);
    check_exchange<double>(grid, Location::edge, 1);
    MPI_Comm_free(&half);
  }
}

TEST_CASE("processes that wait sleep") {
  const std::clock_t before = std::clock();
  const DistributedGrid grid = delos::mpi::generate(
      MPI_COMM_WORLD,
      [] {
        std::this_thread::sleep_for(std::chrono::milliseconds(1500));
        return small();
      },
      options());
  const double used_s = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  if (rank() != 0) CHECK(used_s < 0.4);
}

TEST_CASE("no process but the generating one holds more than its part" * doctest::skip()) {
  // By the kernel's count of the most memory that a process ever had.
  const auto peak_kib = [] {
    std::ifstream file("/proc/self/status");
    for (std::string line; std::getline(file, line);) {
      if (begins(line, "VmHWM:")) return std::stol(line.substr(6));
    }
    return 0L;
  };
  delos::mpi::Options how = options();
  how.keep_whole_grid = true;
  const long before_kib = peak_kib();
  const DistributedGrid grid = delos::mpi::generate(
      MPI_COMM_WORLD,
      [] { return delos::Config::from_text("generator: icosahedral\nsubdivisions: 80\n"); }, how);
  const long grown_kib = peak_kib() - before_kib;
  std::int64_t n_whole_bytes = 0;
  if (grid.whole()) {
    const delos::LocalGrid whole = delos::Partition(*grid.whole(), {.n_parts = 1}).part(0);
    for (const auto buffer : whole.buffers()) {
      n_whole_bytes += static_cast<std::int64_t>(buffer.size());
    }
  }
  MPI_Bcast(&n_whole_bytes, 1, MPI_INT64_T, grid.root(), MPI_COMM_WORLD);
  CAPTURE(grown_kib);
  CAPTURE(n_whole_bytes);
  CHECK(n_whole_bytes > 30'000'000);
  // A quarter of the grid, its halo, and what MPI takes for messages.
  if (rank() != grid.root()) CHECK(grown_kib * 1024 < n_whole_bytes / 2);
}

TEST_CASE("a thread that may not call MPI is refused") {
  std::string found;
  std::thread([&] { found = thrown([] { static_cast<void>(small_grid()); }); }).join();
  CHECK(begins(found, "state: this thread may not call MPI"));
}

TEST_CASE("more processes than cells are refused" * doctest::skip()) {
  const std::string found = thrown([] {
    static_cast<void>(delos::mpi::generate(
        MPI_COMM_WORLD,
        [] { return delos::Config::from_text("generator: icosahedral\nsubdivisions: 1\n"); },
        options()));
  });
  CHECK_MESSAGE(begins(found, "config: the grid has 12 cells, too few for"), found);
}

int main(int argc, char** argv) {
  const auto refused = [&](const std::string& beginning) {
    const std::string found = thrown([] { static_cast<void>(small_grid()); });
    if (begins(found, beginning)) return 0;
    std::fprintf(stderr, "expected \"%s\", found \"%s\"\n", beginning.c_str(), found.c_str());
    return 1;
  };
  int failed = refused("state: MPI is not initialized");
  int level = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  failed += doctest::Context(argc, argv).run();
  MPI_Finalize();
  return failed + refused("state: MPI has been finalized");
}
