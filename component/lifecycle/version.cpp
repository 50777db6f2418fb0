// SPDX-License-Identifier: BSD-3-Clause
#include "lifecycle/version.hpp"

namespace delos {

const char* library_version() { return DELOS_VERSION; }

}  // namespace delos
