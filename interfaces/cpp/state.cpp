// SPDX-License-Identifier: BSD-3-Clause
#include "delos/state.hpp"

#include <utility>

#include "field_access.hpp"
#include "translate.hpp"

namespace delos::api {

static_assert(static_cast<int>(Intent::imports) == static_cast<int>(delos::Intent::imports));
static_assert(static_cast<int>(Intent::exports) == static_cast<int>(delos::Intent::exports));

const char* to_string(Intent intent) {
  return delos::to_string(static_cast<delos::Intent>(intent));
}

State::State(std::shared_ptr<StateImpl> impl) : impl_(std::move(impl)) {}

Intent State::intent() const { return static_cast<Intent>(impl_->state->intent()); }
std::int64_t State::size() const { return static_cast<std::int64_t>(impl_->state->items().size()); }
std::vector<std::string> State::names() const {
  std::vector<std::string> out;
  for (const auto& item : impl_->state->items()) out.push_back(item->traits().name);
  return out;
}
bool State::contains(const std::string& name) const {
  return translated([&] { return impl_->state->find(name) != nullptr; });
}
Field State::field(const std::string& name) const {
  return translated([&] { return FieldAccess::make(impl_->state->item(name)); });
}

}  // namespace delos::api
