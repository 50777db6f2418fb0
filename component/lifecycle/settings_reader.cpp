// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/settings_reader.hpp"

#include <algorithm>
#include <charconv>

#include "io/names.hpp"

namespace delos {
namespace {

const ConfigNode kEmptyNode{};

std::string listed(MapReader::Keys words) {
  std::string out;
  for (const std::string_view word : words) {
    if (!out.empty()) out += ", ";
    out += word;
  }
  return out;
}

std::string suggestion(std::string_view word, MapReader::Keys valid) {
  const std::string near = nearest_name(std::string(word), {valid.begin(), valid.end()});
  return (near.empty() ? std::string() : text("Did you mean '", near, "'? ")) +
         text("Valid here: ", listed(valid), ".");
}

const char* kind_name(const ConfigNode& node) {
  switch (node.kind) {
    case ConfigNode::Kind::empty:
      return "nothing";
    case ConfigNode::Kind::scalar:
      return "a single value";
    case ConfigNode::Kind::list:
      return "a list";
    case ConfigNode::Kind::map:
      return "a map";
  }
  return "unknown";
}

std::string bound_text(const Bounds& bounds, Dimension dimension) {
  static constexpr std::string_view kUnits[] = {"", " m", " deg", " s", " m/s", " m2/s2"};
  const std::string_view unit = kUnits[static_cast<std::size_t>(dimension)];
  const bool has_high = bounds.high < std::numeric_limits<double>::infinity();
  if (!has_high) return text("must be ", bounds.low_is_open ? "> " : ">= ", bounds.low, unit);
  if (bounds.low_is_open) {
    return text("must be above ", bounds.low, " and at most ", bounds.high, unit);
  }
  return text("must be between ", bounds.low, " and ", bounds.high, unit);
}

}  // namespace

MapReader::MapReader(const ConfigNode& node, std::string path, ConfigNode& effective, Keys keys,
                     std::string where)
    : node_(&node), path_(std::move(path)), where_(std::move(where)), effective_(&effective) {
  DELOS_CHECK(node.kind == ConfigNode::Kind::map || node.kind == ConfigNode::Kind::empty,
              ErrorKind::config, node.where, " ", path_, ": a map of keys is needed here (",
              listed(keys), "), not ", kind_name(node), ".");
  effective_->kind = ConfigNode::Kind::map;
  for (const auto& [key, child] : node.entries) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    fail(key, "unknown key. ", suggestion(key, keys));
  }
}

bool MapReader::has(std::string_view key) const {
  const ConfigNode* const child = node_->find(key);
  return child != nullptr && child->kind != ConfigNode::Kind::empty;
}

std::string MapReader::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : text(path_, ".", key);
}

std::string MapReader::locate(std::string_view key) const {
  const ConfigNode* const child = node_->find(key);
  const std::string& where = child != nullptr ? child->where : where_;
  return where.empty() ? path_of(key) : text(where, " ", path_of(key));
}

const std::string* MapReader::scalar(const std::string& key, const char* fallback) {
  if (!has(key)) {
    if (fallback == nullptr) return nullptr;
    return &effective_->put(key, ConfigNode::text(fallback)).scalar;
  }
  const ConfigNode& child = *node_->find(key);
  if (child.kind != ConfigNode::Kind::scalar) {
    fail(key, "a single value is needed here, not ", kind_name(child), ".");
  }
  return &effective_->put(key, child).scalar;
}

double MapReader::checked(std::string_view key, const std::string& value, Dimension dimension,
                          Bounds bounds) const {
  const Quantity quantity = parse_quantity(value, dimension);
  if (!quantity.error.empty()) fail(key, quantity.error);
  const bool is_inside =
      quantity.value <= bounds.high &&
      (bounds.low_is_open ? quantity.value > bounds.low : quantity.value >= bounds.low);
  if (!is_inside) fail(key, value, ": ", bound_text(bounds, dimension), ".");
  return quantity.value;
}

double MapReader::quantity(const std::string& key, Dimension dimension, Bounds bounds,
                           const char* fallback) {
  const std::string* const value = scalar(key, fallback);
  if (value == nullptr) {
    fail(key, "missing. Give ", noun(dimension), ", e.g. ", key, ": ", example(dimension), ".");
  }
  return checked(key, *value, dimension, bounds);
}

std::optional<double> MapReader::optional_quantity(const std::string& key, Dimension dimension,
                                                   Bounds bounds) {
  if (!has(key)) return std::nullopt;
  return quantity(key, dimension, bounds);
}

std::int64_t MapReader::integer(const std::string& key, std::int64_t low, std::int64_t high,
                                const char* fallback) {
  const std::string* const value = scalar(key, fallback);
  if (value == nullptr) fail(key, "missing. Give a whole number, e.g. ", key, ": ", low, ".");
  std::int64_t out = 0;
  const char* const end = value->data() + value->size();
  const auto [rest, status] = std::from_chars(value->data(), end, out);
  if (status != std::errc() || rest != end) {
    fail(key, "'", *value, "' is not a whole number, e.g. ", low, ".");
  }
  if (out < low || out > high) fail(key, out, ": must be between ", low, " and ", high, ".");
  return out;
}

