// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// What the reading and the writing half of netcdf.hpp share; nobody else includes it.
#include <netcdf.h>

#include <cstddef>
#include <span>

#include "io/netcdf.hpp"

namespace delos::netcdf {

/// Type::other for a code that has no counterpart.
Type type_of(nc_type code);
/// NC_NAT for Type::other.
nc_type code_of(Type type);
/// Of one value; 0 for Type::other.
std::size_t size_bytes(Type type);

inline std::size_t product(std::span<const std::size_t> count) {
  std::size_t n = 1;
  for (const std::size_t c : count) n *= c;
  return n;
}

}  // namespace delos::netcdf
