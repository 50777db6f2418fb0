// SPDX-License-Identifier: BSD-3-Clause
#include "delos/version.hpp"

#include "lifecycle/version.hpp"

namespace delos::api {

const char* version() noexcept { return library_version(); }

}  // namespace delos::api
