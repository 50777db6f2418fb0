// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Import and export states: fields by unique name.
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "delos/export.hpp"
#include "delos/field.hpp"

namespace delos::api {

struct StateAccess;
struct StateImpl;

/// Seen from the component: its host writes imports and reads exports.
enum class Intent { imports, exports };

/// "import" or "export".
DELOS_API const char* to_string(Intent intent);

/// A handle of a component's state; copies are the same state. Empty before advertise.
class DELOS_API State {
 public:
  Intent intent() const;
  /// Items.
  std::int64_t size() const;
  /// In the order of declaration.
  std::vector<std::string> names() const;
  /// By name, else by standard name.
  bool contains(const std::string& name) const;
  /// Error(state) when it is absent, listing what there is. ESMF's code for that is
  /// kEsmfNotFound.
  Field field(const std::string& name) const;

 private:
  friend struct StateAccess;
  explicit State(std::shared_ptr<StateImpl> impl);
  std::shared_ptr<StateImpl> impl_;
};

}  // namespace delos::api

#ifndef DELOS_BUILDING_LIBRARY
namespace delos {
using api::Intent;
using api::State;
using api::to_string;
}  // namespace delos
#endif
