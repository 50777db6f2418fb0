// SPDX-License-Identifier: BSD-3-Clause
#include "delos/config.hpp"

#include <utility>

#include "config_access.hpp"
#include "lifecycle/config_file.hpp"
#include "translate.hpp"

namespace delos::api {

Config Config::from_file(const std::string& path) {
  return translated([&] {
    ConfigFile file = read_config_file(path);
    return Config(std::make_unique<Impl>(Impl{std::move(file.root), std::move(file.folder)}));
  });
}

Config Config::from_text(const std::string& yaml, const std::string& name,
                         const std::string& folder) {
  return translated([&] {
    return Config(std::make_unique<Impl>(Impl{parse_config(yaml, name), folder}));
  });
}

Config::Config(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Config::Config(const Config& other) : impl_(std::make_unique<Impl>(*other.impl_)) {}
Config::Config(Config&& other) noexcept = default;
Config& Config::operator=(const Config& other) {
  impl_ = std::make_unique<Impl>(*other.impl_);
  return *this;
}
Config& Config::operator=(Config&& other) noexcept = default;
Config::~Config() = default;

void Config::set(const std::string& key, const std::string& value) {
  translated([&] { override_config(impl_->root, key, value); });
}

void Config::check() const {
  translated([&] { static_cast<void>(ConfigAccess::settings(*this)); });
}

std::string Config::text() const {
  return translated([&] { return ConfigAccess::settings(*this).text; });
}

}  // namespace delos::api
