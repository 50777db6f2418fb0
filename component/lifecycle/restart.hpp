// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A component's state in one file, from which another instance goes on to the last bit.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "core/progress.hpp"
#include "lifecycle/generate.hpp"
#include "lifecycle/remesh.hpp"
#include "time/clock.hpp"

namespace delos {

/// All that is in a restart file beside the settings, which are the product's.
struct Restart {
  std::shared_ptr<const Product> product;  ///< with its dual
  std::int64_t generation = 0;
  Clock host;                      ///< with its alarms
  std::optional<Clock> component;  ///< none before the first run
  std::optional<Remesh> remesh;    ///< with a section `remesh`; read only
};

/// Error(output) naming the path; the former file then stays.
/// `remesh`: what the component has of it, or null; state.remesh is not looked at.
void write_restart(const std::string& path, const Restart& state, const Remesh* remesh);

/// Error(input) naming the file as RestartFile, and for a file of another configuration: the
/// message has both digests and the settings that differ.
Restart read_restart(Context& context, const Settings& settings, const std::string& path);

}  // namespace delos
