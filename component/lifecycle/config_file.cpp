// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/config_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <istream>

#include "core/error.hpp"

namespace delos {
namespace {

/// Twice the longest list of points that a configuration may hold; a file given by mistake (a
/// grid, a device) is refused before it fills the memory.
constexpr std::size_t kMaxBytes = std::size_t{1} << 26;

std::string read_whole(std::istream& file, const std::string& path) {
  constexpr std::size_t kBlock = std::size_t{1} << 16;
  std::string all;
  while (file) {
    const std::size_t n_before = all.size();
    DELOS_CHECK(n_before <= kMaxBytes, ErrorKind::input, path, " is longer than ", kMaxBytes,
                " bytes: it is no configuration. Give a YAML file.");
    all.resize(n_before + kBlock);
    file.read(all.data() + n_before, static_cast<std::streamsize>(kBlock));
    all.resize(n_before + static_cast<std::size_t>(file.gcount()));
  }
  DELOS_CHECK(!file.bad(), ErrorKind::input, "the configuration ", path,
              " can't be read. Check the disk that it is on.");
  return all;
}

}  // namespace

ConfigFile read_config_file(const std::string& path) {
  std::error_code ignored;
  DELOS_CHECK(!std::filesystem::is_directory(path, ignored), ErrorKind::input, path,
              " is a folder, not a configuration. Give a YAML file.");
  std::ifstream file(path, std::ios::binary);
  DELOS_CHECK(file.is_open(), ErrorKind::input, "the configuration ", path,
              " can't be opened: ", std::strerror(errno), ". Check the name.");
  const std::string yaml = read_whole(file, path);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return {parse_config(yaml, path), folder.empty() ? "." : folder};
}

}  // namespace delos
