// SPDX-License-Identifier: BSD-3-Clause
#include "io/restart.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "core/error.hpp"
#include "core/hash.hpp"
#include "io/atomic_file.hpp"

namespace delos {
namespace {

namespace fs = std::filesystem;

/// The attribute that makes a netCDF file a restart file.
constexpr const char* kFormatName = "delos_restart_format";
constexpr const char* kVersionName = "delos_version";
/// What the file ends with: this, 64 hexadecimal digits, a line end. netCDF reads up to the last
/// value that its header promises and does not look at it.
constexpr std::string_view kSeal = "delos sha256 ";
constexpr std::size_t kSealBytes = kSeal.size() + 64 + 1;
/// Where the header's dimensions end and its attributes stand, at the latest: a name a dimension,
/// of which a restart file has some dozens.
constexpr std::size_t kHeadBytes = std::size_t{1} << 16;
constexpr std::size_t kBlockBytes = std::size_t{1} << 20;

/// SHA-256 of the first n bytes.
std::string checksum(std::ifstream& file, std::uintmax_t n_bytes) {
  Digest digest;
  std::vector<char> block(kBlockBytes);
  file.clear();
  file.seekg(0);
  while (n_bytes > 0 && file) {
    const auto n = std::min<std::uintmax_t>(n_bytes, block.size());
    file.read(block.data(), static_cast<std::streamsize>(n));
    digest.add(block.data(), static_cast<std::size_t>(file.gcount()));
    n_bytes -= n;
  }
  return digest.hex();
}

std::string seal_of(std::ifstream& file, std::uintmax_t n_bytes) {
  return std::string(kSeal) + checksum(file, n_bytes) + "\n";
}

std::string bytes_at(std::ifstream& file, std::uintmax_t begin, std::size_t n_bytes) {
  std::string bytes(n_bytes, '\0');
  file.clear();
  file.seekg(static_cast<std::streamoff>(begin));
  file.read(bytes.data(), static_cast<std::streamsize>(n_bytes));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

netcdf::Type type_of(const RestartArray& array) {
  constexpr netcdf::Type kTypes[] = {netcdf::Type::float64, netcdf::Type::int64,
                                     netcdf::Type::int32, netcdf::Type::text};
  return kTypes[array.values.index()];
}

std::size_t length_of(const RestartArray& array) {
  return std::visit([](const auto& values) { return values.size(); }, array.values);
}

void put(netcdf::Writer& file, netcdf::VariableId variable, const RestartArray& array) {
  if (const auto* characters = std::get_if<std::string_view>(&array.values)) {
    file.put_text(variable, std::string(*characters));
    return;
  }
  std::visit(
      [&](const auto& values) {
        if constexpr (!std::is_same_v<std::decay_t<decltype(values)>, std::string_view>) {
          file.put(variable, values);
        }
      },
      array.values);
}

void write_netcdf(const std::string& path, const std::string& version,
                  std::span<const RestartArray> arrays) {
  netcdf::Writer file(path, netcdf::Format::cdf5);
  file.keep_in_memory();  // for the checksum
  std::vector<netcdf::VariableId> variables;
  for (const RestartArray& array : arrays) {
    DELOS_CHECK(length_of(array) > 0, ErrorKind::internal, path, ": the restart array '",
                array.name, "' is empty: leave it out.");
    const auto dimension = file.define_dimension("n_" + array.name, length_of(array));
    variables.push_back(file.define_variable(array.name, type_of(array), {dimension}));
    file.attribute(variables.back(), "long_name", array.description);
  }
  file.attribute(netcdf::kGlobal, kFormatName, kRestartFormat);
  file.attribute(netcdf::kGlobal, kVersionName, version);
  file.end_definitions();
  for (std::size_t i = 0; i < arrays.size(); ++i) put(file, variables[i], arrays[i]);
  file.close();
}

void append_seal(const std::string& path) {
  std::ifstream written(path, std::ios::binary);
  const std::string seal = seal_of(written, fs::file_size(path));
  std::ofstream file(path, std::ios::binary | std::ios::app);
  errno = 0;
  file << seal;
  file.close();
  DELOS_CHECK(file && written, ErrorKind::output, path,
              ": the checksum can't be written: ", std::strerror(errno != 0 ? errno : EIO),
              ". Check the disk and its free space.");
}

/// The path, once its bytes are known to be those that were written.
const std::string& checked(const std::string& path) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  DELOS_CHECK(fs::exists(status), ErrorKind::input, "there is no restart file ", path,
              ": check the path.");
  DELOS_CHECK(fs::is_regular_file(status), ErrorKind::input, path,
              " is no file, so no restart file: check the path.");
  std::ifstream file(path, std::ios::binary);
  DELOS_CHECK(file.is_open(), ErrorKind::input, "the restart file ", path,
              " can't be opened: ", std::strerror(errno), ". Check its permissions.");
  const std::uintmax_t size = fs::file_size(path);
  const std::string head = bytes_at(file, 0, kHeadBytes);
  DELOS_CHECK(head.starts_with("CDF\x05") && head.find(kFormatName) != std::string::npos,
              ErrorKind::input, path, " is no restart file of delos (", size,
              " bytes, without the attribute ", kFormatName,
              " in its header), or it was cut off there. Take another one.");
  const std::string seal = size < kSealBytes ? "" : bytes_at(file, size - kSealBytes, kSealBytes);
  DELOS_CHECK(seal.starts_with(kSeal), ErrorKind::input, "the restart file ", path,
              " is truncated or altered: it ends after ", size,
              " bytes without its checksum. Take another one.");
  DELOS_CHECK(seal == seal_of(file, size - kSealBytes), ErrorKind::input, "the restart file ", path,
              " is altered or damaged: its bytes don't give the checksum at its end. ",
              "Take another one.");
  return path;
}

}  // namespace

void write_restart_arrays(const std::string& path, const std::string& version,
                          std::span<const RestartArray> arrays) {
  AtomicFile file(path);
  file.fill([&](const std::string& temporary) {
    write_netcdf(temporary, version, arrays);
    append_seal(temporary);
  });
  file.commit();
}

RestartFile::RestartFile(const std::string& path, const std::string& version)
    : file_(checked(path)) {
  const auto format = file_.number_attribute("", kFormatName);
  const auto theirs = file_.text_attribute("", kVersionName).value_or("unknown");
  DELOS_CHECK(format && format->front() == kRestartFormat, ErrorKind::input, "the restart file ",
              path, " is of format ", format ? format->front() : 0.0, " (delos ", theirs,
              "), this is delos ", version, ", which reads format ", kRestartFormat,
              ". Use the delos that wrote it, or start anew.");
  DELOS_CHECK(theirs == version, ErrorKind::input, "the restart file ", path,
              " was written by delos ", theirs, ", this is delos ", version,
              ", whose grids may differ in the last bits. Use the delos that wrote it, or start "
              "anew.");
}

}  // namespace delos
