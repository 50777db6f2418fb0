// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the adapters see of a Clock.
#include "delos/clock.hpp"
#include "time/clock.hpp"

namespace delos::api {

struct ClockImpl {
  delos::Clock clock;
};

struct ClockAccess {
  static const delos::Clock& engine(const Clock& clock) { return clock.impl_->clock; }
  static delos::Clock& engine(Clock& clock) { return clock.impl_->clock; }
};

}  // namespace delos::api
