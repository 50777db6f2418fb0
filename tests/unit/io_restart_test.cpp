// SPDX-License-Identifier: BSD-3-Clause
#include "io/restart.hpp"

#include <sys/wait.h>
#include <unistd.h>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "support/expect_error.hpp"
#include "support/file_size_limit.hpp"
#include "support/temporary_folder.hpp"

using namespace delos;
using delos::testing::expect_error;
using delos::testing::TemporaryFolder;

namespace {

constexpr const char* kVersion = "1.2.3";

/// A file of all four types, whose doubles are all `value`.
void write(const std::string& path, double value, std::size_t n = 50) {
  const std::vector<double> doubles(n, value);
  const std::vector<std::int64_t> integers = {1, -(std::int64_t{1} << 60)};
  const std::vector<std::int32_t> ids = {5, 6, 7};
  const std::vector<RestartArray> arrays = {
      {"numbers", "[n]", std::span<const double>(doubles)},
      {"integers", "two", std::span<const std::int64_t>(integers)},
      {"ids", "three", std::span<const std::int32_t>(ids)},
      {"words", "a text", std::string_view("first\nsecond")}};
  write_restart_arrays(path, kVersion, arrays);
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

void put_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

void refused(const std::string& path, std::initializer_list<std::string> parts) {
  expect_error(ErrorKind::input, parts, [&] { RestartFile(path, kVersion); });
}

std::size_t n_files(const std::string& folder) {
  std::size_t n = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder)) ++n;
  return n;
}

}  // namespace

TEST_CASE("restart arrays of every type come back to the last bit") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.nc");
  write(path, 0.1);
  const RestartFile file(path, kVersion);
  CHECK(file.doubles("numbers") == std::vector<double>(50, 0.1));
  CHECK(file.integers("integers") == std::vector<std::int64_t>{1, -(std::int64_t{1} << 60)});
  CHECK(file.ids("ids") == std::vector<std::int32_t>{5, 6, 7});
  CHECK(file.text("words") == "first\nsecond");
  CHECK(file.has("words"));
  CHECK_FALSE(file.has("nothing"));
  CHECK(n_files(folder.file("")) == 1);
}

TEST_CASE("a restart file that is cut off anywhere is refused by name") {
  const TemporaryFolder folder;
  write(folder.file("whole.nc"), 1.0);
  const std::string bytes = bytes_of(folder.file("whole.nc"));
  const std::string path = folder.file("cut.nc");
  for (const std::size_t n : {std::size_t{0}, std::size_t{3}, std::size_t{40}, bytes.size() / 4,
                              bytes.size() / 2, bytes.size() - 78, bytes.size() - 1}) {
    CAPTURE(n);
    put_bytes(path, bytes.substr(0, n));
    refused(path, {path, "Take another one"});
  }
  put_bytes(path, bytes.substr(0, bytes.size() - 100));
  refused(path, {path, "truncated", "without its checksum"});
  put_bytes(path, bytes + "x");
  refused(path, {path, "truncated or altered"});
}

TEST_CASE("a restart file with any byte changed is refused by name") {
  const TemporaryFolder folder;
  write(folder.file("whole.nc"), 1.0);
  const std::string bytes = bytes_of(folder.file("whole.nc"));
  const std::string path = folder.file("changed.nc");
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ (1 << (i % 8)));
    put_bytes(path, changed);
    CAPTURE(i);
    refused(path, {path, "Take another one"});
  }
}

TEST_CASE("what is no restart file, or one of another version, is refused by name") {
  const TemporaryFolder folder;
  const std::string missing = folder.file("nowhere.nc");
  refused(missing, {"no restart file", missing});
  refused(folder.file(""), {"is no file"});
  const std::string text = folder.file("text.nc");
  put_bytes(text, "Once upon a time");
  refused(text, {text, "is no restart file of delos", "16 bytes"});
  const std::string other = folder.file("other.nc");
  {
    netcdf::Writer file(other, netcdf::Format::cdf5);
    file.attribute(netcdf::kGlobal, "title", "a field");
    file.end_definitions();
    file.close();
  }
  refused(other, {other, "is no restart file of delos"});
  const std::string path = folder.file("a.nc");
  write(path, 1.0);
  expect_error(ErrorKind::input, {path, "written by delos 1.2.3", "this is delos 1.3.0"},
               [&] { RestartFile(path, "1.3.0"); });
}

TEST_CASE("a restart file that can't be written leaves the former one and nothing else") {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.nc");
  write(path, 1.0);
  {
    const delos::testing::FileSizeLimit limit(4096);
    expect_error(ErrorKind::output, {path}, [&] { write(path, 2.0, 10000); });
  }
  CHECK(RestartFile(path, kVersion).doubles("numbers")[0] == 1.0);
  CHECK(n_files(folder.file("")) == 1);
  expect_error(ErrorKind::output, {"no folder", "nowhere"},
               [&] { write(folder.file("nowhere/a.nc"), 1.0); });
}

TEST_CASE("a writer that is killed leaves a whole restart file") {
  constexpr std::size_t kMany = 200000;
  constexpr int kKills = 8;
  const TemporaryFolder folder;
  const std::string path = folder.file("a.nc");
  write(path, 0.0, kMany);
  for (int kill_number = 0; kill_number < kKills; ++kill_number) {
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) {
      for (double value = 1.0;; value += 1.0) write(path, value, kMany);
    }
    // At another moment of the writing each time.
    usleep(static_cast<useconds_t>(5000 + 3700 * kill_number));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    CHECK(WIFSIGNALED(status));
    const auto numbers = RestartFile(path, kVersion).doubles("numbers");
    CHECK(numbers == std::vector<double>(kMany, numbers.at(0)));
  }
}
