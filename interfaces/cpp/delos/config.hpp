// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// A grid's recipe: YAML text whose every key config/defaults.yaml explains.
#include <memory>
#include <string>

#include "delos/export.hpp"

namespace delos::api {

struct ConfigAccess;

/// A value: copies are independent. Every error is Error(config) and begins with
/// "file:line key.path:".
class DELOS_API Config {
 public:
  /// Reads YAML. File names in it are relative to the file's folder.
  static Config from_file(const std::string& path);
  /// `name` stands for the file in messages; file names are relative to `folder`.
  static Config from_text(const std::string& yaml, const std::string& name = "configuration",
                          const std::string& folder = ".");

  Config(const Config& other);
  Config(Config&& other) noexcept;
  Config& operator=(const Config& other);
  Config& operator=(Config&& other) noexcept;
  ~Config();

  /// Sets one key, e.g. ("sizing.sources.0.spacing", "60 km"); the value is YAML. A list (from 0)
  /// grows by one when the index is its length.
  void set(const std::string& key, const std::string& value);

  /// Checks every key and value as generate() does; no file is opened.
  void check() const;

  /// The effective configuration, defaults and overrides included, as YAML that from_text
  /// accepts. Two configurations with the same text make the same grid from the same inputs.
  std::string text() const;

 private:
  friend struct ConfigAccess;
  struct Impl;
  explicit Config(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace delos::api

#ifndef DELOS_BUILDING_LIBRARY
namespace delos {
using api::Config;
}  // namespace delos
#endif
