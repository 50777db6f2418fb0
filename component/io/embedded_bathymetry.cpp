// SPDX-License-Identifier: BSD-3-Clause
#include "io/embedded_bathymetry.hpp"

#include <cstddef>
#include <cstdint>

// The assembler of g++ and clang++ copies the file into the object, byte by byte;
// DELOS_BATHYMETRY_FILE is its path (see CMakeLists.txt), data/make_embedded_bathymetry.py made it.
asm(".pushsection .rodata\n"
    ".hidden delos_bathymetry_bytes\n"
    ".global delos_bathymetry_bytes\n"
    ".balign 16\n"
    "delos_bathymetry_bytes:\n"
    ".incbin \"" DELOS_BATHYMETRY_FILE
    "\"\n"
    ".popsection\n");
extern "C" {
// NOLINTNEXTLINE(readability-identifier-naming): a symbol of the assembler's
__attribute__((visibility("hidden"))) extern const unsigned char delos_bathymetry_bytes[];
}

namespace delos {
namespace {

constexpr std::size_t kRows = 360;
constexpr std::size_t kColumns = 720;

/// Little-endian two's complement, whatever this machine is.
double value_m(std::size_t i) {
  const unsigned low = delos_bathymetry_bytes[2 * i];
  const unsigned high = delos_bathymetry_bytes[2 * i + 1];
  return static_cast<std::int16_t>(static_cast<std::uint16_t>(low | high << 8));
}

}  // namespace

Raster embedded_bathymetry() {
  Raster raster;
  raster.source = "built in (ETOPO5, half-degree means)";
  raster.periodic = true;
  for (std::size_t row = 0; row < kRows; ++row) {
    raster.lat_deg.push_back(-89.75 + 0.5 * static_cast<double>(row));
  }
  for (std::size_t column = 0; column < kColumns; ++column) {
    raster.lon_deg.push_back(-179.75 + 0.5 * static_cast<double>(column));
  }
  raster.values.resize(kRows * kColumns);
  for (std::size_t i = 0; i < raster.values.size(); ++i) raster.values[i] = value_m(i);
  return raster;
}

}  // namespace delos
