// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/settings_tree.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>

#include "core/error.hpp"

namespace delos {
namespace {

constexpr int kMaxDepth = 32;  // far above any real configuration; bounds the recursion
/// Every value counts, and every use of an alias counts all that it stands for: twice the longest
/// list of points that a configuration may hold.
constexpr std::int64_t kMaxNodes = 4'000'000;

std::string at_line(const std::string& name, const YAML::Mark& mark) {
  return text(name, ":", std::max(mark.line, 0) + 1);  // an empty text has no line
}

/// What a file becomes, and how much of it there is so far.
struct Conversion {
  const std::string& name;
  std::int64_t n_nodes = 0;
};

ConfigNode convert(const YAML::Node& node, Conversion& file, int depth) {
  const std::string& name = file.name;
  ConfigNode out;
  out.where = at_line(name, node.Mark());
  DELOS_CHECK(++file.n_nodes <= kMaxNodes, ErrorKind::config, out.where, ": more than ", kMaxNodes,
              " values, each use of an alias counted. Are there aliases of aliases?");
  DELOS_CHECK(depth < kMaxDepth, ErrorKind::config, out.where, ": nested more than ", kMaxDepth,
              " levels deep. Is an alias part of itself?");
  if (node.IsScalar()) {
    out.kind = ConfigNode::Kind::scalar;
    out.scalar = node.Scalar();
    out.quoted = node.Tag() == "!";
  } else if (node.IsSequence()) {
    out.kind = ConfigNode::Kind::list;
    for (const YAML::Node& item : node)
      out.entries.emplace_back("", convert(item, file, depth + 1));
  } else if (node.IsMap()) {
    out.kind = ConfigNode::Kind::map;
    for (const auto& entry : node) {
      DELOS_CHECK(entry.first.IsScalar(), ErrorKind::config, at_line(name, entry.first.Mark()),
                  ": a key must be a word.");
      const std::string& key = entry.first.Scalar();
      DELOS_CHECK(out.find(key) == nullptr, ErrorKind::config, at_line(name, entry.first.Mark()),
                  " ", key, ": this key is given twice. Remove one of them.");
      out.entries.emplace_back(key, convert(entry.second, file, depth + 1));
    }
  }
  return out;
}

ConfigNode load(const std::string& yaml, const std::string& name) {
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(yaml);
    DELOS_CHECK(documents.size() <= 1, ErrorKind::config, name, ": holds ", documents.size(),
                " YAML documents (begun by ---). Give one.");
    Conversion file{name};
    return convert(documents.empty() ? YAML::Node() : documents[0], file, 0);
  } catch (const YAML::Exception& error) {
    const bool has_tab = yaml.rfind('\t', 0) == 0 || yaml.find("\n\t") != std::string::npos ||
                         yaml.find(" \t") != std::string::npos;
    throw Error(ErrorKind::config,
                text(at_line(name, error.mark), ": this is not YAML: ", one_line(error.msg),
                     has_tab ? ". Put spaces in place of the tabs that some lines begin with."
                             : ". Check quotes, colons and indentation."));
  }
}

void set_where(ConfigNode& node, const std::string& where) {
  node.where = where;
  for (auto& [key, child] : node.entries) set_where(child, where);
}

std::vector<std::string> split_key(const std::string& key) {
  std::vector<std::string> parts;
  std::size_t begin = 0;
  while (true) {
    const std::size_t dot = key.find('.', begin);
    parts.push_back(key.substr(begin, dot - begin));
    if (dot == std::string::npos) return parts;
    begin = dot + 1;
  }
}

ConfigNode& list_item(ConfigNode& list, const std::string& part, const std::string& key) {
  std::size_t index = 0;
  const auto [rest, status] = std::from_chars(part.data(), part.data() + part.size(), index);
  DELOS_CHECK(
      status == std::errc() && rest == part.data() + part.size() && index <= list.entries.size(),
      ErrorKind::config, "override ", key, ": '", part, "' is no index of this list of ",
      list.entries.size(), ". Use 0 to ", list.entries.size(), " (the last appends).");
  if (index == list.entries.size()) list.entries.emplace_back("", ConfigNode{});
  return list.entries[index].second;
}

ConfigNode& child_of(ConfigNode& parent, const std::string& part, const std::string& key) {
  DELOS_CHECK(!part.empty(), ErrorKind::config, "override '", key,
              "': an empty key. Write e.g. sizing.clamp.min.");
  if (parent.kind == ConfigNode::Kind::list) return list_item(parent, part, key);
  if (parent.kind != ConfigNode::Kind::map) {
    parent = ConfigNode{};
    parent.where = "override";
    parent.kind = ConfigNode::Kind::map;
  }
  for (auto& [name, child] : parent.entries) {
    if (name == part) return child;
  }
  parent.entries.emplace_back(part, ConfigNode{});
  return parent.entries.back().second;
}

void emit(YAML::Emitter& out, const ConfigNode& node) {
  switch (node.kind) {
    case ConfigNode::Kind::empty:
      out << YAML::BeginMap << YAML::EndMap;
      return;
    case ConfigNode::Kind::scalar:
      if (node.quoted || node.scalar.empty()) out << YAML::DoubleQuoted;
      out << node.scalar;
      return;
    case ConfigNode::Kind::list: {
      const bool is_flat = std::all_of(node.entries.begin(), node.entries.end(), [](const auto& e) {
        return e.second.kind == ConfigNode::Kind::scalar;
      });
      if (is_flat) out << YAML::Flow;
      out << YAML::BeginSeq;
      for (const auto& [key, child] : node.entries) emit(out, child);
      out << YAML::EndSeq;
      return;
    }
    case ConfigNode::Kind::map:
      out << YAML::BeginMap;
      for (const auto& [key, child] : node.entries) {
        out << YAML::Key << key << YAML::Value;
        emit(out, child);
      }
      out << YAML::EndMap;
      return;
  }
}

}  // namespace

