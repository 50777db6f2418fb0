// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "delos/export.hpp"

namespace delos::api {

/// Version of the library that runs, "major.minor.patch" (semantic versioning).
DELOS_API const char* version() noexcept;

}  // namespace delos::api

#ifndef DELOS_BUILDING_LIBRARY
namespace delos {
using api::version;
}  // namespace delos
#endif
