// SPDX-License-Identifier: BSD-3-Clause
#include "handle.hpp"

using delos::c::call;
using delos::c::need;

namespace {

delos_config* keep(delos_context* context, delos::Config made) {
  return context->configs.keep(std::make_unique<delos_config>(*context, std::move(made)));
}

const char* or_default(const char* text, const char* otherwise) {
  return text == nullptr ? otherwise : text;
}

}  // namespace

int delos_config_from_file(delos_context* context, const char* path, delos_config** config) {
  if (config != nullptr) *config = nullptr;
  return call(context, __func__, [&] {
    need(path, "path");
    need(config, "config");
    *config = keep(context, delos::Config::from_file(path));
  });
}

int delos_config_from_text(delos_context* context, const char* yaml, const char* name,
                           const char* folder, delos_config** config) {
  if (config != nullptr) *config = nullptr;
  return call(context, __func__, [&] {
    need(yaml, "yaml");
    need(config, "config");
    *config = keep(context, delos::Config::from_text(yaml, or_default(name, "configuration"),
                                                     or_default(folder, ".")));
  });
}

int delos_config_destroy(delos_config* config) {
  if (config == nullptr) return DELOS_SUCCESS;
  return call(config, __func__, [&] {
    config->config.reset();
    config->text = std::string();
    config->context.configs.retire(config);
  });
}

int delos_config_set(delos_config* config, const char* key, const char* value) {
  return call(config, __func__, [&] {
    need(key, "key");
    need(value, "value");
    config->config->set(key, value);
  });
}

int delos_config_check(delos_config* config) {
  return call(config, __func__, [&] { config->config->check(); });
}

int delos_config_text(delos_config* config, const char** text) {
  if (text != nullptr) *text = nullptr;
  return call(config, __func__, [&] {
    need(text, "text");
    config->text = config->config->text();
    *text = config->text.c_str();
  });
}
