// SPDX-License-Identifier: BSD-3-Clause
#include "io/netcdf.hpp"

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "core/hash.hpp"
#include "io/names.hpp"
#include "io/netcdf_classic.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using netcdf::Format;
using netcdf::kGlobal;
using netcdf::kUnlimited;
using netcdf::Reader;
using netcdf::Type;
using netcdf::Writer;
using testing::expect_error;
using testing::TemporaryFolder;

namespace {

constexpr std::size_t kRows = 37, kColumns = 53;

std::vector<double> random_values(std::uint64_t seed, std::size_t n) {
  std::vector<double> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = 1e6 * (uniform01(seed, i) - 0.5);
  return values;
}

/// One variable of each kind.
void write_sample(const std::string& path, Format format) {
  Writer file(path, format);
  const auto rows = file.define_dimension("rows", kRows);
  const auto columns = file.define_dimension("columns", kColumns);
  const auto letters = file.define_dimension("letters", 8);
  file.define_dimension("Time", kUnlimited);
  const auto real = file.define_variable("real", Type::float64, {rows, columns});
  const auto single = file.define_variable("single", Type::float32, {rows});
  const auto whole = file.define_variable("whole", Type::int32, {columns});
  const auto longs = file.define_variable("longs", Type::int64, {rows});
  const auto label = file.define_variable("label", Type::text, {letters});
  const auto scalar = file.define_variable("scalar", Type::int32, {});
  file.compress(real, 4);
  file.attribute(kGlobal, "title", "sample");
  file.attribute(kGlobal, "radius", 6371220.0);
  file.attribute(real, "units", std::string("m"));
  file.attribute(real, "range", std::vector<double>{-1.5, 2.5});
  file.attribute(whole, "_FillValue", -1);
  file.attribute(single, "_FillValue", 1e30);
  file.end_definitions();
  const auto values = random_values(7, kRows * kColumns);
  const std::size_t half = kRows / 2;
  file.put_block(real, std::vector<std::size_t>{0, 0}, std::vector<std::size_t>{half, kColumns},
                 std::span<const double>(values).first(half * kColumns));
  file.put_block(real, std::vector<std::size_t>{half, 0},
                 std::vector<std::size_t>{kRows - half, kColumns},
                 std::span<const double>(values).subspan(half * kColumns));
  file.put(single, std::vector<float>(kRows, 0.1F));
  std::vector<std::int32_t> counted(kColumns);
  std::iota(counted.begin(), counted.end(), -5);
  file.put(whole, counted);
  file.put(longs, std::vector<std::int64_t>(kRows, std::int64_t{1} << 40));
  file.put_text(label, "delos");
  file.put(scalar, std::vector<std::int32_t>{42});
  file.close();
}

/// Files may not grow beyond this while it lives; a write that tries fails like on a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t n_bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit lowered{n_bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &lowered);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  void (*handler_)(int);
  rlimit before_{};
};

void truncate(const std::string& path, std::uintmax_t n_removed) {
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - n_removed);
}

}  // namespace

TEST_CASE("what a netCDF writer puts a reader finds, in both formats") {
  const TemporaryFolder folder;
  for (const Format format : {Format::netcdf4, Format::cdf5}) {
    const std::string path = folder.file("sample.nc");
    write_sample(path, format);
    const Reader file(path);
    CHECK(file.read_double("real") == random_values(7, kRows * kColumns));
    CHECK(file.read_double("single") == std::vector<double>(kRows, double{0.1F}));
    CHECK(file.read_int32("whole")[6] == 1);
    CHECK(file.read_double("longs")[3] == 0x1p40);
    CHECK(file.read_text("label") == "delos");
    CHECK(file.read_int32("scalar") == std::vector<std::int32_t>{42});
    CHECK(file.text_attribute("", "title") == "sample");
    CHECK(file.number_attribute("", "radius") == std::vector<double>{6371220.0});
    CHECK(file.number_attribute("real", "range") == std::vector<double>{-1.5, 2.5});
    CHECK(file.text_attribute("real", "units") == "m");
    CHECK(file.attribute_type("whole", "_FillValue") == Type::int32);
    CHECK(file.attribute_type("single", "_FillValue") == Type::float32);
    CHECK_FALSE(file.text_attribute("real", "range").has_value());
    CHECK_FALSE(file.number_attribute("real", "units").has_value());
    CHECK_FALSE(file.text_attribute("real", "nothing").has_value());
    CHECK(file.dimension("Time").unlimited);
    CHECK(file.dimension("Time").length == 0);
    CHECK(file.variable("real").shape_text() == "real(37, 53)");
    CHECK(file.variable("scalar").shape_text() == "scalar");
    CHECK(file.attribute_names("real") == std::vector<std::string>{"units", "range"});
  }
}

TEST_CASE("a block of a netCDF variable is that part of the whole") {
  const TemporaryFolder folder;
  write_sample(folder.file("a.nc"), Format::cdf5);
  const Reader file(folder.file("a.nc"));
  const auto whole = file.read_double("real");
  std::vector<double> block(3 * 4);
  file.read("real", std::vector<std::size_t>{5, 7}, std::vector<std::size_t>{3, 4}, block);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 4; ++j)
      CHECK(block[i * 4 + j] == whole[(5 + i) * kColumns + 7 + j]);
  }
}

