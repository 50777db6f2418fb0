// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// From a configuration to a grid, in memory.
#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "delos/config.hpp"
#include "delos/export.hpp"
#include "delos/grid.hpp"

namespace delos::api {

/// State of the phase that runs now.
struct Progress {
  std::string phase;   ///< e.g. "refine"
  std::int64_t done;   ///< items finished
  std::int64_t total;  ///< items expected (an estimate, done may pass it); 0 = unknown
  double elapsed_s;    ///< since the phase began
};

enum class LogLevel { debug, info, warning, error };

struct GenerateOptions {
  /// Threads of an arena of its own; 0 = what the configuration says (all, by default). The grid
  /// does not depend on it, to the last bit. Of many more than the machine has, some are not
  /// started (four a processor, 64 at least, are).
  int threads = 0;
  /// Called from any thread, one call at a time, at most ten times a second.
  std::function<void(const Progress&)> progress = {};
  std::function<void(LogLevel, const std::string&)> log = {};
  /// Set it from anywhere (a signal handler too) to stop: generate() then throws
  /// Error(cancelled) soon after.
  const std::atomic<bool>* cancel = nullptr;
};

/// Reads the files that the configuration names, sizes, refines, relaxes, and builds the dual.
/// Writes nothing, prints nothing. Strong guarantee: a Grid or an exception: Error(config) for a
/// setting, Error(input) for a file, Error(resource), before anything large is allocated, for a
/// grid that does not fit, Error(quality) when a `require:` is missed, Error(cancelled).
DELOS_API Grid generate(const Config& config, const GenerateOptions& options = {});

}  // namespace delos::api

#ifndef DELOS_BUILDING_LIBRARY
namespace delos {
using api::generate;
using api::GenerateOptions;
using api::LogLevel;
using api::Progress;
}  // namespace delos
#endif