bool MapReader::boolean(const std::string& key, bool fallback) {
  const std::string& value = *scalar(key, fallback ? "true" : "false");
  if (value != "true" && value != "false") {
    fail(key, "'", value, "' is neither true nor false.");
  }
  return value == "true";
}

std::string MapReader::string(const std::string& key, const char* fallback, const char* example) {
  const std::string* const value = scalar(key, fallback);
  if (value == nullptr) {
    fail(key, "missing. Give ",
         example != nullptr ? text("it, e.g. ", key, ": ", example) : "a text", ".");
  }
  if (value->empty() && fallback == nullptr) fail(key, "must not be empty.");
  return *value;
}

std::size_t MapReader::choice(const std::string& key, Keys choices, const char* fallback) {
  const std::string* const value = scalar(key, fallback);
  if (value == nullptr) fail(key, "missing. One of ", listed(choices), ".");
  const auto found = std::find(choices.begin(), choices.end(), *value);
  if (found == choices.end()) {
    fail(key, "'", *value, "' is not known. ", suggestion(*value, choices));
  }
  return static_cast<std::size_t>(found - choices.begin());
}

std::vector<double> MapReader::quantities(const std::string& key, Dimension dimension,
                                          Bounds bounds,
                                          std::pair<std::size_t, std::size_t> n_min_max) {
  if (!has(key)) fail(key, "missing. Give a list, e.g. [", example(dimension), ", ...].");
  const ConfigNode& list = *node_->find(key);
  const auto [n_min, n_max] = n_min_max;
  if (list.kind != ConfigNode::Kind::list) {
    fail(key, "a list is needed here, e.g. [", example(dimension), ", ...], not ", kind_name(list),
         ".");
  }
  const std::size_t n = list.entries.size();
  if (n < n_min || n > n_max) {
    const std::string wanted = n_min == n_max ? text(n_min)
                               : n < n_min    ? text("at least ", n_min)
                                              : text("at most ", n_max);
    fail(key, "has ", n, n == 1 ? " value" : " values", "; ", wanted,
         wanted == "1" ? " is needed." : " are needed.");
  }
  std::vector<double> out;
  for (const auto& [name, item] : list.entries) {
    if (item.kind != ConfigNode::Kind::scalar) fail(key, "holds ", kind_name(item), ".");
    out.push_back(checked(key, item.scalar, dimension, bounds));
  }
  effective_->put(key, list);
  return out;
}

std::pair<double, double> MapReader::pair(const std::string& key, Dimension first, Dimension second,
                                          std::pair<const char*, const char*> fallback) {
  ConfigNode list;
  list.kind = ConfigNode::Kind::list;
  if (has(key)) {
    list = *node_->find(key);
  } else {
    list.entries.emplace_back("", ConfigNode::text(fallback.first));
    list.entries.emplace_back("", ConfigNode::text(fallback.second));
  }
  if (list.kind != ConfigNode::Kind::list || list.entries.size() != 2) {
    fail(key, "a list of two values is needed here, e.g. [", fallback.first, ", ", fallback.second,
         "].");
  }
  effective_->put(key, list);
  return {checked(key, list.entries[0].second.scalar, first, Bounds::not_negative()),
          checked(key, list.entries[1].second.scalar, second, Bounds::positive())};
}

std::vector<std::string> MapReader::strings(const std::string& key, Keys choices,
                                            std::initializer_list<const char*> fallback) {
  ConfigNode list;
  list.kind = ConfigNode::Kind::list;
  if (!has(key)) {
    for (const char* word : fallback) list.entries.emplace_back("", ConfigNode::text(word));
  } else if (node_->find(key)->kind == ConfigNode::Kind::list) {
    list = *node_->find(key);
  } else {
    list.entries.emplace_back("", *node_->find(key));
  }
  std::vector<std::string> out;
  for (const auto& [name, item] : list.entries) {
    if (item.kind != ConfigNode::Kind::scalar) fail(key, "a list of words is needed here.");
    if (choices.size() != 0 &&
        std::find(choices.begin(), choices.end(), item.scalar) == choices.end()) {
      fail(key, "'", item.scalar, "' is not known. ", suggestion(item.scalar, choices));
    }
    out.push_back(item.scalar);
  }
  effective_->put(key, std::move(list));
  return out;
}

MapReader MapReader::map(const std::string& key, Keys keys) {
  const ConfigNode* const child = node_->find(key);
  ConfigNode& effective = effective_->put(key, ConfigNode{});
  return {child != nullptr ? *child : kEmptyNode, path_of(key), effective, keys,
          child != nullptr ? child->where : where_};
}

void MapReader::each(const std::string& key, const Item& read_item) {
  if (!has(key)) return;
  const ConfigNode& list = *node_->find(key);
  if (list.kind != ConfigNode::Kind::list) {
    fail(key, "a list is needed here (lines that begin with '- '), not ", kind_name(list), ".");
  }
  ConfigNode effective;
  effective.kind = ConfigNode::Kind::list;
  for (std::size_t i = 0; i < list.entries.size(); ++i) {
    ConfigNode& item = effective.entries.emplace_back("", ConfigNode{}).second;
    read_item(list.entries[i].second, text(path_of(key), ".", i), item);
  }
  effective_->put(key, std::move(effective));
}

}  // namespace delos
