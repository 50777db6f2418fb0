// SPDX-License-Identifier: BSD-3-Clause
#include "io/netcdf.hpp"

#include <array>

#include "io/netcdf_turn.hpp"
#include "io/netcdf_types.hpp"

namespace delos::netcdf {
namespace {

struct TypePair {
  Type type;
  nc_type code;
  const char* name;
  std::size_t size;
};
constexpr std::array<TypePair, 11> kTypes = {{{Type::int8, NC_BYTE, "int8", 1},
                                              {Type::uint8, NC_UBYTE, "uint8", 1},
                                              {Type::int16, NC_SHORT, "int16", 2},
                                              {Type::uint16, NC_USHORT, "uint16", 2},
                                              {Type::int32, NC_INT, "int32", 4},
                                              {Type::uint32, NC_UINT, "uint32", 4},
                                              {Type::int64, NC_INT64, "int64", 8},
                                              {Type::uint64, NC_UINT64, "uint64", 8},
                                              {Type::float32, NC_FLOAT, "float32", 4},
                                              {Type::float64, NC_DOUBLE, "float64", 8},
                                              {Type::text, NC_CHAR, "text", 1}}};

std::recursive_mutex& one_at_a_time() {
  static std::recursive_mutex mutex;
  return mutex;
}

}  // namespace

Turn::Turn() : lock_(one_at_a_time()) {}

Type type_of(nc_type code) {
  for (const TypePair& pair : kTypes) {
    if (pair.code == code) return pair.type;
  }
  return Type::other;
}

nc_type code_of(Type type) {
  for (const TypePair& pair : kTypes) {
    if (pair.type == type) return pair.code;
  }
  return NC_NAT;
}

std::size_t size_bytes(Type type) {
  for (const TypePair& pair : kTypes) {
    if (pair.type == type) return pair.size;
  }
  return 0;
}

const char* to_string(Type type) {
  for (const TypePair& pair : kTypes) {
    if (pair.type == type) return pair.name;
  }
  return "other";
}

std::size_t Variable::n_values() const {
  std::size_t n = 1;
  for (const Dimension& dimension : dimensions) n *= dimension.length;
  return n;
}

std::string Variable::shape_text() const {
  std::string shape = name;
  for (std::size_t d = 0; d < rank(); ++d) {
    shape += (d == 0 ? "(" : ", ") + std::to_string(dimensions[d].length);
  }
  return rank() == 0 ? shape : shape + ")";
}

}  // namespace delos::netcdf
