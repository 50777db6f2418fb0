// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the adapters see of a Config.
#include <string>

#include "delos/config.hpp"
#include "lifecycle/settings.hpp"
#include "lifecycle/settings_tree.hpp"

namespace delos::api {

struct Config::Impl {
  ConfigNode root;
  std::string folder;
};

struct ConfigAccess {
  static Settings settings(const Config& config) {
    return read_settings(config.impl_->root, config.impl_->folder);
  }
};

}  // namespace delos::api
