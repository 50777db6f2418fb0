// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A host's callbacks as the engine calls them.
#include "core/progress.hpp"
#include "delos/generate.hpp"

namespace delos::api {

/// Refers to the options.
inline ProgressCallback progress_of(const GenerateOptions& options) {
  if (!options.progress) return {};
  return [&options](const delos::Progress& state) {
    options.progress({state.phase, state.done, state.total, state.elapsed_s});
  };
}

/// Refers to the options.
inline LogCallback log_of(const GenerateOptions& options) {
  if (!options.log) return {};
  return [&options](delos::LogLevel level, const std::string& message) {
    options.log(static_cast<LogLevel>(level), message);
  };
}

}  // namespace delos::api
