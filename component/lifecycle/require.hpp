// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The block `require:` of a configuration: what the finished grid must meet.
#include <string>
#include <vector>

#include "lifecycle/settings.hpp"
#include "lifecycle/settings_reader.hpp"

namespace delos {

/// Reads the block from a whole configuration that is being read.
RequireSettings read_require(MapReader& root);

/// Reads the block alone; everything else in the configuration is passed over. Error(config) as
/// read_settings.
RequireSettings read_require(const ConfigNode& root);

/// The message for what `name` (e.g. "the grid") misses, the sentences of missed_requirements():
/// these, then what to do. Empty when nothing is missed.
std::string missed_message(const std::string& name, const Settings& settings,
                           const std::vector<std::string>& missed);

}  // namespace delos
