// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>

namespace delos::benchmark {

/// Runs `work` in a process of its own and hands back its text. Call it only while this process
/// has one thread. std::runtime_error with the child's message when it threw, or that says how it
/// ended.
std::string run_in_child(const std::function<std::string()>& work);

}  // namespace delos::benchmark
