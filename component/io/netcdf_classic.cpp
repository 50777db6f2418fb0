// SPDX-License-Identifier: BSD-3-Clause
#include "io/netcdf_classic.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <vector>

namespace delos::netcdf {
namespace {

/// Thrown inside this file when the header ends too early.
struct HeaderEnd {};

/// Longest list a header may have; a larger count means that the bytes are not a header.
constexpr std::uint64_t kMaxListLength = 1U << 24;

/// Big-endian cursor over the header.
class Header {
 public:
  explicit Header(const std::string& path) : in_(path, std::ios::binary) {
    std::array<char, 4> magic{};
    read(magic.data(), magic.size());
    version_ = static_cast<unsigned char>(magic[3]);
  }

  std::uint64_t integer(int n_bytes) {
    std::array<unsigned char, 8> bytes{};
    read(reinterpret_cast<char*>(bytes.data()), static_cast<std::size_t>(n_bytes));
    std::uint64_t value = 0;
    for (int i = 0; i < n_bytes; ++i) value = value << 8 | bytes[static_cast<std::size_t>(i)];
    return value;
  }
  /// A count or length: 64 bits in CDF-5.
  std::uint64_t count() { return integer(version_ == 5 ? 8 : 4); }
  /// A position in the file: 32 bits in CDF-1 only.
  std::uint64_t offset() { return integer(version_ == 1 ? 4 : 8); }
  std::uint64_t record_count() {
    const std::uint64_t n = count();
    const std::uint64_t streaming = version_ == 5 ? ~std::uint64_t{0} : 0xFFFFFFFFU;
    return n == streaming ? 0 : n;
  }
  std::uint64_t list_length() {
    integer(4);  // the tag: dimension, variable, attribute or absent
    const std::uint64_t n = count();
    if (n > kMaxListLength) throw HeaderEnd{};
    return n;
  }
  void skip_padded(std::uint64_t n_bytes) {
    in_.seekg(static_cast<std::streamoff>((n_bytes + 3) / 4 * 4), std::ios::cur);
    if (!in_) throw HeaderEnd{};
  }
  void skip_name() { skip_padded(count()); }

 private:
  void read(char* bytes, std::size_t n) {
    if (!in_.read(bytes, static_cast<std::streamsize>(n))) throw HeaderEnd{};
  }

  std::ifstream in_;
  int version_ = 0;
};

std::uint64_t type_size_bytes(std::uint64_t type) {
  // NC_BYTE, CHAR, SHORT, INT, FLOAT, DOUBLE, UBYTE, USHORT, UINT, INT64, UINT64
  constexpr std::array<std::uint64_t, 12> kSize = {0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
  if (type == 0 || type >= kSize.size()) throw HeaderEnd{};
  return kSize[type];
}

void skip_attributes(Header& header) {
  const std::uint64_t n = header.list_length();
  for (std::uint64_t i = 0; i < n; ++i) {
    header.skip_name();
    const std::uint64_t size = type_size_bytes(header.integer(4));
    header.skip_padded(size * header.count());
  }
}

struct VariableExtent {
  std::uint64_t begin = 0;
  std::uint64_t size = 0;  ///< of one record when is_record; without padding
  bool is_record = false;
};

VariableExtent read_variable(Header& header, const std::vector<std::uint64_t>& dimensions) {
  VariableExtent extent;
  header.skip_name();
  const std::uint64_t rank = header.count();
  if (rank > kMaxListLength) throw HeaderEnd{};
  std::uint64_t n_values = 1;
  for (std::uint64_t i = 0; i < rank; ++i) {
    const std::uint64_t dimension = header.count();
    if (dimension >= dimensions.size()) throw HeaderEnd{};
    if (dimensions[dimension] == 0) {
      extent.is_record = true;
    } else {
      n_values *= dimensions[dimension];
    }
  }
  skip_attributes(header);
  extent.size = n_values * type_size_bytes(header.integer(4));
  header.count();  // vsize: redundant, and wrong by design for large variables
  extent.begin = header.offset();
  return extent;
}

std::uint64_t end_of_data(const std::vector<VariableExtent>& variables, std::uint64_t n_records) {
  const auto n_record_variables =
      std::count_if(variables.begin(), variables.end(), [](const auto& v) { return v.is_record; });
  std::uint64_t record_size = 0;
  for (const VariableExtent& v : variables) {
    // A single record variable is not padded between its records.
    if (v.is_record) record_size += n_record_variables == 1 ? v.size : (v.size + 3) / 4 * 4;
  }
  std::uint64_t end = 0;
  for (const VariableExtent& v : variables) {
    if (!v.is_record) {
      end = std::max(end, v.begin + v.size);
    } else if (n_records > 0) {
      end = std::max(end, v.begin + (n_records - 1) * record_size + v.size);
    }
  }
  return end;
}

}  // namespace

std::optional<std::uint64_t> promised_size_bytes(const std::string& path) {
  try {
    Header header(path);
    const std::uint64_t n_records = header.record_count();
    std::vector<std::uint64_t> dimensions(header.list_length());
    for (std::uint64_t& length : dimensions) {
      header.skip_name();
      length = header.count();
    }
    skip_attributes(header);
    const std::uint64_t n_variables = header.list_length();
    std::vector<VariableExtent> variables;
    for (std::uint64_t i = 0; i < n_variables; ++i) {
      variables.push_back(read_variable(header, dimensions));
    }
    return end_of_data(variables, n_records);
  } catch (const HeaderEnd&) {
    return std::nullopt;
  }
}

}  // namespace delos::netcdf
