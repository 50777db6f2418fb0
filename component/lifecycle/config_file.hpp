// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "lifecycle/settings_tree.hpp"

namespace delos {

struct ConfigFile {
  ConfigNode root;
  std::string folder;  ///< of the file; relative file names in it are relative to this
};

/// Error(input) when the file can't be read, Error(config) when it is no YAML map.
ConfigFile read_config_file(const std::string& path);

}  // namespace delos