TEST_CASE("the promised size of a classic netCDF file is its size, up to the padding") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.nc");
  write_sample(path, Format::cdf5);
  const std::uint64_t size = std::filesystem::file_size(path);
  const auto promised = netcdf::promised_size_bytes(path);
  REQUIRE(promised.has_value());
  CHECK(*promised <= size);
  CHECK(*promised + 4 > size);
}

TEST_CASE("a file that is not netCDF is refused with what it is instead") {
  const TemporaryFolder folder;
  const auto open = [](const std::string& path) { return [path] { const Reader file(path); }; };
  expect_error(ErrorKind::input, {"missing.nc", "no such file"}, open(folder.file("missing.nc")));
  expect_error(ErrorKind::input, {"folder"}, open(folder.file(".")));
  expect_error(ErrorKind::input, {"a.nc", "not a netCDF file", "text file", "lat lon h"},
               open(folder.write("a.nc", "lat lon h\n1 2 3\n")));
  expect_error(ErrorKind::input, {"e.nc", "not a netCDF file", "empty"},
               open(folder.write("e.nc", "")));
  expect_error(ErrorKind::input, {"g.grb", "GRIB"},
               open(folder.write("g.grb", "GRIB\x01\x02\x03")));
  expect_error(ErrorKind::input, {"b.nc", "not a netCDF file", "other kind"},
               open(folder.write("b.nc", "\x01\x02\x03\x04\x05")));
}

TEST_CASE("a truncated netCDF file is refused before anything is read from it") {
  const TemporaryFolder folder;
  const std::string path = folder.file("t.nc");
  const auto open = [&] { const Reader file(path); };
  write_sample(path, Format::cdf5);
  const auto size = std::filesystem::file_size(path);
  truncate(path, 8);
  expect_error(ErrorKind::input, {"t.nc", "truncated", std::to_string(size - 8)}, open);
  for (const std::uintmax_t left : {300U, 40U, 5U}) {
    std::filesystem::resize_file(path, left);
    expect_error(ErrorKind::input, {"t.nc", "truncated"}, open);
  }
  write_sample(path, Format::netcdf4);
  truncate(path, std::filesystem::file_size(path) / 2);
  expect_error(ErrorKind::input, {"t.nc", "can't be read", "truncated or damaged"}, open);
}

TEST_CASE("an unknown netCDF variable is answered with the nearest and the two-dimensional ones") {
  const TemporaryFolder folder;
  write_sample(folder.file("a.nc"), Format::netcdf4);
  const Reader file(folder.file("a.nc"));
  expect_error(ErrorKind::input, {"a.nc", "no variable 'Reel'", "mean 'real'", "real(37, 53)"},
               [&] { file.read_double("Reel"); });
  expect_error(ErrorKind::input, {"a.nc", "no dimension 'row'", "rows, columns"},
               [&] { file.dimension("row"); });
  expect_error(ErrorKind::input, {"label", "no numbers"}, [&] { file.read_double("label"); });
  expect_error(ErrorKind::input, {"real", "float64", "text"}, [&] { file.read_text("real"); });
  expect_error(ErrorKind::input, {"a.nc", "longs", "can't be read"},
               [&] { file.read_int32("longs"); });
}

TEST_CASE("a netCDF file that can't be created is an output error that says why") {
  const TemporaryFolder folder;
  for (const Format format : {Format::netcdf4, Format::cdf5}) {
    expect_error(ErrorKind::output, {"none/a.nc", "can't be created", "no folder"},
                 [&] { const Writer file(folder.file("none/a.nc"), format); });
  }
}

TEST_CASE("a wrong number of values for a netCDF variable is refused") {
  const TemporaryFolder folder;
  Writer file(folder.file("a.nc"), Format::cdf5);
  const auto n = file.define_dimension("n", 3);
  const auto x = file.define_variable("x", Type::float64, {n});
  file.end_definitions();
  expect_error(ErrorKind::internal, {"a.nc", "'x'", "4 values", "3"},
               [&] { file.put(x, std::vector<double>(4, 0.0)); });
}

TEST_CASE("more than may be written is refused before the first value") {
  const TemporaryFolder folder;
  const FileSizeLimit limit(1U << 16);
  for (const Format format : {Format::netcdf4, Format::cdf5}) {
    Writer file(folder.file("a.nc"), format);
    const auto n = file.define_dimension("n", 1U << 20);
    file.define_variable("x", Type::float64, {n});
    expect_error(ErrorKind::output, {"a.nc", "disk full", "8.388608 MB", "ulimit"},
                 [&] { file.end_definitions(); });
  }
}

TEST_CASE("a write that fails half way is an output error with file, variable and reason") {
  const TemporaryFolder folder;
  const FileSizeLimit limit(1U << 16);
  Writer file(folder.file("a.nc"), Format::cdf5);
  const auto n = file.define_dimension("n", kUnlimited);
  const auto x = file.define_variable("x", Type::float64, {n});
  file.end_definitions();
  expect_error(ErrorKind::output, {"a.nc", "File too large"}, [&] {
    file.put_block(x, std::vector<std::size_t>{0}, std::vector<std::size_t>{1U << 20},
                   std::vector<double>(1U << 20, 1.0));
    file.close();
  });
}

TEST_CASE("the nearest name ignores case and gives up on unlike ones") {
  CHECK(nearest_name("rosse", {"ROSE", "TEMP"}) == "ROSE");
  CHECK(nearest_name("salinity", {"ROSE", "TEMP"}).empty());
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(join_names({"a", "b", "c"}, 2) == "a, b, ... (3 in all)");
}
