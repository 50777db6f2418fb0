// SPDX-License-Identifier: BSD-3-Clause
#include <delos/delos.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <delos/delos.hpp>
#include <filesystem>
#include <new>
#include <span>
#include <stdexcept>
#include <string>

#include "support/temporary_folder.hpp"

namespace {

constexpr char kSmall[] =
    "sizing: {sources: [{type: constant, spacing: 600 km}]}\n"
    "refine: {tile_vertices: 500}\n";

/// A context with the small configuration.
struct Host {
  delos_context* context = nullptr;
  delos_config* config = nullptr;
  Host() {
    REQUIRE(delos_context_create(&context) == DELOS_SUCCESS);
    REQUIRE(delos_config_from_text(context, kSmall, nullptr, nullptr, &config) == DELOS_SUCCESS);
  }
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;
  ~Host() { delos_context_destroy(context); }
};

}  // namespace

TEST_CASE("C and C++ get the same grid") {
  const Host host;
  delos_grid* grid = nullptr;
  REQUIRE(delos_generate(host.context, host.config, &grid) == DELOS_SUCCESS);
  const delos::Grid other = delos::generate(delos::Config::from_text(kSmall));
  const char* digest = nullptr;
  REQUIRE(delos_grid_digest(grid, &digest) == DELOS_SUCCESS);
  CHECK(other.digest() == digest);

  const double* area_m2 = nullptr;
  std::int64_t size = 0;
  REQUIRE(delos_grid_cell_area_m2(grid, &area_m2, &size) == DELOS_SUCCESS);
  CHECK(std::ranges::equal(other.cell_area_m2(), std::span(area_m2, std::size_t(size))));
  const std::int32_t* edges = nullptr;
  REQUIRE(delos_grid_edges_on_edge(grid, &edges, &size) == DELOS_SUCCESS);
  CHECK(std::ranges::equal(other.edges_on_edge(), std::span(edges, std::size_t(size))));
  delos_certificate certificate;
  REQUIRE(delos_grid_certificate(grid, &certificate) == DELOS_SUCCESS);
  CHECK(certificate.stagger_max.id == other.certificate().stagger_max.id);
  CHECK(certificate.angle_max_deg.lon_rad == other.certificate().angle_max_deg.lon_rad);
}

TEST_CASE("what a callback throws becomes a status of the C function") {
  const Host host;
  delos_grid* grid = nullptr;
  delos_context_set_progress(
      host.context, [](const delos_progress*, void*) { throw std::runtime_error("host trouble"); },
      nullptr);
  CHECK(delos_generate(host.context, host.config, &grid) == DELOS_ERROR_INTERNAL);
  CHECK(std::string(delos_last_error(host.context)) == "delos_generate: host trouble");
  delos_context_set_progress(
      host.context, [](const delos_progress*, void*) { throw 7; }, nullptr);
  CHECK(delos_generate(host.context, host.config, &grid) == DELOS_ERROR_INTERNAL);
  CHECK(grid == nullptr);
  delos_context_set_progress(
      host.context, [](const delos_progress*, void*) { throw std::bad_alloc(); }, nullptr);
  CHECK(delos_generate(host.context, host.config, &grid) == DELOS_ERROR_RESOURCE);
  CHECK(std::string(delos_last_error(host.context)) == "out of memory");
}

TEST_CASE("two C contexts in one process do not meet") {
  const Host one, two;
  delos_context_cancel(one.context);
  delos_grid* grid = nullptr;
  CHECK(delos_generate(two.context, two.config, &grid) == DELOS_SUCCESS);
  CHECK(std::string(delos_last_error(two.context)).empty());
  CHECK(delos_generate(one.context, two.config, &grid) == DELOS_ERROR_CANCELLED);
}

TEST_CASE("C writes the files that C++ writes") {
  const Host host;
  delos_grid* grid = nullptr;
  REQUIRE(delos_config_set(host.config, "output.formats", "[ugrid_cells]") == DELOS_SUCCESS);
  REQUIRE(delos_generate(host.context, host.config, &grid) == DELOS_SUCCESS);
  const delos::testing::TemporaryFolder folder;
  const char* paths = nullptr;
  REQUIRE(delos_grid_write_outputs(grid, folder.file("all").c_str(), &paths) == DELOS_SUCCESS);
  std::string wanted;
  auto config = delos::Config::from_text(kSmall);
  config.set("output.formats", "[ugrid_cells]");
  for (const std::string& path : delos::generate(config).write_outputs(folder.file("all"))) {
    CHECK(std::filesystem::exists(path));
    wanted += path + "\n";
  }
  CHECK(wanted.find("ugrid_cells.nc\n") != std::string::npos);
  CHECK(paths == wanted);
}
