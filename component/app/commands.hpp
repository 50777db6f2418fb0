// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <atomic>

#include "app/arguments.hpp"

namespace delos::app {

/// Each runs one command and returns the exit status; errors are thrown.
int run_mesh(const Arguments& arguments, const std::atomic<bool>& cancel);
int run_check(const Arguments& arguments, const std::atomic<bool>& cancel);
int run_convert(const Arguments& arguments, const std::atomic<bool>& cancel);
int run_partition(const Arguments& arguments, const std::atomic<bool>& cancel);
int run_remap(const Arguments& arguments, const std::atomic<bool>& cancel);
int run_info(const Arguments& arguments);
int run_plot(const Arguments& arguments, const std::atomic<bool>& cancel);

}  // namespace delos::app
