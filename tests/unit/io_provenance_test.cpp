// SPDX-License-Identifier: BSD-3-Clause
#include "io/provenance.hpp"

#include <doctest/doctest.h>

#include <cstdlib>
#include <limits>
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
    delos::write_provenance(file, written, {"nTriangles", "nPoints"});
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
}

namespace {

using delos::netcdf::kGlobal;
using delos::netcdf::Reader;
using delos::netcdf::Writer;

std::string with_certificate(const TemporaryFolder& folder, const Provenance& provenance) {
  Writer file(folder.file("c.nc"), delos::netcdf::Format::cdf5);
  delos::write_provenance(file, provenance, {"nTriangles", "nPoints"});
  file.end_definitions();
  file.close();
  return folder.file("c.nc");
}

void check_same(const delos::FileExtreme& a, const delos::FileExtreme& b) {
  CHECK(a.value == b.value);
  CHECK(a.ids == b.ids);
  CHECK(a.lon_lat_deg == b.lon_lat_deg);
}

}  // namespace

TEST_CASE("a certificate is read back, and its ids count from 1 in the file") {
  const TemporaryFolder folder;
  Provenance written = delos::samples::provenance();
  const Reader file(with_certificate(folder, written));
  CHECK(file.number_attribute("", "delos_angle_max_deg_triangle") == std::vector<double>{7.0});
  CHECK(file.number_attribute("", "delos_stagger_max_cells") == std::vector<double>{1.0, 10.0});
  const std::string statement = file.text_attribute("", "delos_certificate").value_or("");
  for (const char* part : {"from 1", "nTriangles", "nPoints"}) {
    CHECK(statement.find(part) != std::string::npos);
  }
  const auto read = delos::read_provenance(file).certificate;
  REQUIRE(read);
  CHECK(read->well_centred == 0.75);
  CHECK(read->n_obtuse == 3);
  check_same(read->angle_max_deg, written.certificate->angle_max_deg);
  check_same(read->dual_ratio_min, written.certificate->dual_ratio_min);
  check_same(read->stagger_max, written.certificate->stagger_max);
  REQUIRE(read->relative_edge_min);
  check_same(*read->relative_edge_min, *written.certificate->relative_edge_min);

  written.certificate->relative_edge_min.reset();
  const auto without = delos::read_provenance(Reader(with_certificate(folder, written)));
  REQUIRE(without.certificate);
  CHECK_FALSE(without.certificate->relative_edge_min);
  written.certificate.reset();
  CHECK_FALSE(delos::read_provenance(Reader(with_certificate(folder, written))).certificate);
}

TEST_CASE("a certificate of no number is not written") {
  const TemporaryFolder folder;
  Provenance written = delos::samples::provenance();
  written.certificate->stagger_max.value = std::numeric_limits<double>::quiet_NaN();
  expect_error(ErrorKind::internal, {"delos_stagger_max", "finite"},
               [&] { with_certificate(folder, written); });
}

TEST_CASE("a certificate in part, or of ids that can't be, is refused by attribute") {
  const TemporaryFolder folder;
  const auto refused = [&](const char* name, std::vector<double> values, const char* part) {
    {
      Writer file(folder.file("c.nc"), delos::netcdf::Format::cdf5);
      file.attribute(kGlobal, "delos_well_centred", 1.0);
      file.attribute(kGlobal, "delos_n_obtuse", std::int32_t{0});
      file.attribute(kGlobal, "delos_angle_max_deg", 80.0);
      file.attribute(kGlobal, name, std::span<const double>(values));
      file.end_definitions();
      file.close();
    }
    expect_error(ErrorKind::input, {"c.nc", part},
                 [&] { delos::read_provenance(Reader(folder.file("c.nc"))); });
  };
  refused("other", {1.0}, "delos_angle_max_deg_triangle is missing");
  refused("delos_angle_max_deg_triangle", {-1.0}, "no id from 1");
  refused("delos_angle_max_deg_triangle", {1.5}, "no id from 1");
  refused("delos_angle_max_deg_triangle", {1.0, 2.0}, "is not 1 finite number");
  refused("delos_angle_max_deg_triangle", {5.0}, "delos_angle_max_deg_lon_lat is missing");
}
