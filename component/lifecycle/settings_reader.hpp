// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Typed access to the configuration tree. Every failure is Error(config) that begins with
// "file:line key.path: ...". What is read, defaults included, is noted in a second tree: the
// effective configuration.
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "lifecycle/settings_tree.hpp"
#include "lifecycle/units.hpp"

namespace delos {

/// What a number may be.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_is_open = false;

  static Bounds any() { return {}; }
  static Bounds positive() { return {.low = 0.0, .low_is_open = true}; }
  static Bounds not_negative() { return {.low = 0.0}; }
  static Bounds between(double low, double high) { return {.low = low, .high = high}; }
};

/// Reads one map. Keys are given at construction, so that a misspelled one is named before
/// anything else is said to be missing.
class MapReader {
 public:
  using Keys = std::initializer_list<std::string_view>;
  using Item =
      std::function<void(const ConfigNode& node, const std::string& path, ConfigNode& effective)>;

  /// Error unless the node is a map (or empty) of these keys only. `effective` receives what is
  /// read and must outlive the reader.
  MapReader(const ConfigNode& node, std::string path, ConfigNode& effective, Keys keys)
      : MapReader(node, std::move(path), effective, keys, node.where) {}

  bool has(std::string_view key) const;

  /// The required value of a key, or `fallback` (text, as the user would write it) when absent.
  double quantity(const std::string& key, Dimension dimension, Bounds bounds,
                  const char* fallback = nullptr);
  std::optional<double> optional_quantity(const std::string& key, Dimension dimension,
                                          Bounds bounds);
  std::int64_t integer(const std::string& key, std::int64_t low, std::int64_t high,
                       const char* fallback = nullptr);
  bool boolean(const std::string& key, bool fallback);
  /// `example` stands in the message that a required text is missing.
  std::string string(const std::string& key, const char* fallback = nullptr,
                     const char* example = nullptr);
  /// Index into `choices` of the word given.
  std::size_t choice(const std::string& key, Keys choices, const char* fallback = nullptr);
  /// A list of at least n_min and at most n_max quantities.
  std::vector<double> quantities(const std::string& key, Dimension dimension, Bounds bounds,
                                 std::pair<std::size_t, std::size_t> n_min_max);
  /// A list of two quantities.
  std::pair<double, double> pair(const std::string& key, Dimension first, Dimension second,
                                 std::pair<const char*, const char*> fallback);
  /// A list of words, each one of `choices` unless these are empty; one word is a list of one.
  std::vector<std::string> strings(const std::string& key, Keys choices,
                                   std::initializer_list<const char*> fallback);
  /// A map within this one; empty when absent.
  MapReader map(const std::string& key, Keys keys);
  /// Every element of a list; nothing when the key is absent.
  void each(const std::string& key, const Item& read_item);

  /// Key path of a key of this map, e.g. "sizing.clamp.min".
  std::string path_of(std::string_view key) const;
  /// "file:line key.path", where to look for a key (the map itself when it is absent).
  std::string locate(std::string_view key) const;
  const ConfigNode* find(std::string_view key) const { return node_->find(key); }

  template <class... Parts>
  [[noreturn]] void fail(std::string_view key, const Parts&... parts) const {
    throw Error(ErrorKind::config, one_line(text(locate(key), ": ", parts...)));
  }

 private:
  MapReader(const ConfigNode& node, std::string path, ConfigNode& effective, Keys keys,
            std::string where);
  /// Text of a scalar, noted as effective; nullptr when absent and not required.
  const std::string* scalar(const std::string& key, const char* fallback);
  double checked(std::string_view key, const std::string& text, Dimension dimension,
                 Bounds bounds) const;

  const ConfigNode* node_;
  std::string path_;
  std::string where_;  ///< of the map, or of the one around it when it is absent
  ConfigNode* effective_;
};

}  // namespace delos