const ConfigNode* ConfigNode::find(std::string_view key) const {
  if (kind != Kind::map) return nullptr;
  for (const auto& [name, child] : entries) {
    if (name == key) return &child;
  }
  return nullptr;
}

ConfigNode& ConfigNode::put(const std::string& key, ConfigNode value) {
  kind = Kind::map;
  for (auto& [name, child] : entries) {
    if (name == key) return child = std::move(value);
  }
  return entries.emplace_back(key, std::move(value)).second;
}

ConfigNode ConfigNode::text(std::string scalar, std::string where) {
  ConfigNode node;
  node.kind = Kind::scalar;
  node.scalar = std::move(scalar);
  node.where = std::move(where);
  return node;
}

std::string one_line(std::string message) {
  constexpr std::size_t kLongest = 2000;  // bytes: a screen
  if (message.size() > kLongest) {
    message.replace(kLongest / 2, message.size() - kLongest, " ... ");
  }
  for (char& c : message) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n' || c == '\r' || c == '\t') {
      c = ' ';
    } else if (byte < 0x20 || byte == 0x7f) {
      c = '?';
    }
  }
  return message;
}

ConfigNode parse_config(const std::string& yaml, const std::string& name) {
  ConfigNode root = load(yaml, name);
  DELOS_CHECK(root.kind == ConfigNode::Kind::map || root.kind == ConfigNode::Kind::empty,
              ErrorKind::config, root.where, ": a configuration is a map of `key: value` lines.");
  root.kind = ConfigNode::Kind::map;
  return root;
}

void override_config(ConfigNode& root, const std::string& key, const std::string& value) {
  ConfigNode parsed = load(value, text("override ", key));
  set_where(parsed, "override");
  ConfigNode* node = &root;
  for (const std::string& part : split_key(key)) node = &child_of(*node, part, key);
  *node = std::move(parsed);
}

std::string to_yaml(const ConfigNode& root) {
  YAML::Emitter out;
  emit(out, root);
  return {out.c_str(), out.size()};
}

}  // namespace delos
