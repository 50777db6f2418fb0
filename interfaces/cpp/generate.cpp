// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/generate.hpp"

#include <memory>
#include <utility>

#include "callbacks.hpp"
#include "config_access.hpp"
#include "delos/generate.hpp"
#include "grid_access.hpp"
#include "translate.hpp"

namespace delos::api {

Grid generate(const Config& config, const GenerateOptions& options) {
  return translated([&] {
    const Settings settings = ConfigAccess::settings(config);
    parallel::Executor exec(options.threads > 0 ? options.threads : settings.threads);
    Monitor monitor(progress_of(options), log_of(options), options.cancel);
    Context context{exec, monitor};
    auto product = std::make_shared<const Product>(delos::generate(context, settings, {}));
    return GridAccess::make(std::move(product), 1);
  });
}

}  // namespace delos::api
