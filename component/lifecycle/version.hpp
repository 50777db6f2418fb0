// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace delos {

/// Version of the library, "major.minor.patch".
const char* library_version();

}  // namespace delos
