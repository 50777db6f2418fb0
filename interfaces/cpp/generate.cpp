// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/generate.hpp"

#include "config_access.hpp"
#include "delos/generate.hpp"
#include "grid_access.hpp"
#include "translate.hpp"

namespace delos::api {
namespace {

ProgressCallback progress_of(const GenerateOptions& options) {
  if (!options.progress) return {};
  return [&options](const delos::Progress& state) {
    options.progress({state.phase, state.done, state.total, state.elapsed_s});
  };
}

LogCallback log_of(const GenerateOptions& options) {
  if (!options.log) return {};
  return [&options](delos::LogLevel level, const std::string& message) {
    options.log(static_cast<LogLevel>(level), message);
  };
}

}  // namespace

Grid generate(const Config& config, const GenerateOptions& options) {
  return translated([&] {
    const Settings settings = ConfigAccess::settings(config);
    parallel::Executor exec(options.threads > 0 ? options.threads : settings.threads);
    Monitor monitor(progress_of(options), log_of(options), options.cancel);
    Context context{exec, monitor};
    return GridAccess::make(delos::generate(context, settings, {}));
  });
}

}  // namespace delos::api
