// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the hosts of components have in common.
#include <doctest/doctest.h>

#include <delos/delos.hpp>
#include <functional>
#include <initializer_list>
#include <string>

namespace hosts {

inline delos::Config uniform(const char* spacing) {
  auto config = delos::Config::from_text(
      "sizing: {sources: [{type: constant, spacing: 600 km}]}\n"
      "refine: {tile_vertices: 500}\n");
  config.set("sizing.sources.0.spacing", spacing);
  return config;
}

inline delos::Clock daily() {
  return delos::Clock({.start = delos::Time::parse("2000-02-27"),
                       .stop = delos::Time::parse("2000-03-02"),
                       .step = delos::TimeInterval::of_days(1)});
}

inline void run_all(delos::Component& component, delos::Clock& clock) {
  for (; !clock.is_done(); clock.advance()) {
    component.run(component.import_state(), component.export_state(), clock);
  }
}

/// The digest of the grid after a whole life, initialize to the last step.
inline std::string life(const delos::Config& config, int threads) {
  delos::Component component(config, {.threads = threads});
  component.initialize();
  auto clock = daily();
  run_all(component, clock);
  const delos::Grid grid = component.grid();
  component.finalize();
  return grid.digest();
}

/// action() must throw Error(state) whose message holds the parts.
inline void refused(const std::function<void()>& action, std::initializer_list<const char*> parts) {
  std::string message;
  try {
    action();
  } catch (const delos::Error& error) {
    message = error.what();
    CHECK(error.kind() == delos::ErrorKind::state);
  }
  CAPTURE(message);
  REQUIRE_MESSAGE(!message.empty(), "no error was thrown");
  for (const char* const part : parts) CHECK(message.find(part) != std::string::npos);
}

}  // namespace hosts
