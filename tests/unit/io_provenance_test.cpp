// SPDX-License-Identifier: BSD-3-Clause
#include "io/provenance.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <set>

#include "support/expect_error.hpp"
#include "support/sample_grids.hpp"
#include "support/temporary_folder.hpp"

using delos::ErrorKind;
using delos::Provenance;
using delos::testing::expect_error;
using delos::testing::TemporaryFolder;

TEST_CASE("an input is described by the SHA-256 of its bytes") {
  const TemporaryFolder folder;
  const auto input = delos::describe_input(folder.write("abc", "abc"));
  CHECK(input.sha256 == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  expect_error(ErrorKind::input, {"nowhere", "Check the path"},
               [&] { delos::describe_input(folder.file("nowhere")); });
}

TEST_CASE("the history line is in UTC, leap days included") {
  CHECK(delos::history_line(0, "x") == "1970-01-01T00:00:00Z: x");
  CHECK(delos::history_line(951782399, "x") == "2000-02-28T23:59:59Z: x");
  CHECK(delos::history_line(951782400, "x") == "2000-02-29T00:00:00Z: x");
  CHECK(delos::history_line(4107542400, "x") == "2100-03-01T00:00:00Z: x");
  CHECK(delos::history_line(-1, "x") == "1969-12-31T23:59:59Z: x");
}

TEST_CASE("SOURCE_DATE_EPOCH fixes the time of the history") {
  ::unsetenv("SOURCE_DATE_EPOCH");
  CHECK(delos::history_time(7) == 7);
  ::setenv("SOURCE_DATE_EPOCH", "12345", 1);
  CHECK(delos::history_time(7) == 12345);
  ::setenv("SOURCE_DATE_EPOCH", "yesterday", 1);
  expect_error(ErrorKind::config, {"SOURCE_DATE_EPOCH", "'yesterday'"},
               [] { delos::history_time(7); });
  ::unsetenv("SOURCE_DATE_EPOCH");
}

TEST_CASE("the file id is ten alphanumerics that depend on the digest alone") {
  std::set<std::string> seen;
  for (const char c : std::string("0123456789abcdef")) {
    const std::string id = delos::file_id(std::string(64, c));
    CHECK(id.size() == 10);
    CHECK(id.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyz") == std::string::npos);
    CHECK(id == delos::file_id(std::string(64, c)));
    seen.insert(id);
  }
  CHECK(seen.size() == 16);
}

TEST_CASE("provenance is read back as it was written") {
  const TemporaryFolder folder;
  const Provenance written = delos::samples::provenance();
  {
    delos::netcdf::Writer file(folder.file("a.nc"), delos::netcdf::Format::cdf5);
    delos::write_provenance(file, written);
    file.end_definitions();
    file.close();
  }
  const Provenance read = delos::read_provenance(delos::netcdf::Reader(folder.file("a.nc")));
  CHECK(read.version == written.version);
  CHECK(read.config == written.config);
  CHECK(read.digest == written.digest);
  CHECK(read.history == written.history);
  REQUIRE(read.inputs.size() == 2);
  CHECK(read.inputs[0].path == "depth of the sea.nc");
  CHECK(read.inputs[1].sha256 == written.inputs[1].sha256);
  REQUIRE(read.certificate);
  CHECK(read.certificate->min_relative_edge == 0.7);
  CHECK(read.certificate->min_dual_ratio == 0.25);
}
