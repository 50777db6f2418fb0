// SPDX-License-Identifier: BSD-3-Clause
#include "items.hpp"

#include <algorithm>
#include <utility>

namespace delos::mpi {
namespace {

constexpr char kEndOfText = '\n';

void append(std::string& list, const std::string& text) { list += text + kEndOfText; }

}  // namespace

void refuse(const std::string& message) { throw Error(ErrorKind::state, message); }

std::string list_of(const State& state) {
  std::string list;
  for (const std::string& name : state.names()) {
    const Field field = state.field(name);
    for (const auto& text : {name, field.standard_name(), field.units(), field.long_name(),
                             std::to_string(static_cast<int>(field.location())),
                             std::to_string(field.n_components())}) {
      append(list, text);
    }
  }
  return list;
}

std::vector<Item> items_of(const std::string& list) {
  std::vector<Item> out;
  std::size_t begin = 0;
  const auto next = [&] {
    const std::size_t end = list.find(kEndOfText, begin);
    std::string text = list.substr(begin, end - begin);
    begin = end + 1;
    return text;
  };
  while (begin < list.size()) {
    Item item;
    for (std::string* text :
         {&item.info.name, &item.info.standard_name, &item.info.units, &item.info.long_name}) {
      *text = next();
    }
    item.info.location = static_cast<Location>(std::stoi(next()));
    item.info.n_components = std::stoi(next());
    out.push_back(std::move(item));
  }
  return out;
}

std::size_t find_item(const std::vector<Item>& items, const std::string& name, const char* intent) {
  const auto by_name = [&](const Item& item) { return item.info.name == name; };
  const auto item = std::find_if(items.begin(), items.end(), by_name);
  if (item != items.end()) return static_cast<std::size_t>(item - items.begin());
  std::string names;
  for (const Item& one : items) names += (names.empty() ? "" : ", ") + one.info.name;
  refuse(
      std::string("the ") + intent + " state has no field \"" + name + "\"; " +
      (names.empty() ? "it is empty: initialize(advertise) must come first" : "it has " + names));
}

bool is_spread(Location location) {
  return location == Location::cell || location == Location::edge || location == Location::vertex;
}

}  // namespace delos::mpi
