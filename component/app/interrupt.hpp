// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <atomic>

namespace delos::app {

/// Lets Ctrl-C (SIGINT) and SIGTERM set the flag that is returned; a second signal ends the
/// process at once. SIGXFSZ is ignored from then on.
const std::atomic<bool>& watch_for_interrupt();

}  // namespace delos::app
