// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/config_file.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/error.hpp"

namespace delos {

ConfigFile read_config_file(const std::string& path) {
  std::error_code ignored;
  DELOS_CHECK(!std::filesystem::is_directory(path, ignored), ErrorKind::input, path,
              " is a folder, not a configuration. Give a YAML file.");
  std::ifstream file(path, std::ios::binary);
  DELOS_CHECK(file.is_open(), ErrorKind::input, "the configuration ", path,
              " can't be opened: ", std::strerror(errno), ". Check the name.");
  const std::string yaml{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return {parse_config(yaml, path), folder.empty() ? "." : folder};
}

}  // namespace delos
