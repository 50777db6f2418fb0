// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The one thing about classic netCDF files that the C library does not tell: how long they must be.
#include <cstdint>
#include <optional>
#include <string>

namespace delos::netcdf {

/// Bytes that the header of a classic file (CDF-1, CDF-2 or CDF-5) promises, up to the last value
/// of its last variable; nothing when the header itself is cut off or unreadable.
/// The layout is that of the "netCDF Classic Format Specification" (Unidata), with the 64-bit
/// counts of CDF-5 (PnetCDF).
std::optional<std::uint64_t> promised_size_bytes(const std::string& path);

}  // namespace delos::netcdf
