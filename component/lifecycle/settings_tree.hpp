// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The configuration as a tree of texts that knows where each came from; no meaning yet.
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace delos {

struct ConfigEntry;

struct ConfigNode {
  enum class Kind { empty, scalar, list, map };

  Kind kind = Kind::empty;
  std::string where;   ///< "file:line", or "override"
  std::string scalar;  ///< text of a scalar
  bool quoted = false;
  /// Of a map in the order of the file; the keys of a list are empty.
  std::vector<ConfigEntry> entries;

  /// nullptr when this is no map or has no such key.
  const ConfigNode* find(std::string_view key) const;
  /// Sets or replaces a key of a map; an empty node becomes a map.
  ConfigNode& put(const std::string& key, ConfigNode value);

  static ConfigNode text(std::string scalar, std::string where = {});
};

struct ConfigEntry {
  std::string first;  ///< the key
  ConfigNode second;
  ConfigEntry(std::string key, ConfigNode value)
      : first(std::move(key)), second(std::move(value)) {}
};

/// A message without what would disturb a terminal or break the line: line ends and tabs become
/// blanks, other control characters '?', and of what is longer than a screen the middle is cut.
std::string one_line(std::string message);

/// Error(config) that begins with "name:line" when the text is no YAML map, names a
/// key twice, has more than one document or aliases that make it huge.
ConfigNode parse_config(const std::string& yaml, const std::string& name);

/// Sets the value (YAML) of a key such as "sizing.sources.0.spacing"; parents that are not there
/// are made, a list index may be the list's length at most.
void override_config(ConfigNode& root, const std::string& key, const std::string& value);

/// YAML that parse_config reads back as an equal tree (but for `where`); no newline at its end.
std::string to_yaml(const ConfigNode& root);

}  // namespace delos
