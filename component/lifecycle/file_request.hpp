// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Files that a configuration names.
#include <string>

#include "io/rasters.hpp"

namespace delos {

/// A field in a file that the configuration names.
struct FileRequest {
  std::string file;   ///< as written, or empty: none
  std::string where;  ///< "file:line key.path" of the key, for messages
  RasterRequest raster;
};

}  // namespace delos
