// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// One run of one case, and the JSON line that several make.
#include <nlohmann/json.hpp>
#include <string>

#include "benchmark/cases.hpp"

namespace delos::benchmark {

using Json = nlohmann::ordered_json;

/// Makes the grid of the case in `folder` (empty at first) and says what it cost and how good it
/// is; README.md lists the keys. Meant for a process of its own: memory is that of the process.
Json measure(const Case& benchmark_case, int threads, const std::string& folder);

/// Joins another run of the same case and thread count: the least of each time, the most memory.
/// Error(internal) when the two made different grids.
void join(const Json& other, Json& line);

/// Adds what follows from times and counts: vertices and cells a second, bytes a vertex. Rates are
/// of processor seconds on one thread, which other programs on the machine do not disturb, and of
/// wall time on more.
void add_rates(Json& line);

/// What the machine and the program are, for the head of the output.
Json machine();

}  // namespace delos::benchmark
