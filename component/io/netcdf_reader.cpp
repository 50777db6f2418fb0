// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <utility>

#include "core/error.hpp"
#include "io/names.hpp"
#include "io/netcdf_classic.hpp"
#include "io/netcdf_turn.hpp"
#include "io/netcdf_types.hpp"

namespace delos::netcdf {
namespace {

namespace fs = std::filesystem;

void check_read(int status, const std::string& path, const std::string& variable) {
  if (status == NC_NOERR) return;
  throw Error(ErrorKind::input,
              text(path, variable.empty() ? "" : ": variable '" + variable + "'",
                   ": can't be read: ", nc_strerror(status), ". The file may be truncated or ",
                   "damaged: copy or download it again, and try `ncdump` on it."));
}

/// The first bytes of the file, for telling its kind.
std::string first_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  DELOS_CHECK(in.good(), ErrorKind::input, path,
              ": can't be opened for reading: ", std::generic_category().message(errno),
              ". Check its permissions.");
  std::string bytes(16, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

bool is_classic(const std::string& bytes) {
  return bytes.size() >= 4 && bytes.compare(0, 3, "CDF") == 0 &&
         (bytes[3] == 1 || bytes[3] == 2 || bytes[3] == 5);
}

std::string kind_text(const std::string& bytes) {
  if (bytes.empty()) return "it is empty";
  if (bytes.compare(0, 4, "\x0e\x03\x13\x01") == 0) {
    return "it is an HDF4 file: convert it to netCDF first";
  }
  if (bytes.compare(0, 4, "GRIB") == 0) return "it is a GRIB file: convert it to netCDF first";
  const bool printable = std::all_of(bytes.begin(), bytes.end(), [](unsigned char c) {
    return std::isprint(c) != 0 || std::isspace(c) != 0;
  });
  if (!printable) return "its first bytes are those of some other kind of file";
  return "it is a text file that begins with '" + bytes.substr(0, bytes.find_first_of("\r\n")) +
         "'";
}

void check_promised_size(const std::string& path) {
  const std::uint64_t size = fs::file_size(path);
  const std::optional<std::uint64_t> promised = promised_size_bytes(path);
  DELOS_CHECK(promised, ErrorKind::input, path, ": truncated or damaged: the netCDF header is not ",
              "complete (the file has ", size, " bytes). Copy or download it again.");
  DELOS_CHECK(size >= *promised, ErrorKind::input, path, ": truncated: it has ", size, " of the ",
              *promised, " bytes that its header promises. Copy or download it again.");
}

/// Refuses what the library would refuse without a reason, or read as zeros.
void check_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  DELOS_CHECK(fs::exists(status), ErrorKind::input, path, ": no such file. Check the path.");
  DELOS_CHECK(!fs::is_directory(status), ErrorKind::input, path,
              ": is a folder, not a netCDF file. Name a file in it.");
  const std::string bytes = first_bytes(path);
  if (is_classic(bytes)) {
    check_promised_size(path);
    return;
  }
  DELOS_CHECK(bytes.compare(0, 8, "\x89HDF\r\n\x1a\n") == 0, ErrorKind::input, path,
              ": is not a netCDF file: ", kind_text(bytes), ". Give a netCDF file here.");
}

Variable inquire_variable(int handle, int id, const std::string& path,
                          const std::vector<int>& dimension_ids,
                          const std::vector<Dimension>& dimensions) {
  std::array<char, NC_MAX_NAME + 1> name{};
  std::array<int, NC_MAX_VAR_DIMS> ids{};
  nc_type code = NC_NAT;
  int rank = 0;
  check_read(nc_inq_var(handle, id, name.data(), &code, &rank, ids.data(), nullptr), path, "");
  Variable variable{name.data(), type_of(code), {}};
  for (int d = 0; d < rank; ++d) {
    const auto found =
        std::find(dimension_ids.begin(), dimension_ids.end(), ids[static_cast<std::size_t>(d)]);
    DELOS_ASSERT(found != dimension_ids.end());
    variable.dimensions.push_back(
        dimensions[static_cast<std::size_t>(found - dimension_ids.begin())]);
  }
  return variable;
}

std::string without_padding(std::string value) {
  const std::size_t end = value.find('\0');
  if (end != std::string::npos) value.resize(end);
  while (!value.empty() && std::isspace(static_cast<unsigned char>(value.back())) != 0) {
    value.pop_back();
  }
  return value;
}

template <class T>
std::vector<T> allocate(const std::string& path, const Variable& variable) {
  try {
    return std::vector<T>(variable.n_values());
  } catch (const std::exception&) {  // bad_alloc or length_error
    throw Error(ErrorKind::resource,
                text(path, ": variable ", variable.shape_text(), " needs ",
                     static_cast<double>(variable.n_values()) * sizeof(T) / 1e9,
                     " GB of memory. Use a coarser file."));
  }
}

int get_block(int h, int v, const std::size_t* start, const std::size_t* count, double* out) {
  return nc_get_vara_double(h, v, start, count, out);
}
int get_block(int h, int v, const std::size_t* start, const std::size_t* count, std::int32_t* out) {
  return nc_get_vara_int(h, v, start, count, out);
}
int get_block(int h, int v, const std::size_t* start, const std::size_t* count, std::int64_t* out) {
  static_assert(sizeof(long long) == sizeof(std::int64_t));
  return nc_get_vara_longlong(h, v, start, count, reinterpret_cast<long long*>(out));
}

}  // namespace

Reader::Reader(const std::string& path) : path_(path) {
  const Turn turn;
  check_file(path);
  check_read(nc_open(path.c_str(), NC_NOWRITE, &handle_), path, "");
  try {
    read_contents();
  } catch (...) {
    nc_close(handle_);
    throw;
  }
}

Reader::Reader(Reader&& other) noexcept
    : path_(std::move(other.path_)),
      handle_(std::exchange(other.handle_, -1)),
      dimensions_(std::move(other.dimensions_)),
      variables_(std::move(other.variables_)) {}

Reader::~Reader() {
  const Turn turn;
  if (handle_ >= 0) nc_close(handle_);  // nothing was written: nothing can be lost
}

void Reader::read_contents() {
  int n_dimensions = 0;
  int n_variables = 0;
  check_read(nc_inq_dimids(handle_, &n_dimensions, nullptr, 0), path_, "");
  std::vector<int> ids(static_cast<std::size_t>(n_dimensions));
  check_read(nc_inq_dimids(handle_, &n_dimensions, ids.data(), 0), path_, "");
  int n_unlimited = 0;
  check_read(nc_inq_unlimdims(handle_, &n_unlimited, nullptr), path_, "");
  std::vector<int> unlimited(static_cast<std::size_t>(n_unlimited));
  check_read(nc_inq_unlimdims(handle_, &n_unlimited, unlimited.data()), path_, "");
  for (const int id : ids) {
    std::array<char, NC_MAX_NAME + 1> name{};
    Dimension dimension;
    check_read(nc_inq_dim(handle_, id, name.data(), &dimension.length), path_, "");
    dimension.name = name.data();
    dimension.unlimited = std::find(unlimited.begin(), unlimited.end(), id) != unlimited.end();
    dimensions_.push_back(dimension);
  }
  check_read(nc_inq_nvars(handle_, &n_variables), path_, "");
  for (int id = 0; id < n_variables; ++id) {  // in one group the ids are 0, 1, 2, ...
    variables_.push_back(inquire_variable(handle_, id, path_, ids, dimensions_));
  }
}

bool Reader::has_dimension(const std::string& name) const {
  return std::any_of(dimensions_.begin(), dimensions_.end(),
                     [&](const Dimension& d) { return d.name == name; });
}

bool Reader::has_variable(const std::string& name) const {
  return std::any_of(variables_.begin(), variables_.end(),
                     [&](const Variable& v) { return v.name == name; });
}

const Dimension& Reader::dimension(const std::string& name) const {
  std::vector<std::string> names;
  for (const Dimension& dimension : dimensions_) {
    if (dimension.name == name) return dimension;
    names.push_back(dimension.name);
  }
  throw Error(ErrorKind::input, text(path_, ": no dimension '", name, "'. It has: ",
                                     join_names(names), ". Give a file of the right kind."));
}

const Variable& Reader::variable(const std::string& name) const {
  std::vector<std::string> all;
  std::vector<std::string> fields;
  for (const Variable& variable : variables_) {
    if (variable.name == name) return variable;
    all.push_back(variable.name);
    if (variable.rank() >= 2) fields.push_back(variable.shape_text());
  }
  const std::string nearest = nearest_name(name, all);
  throw Error(ErrorKind::input,
              text(path_, ": no variable '", name, "'. ",
                   nearest.empty() ? "" : "Did you mean '" + nearest + "'? ",
                   fields.empty() ? "It has no variable of two or more dimensions"
                                  : "Variables of two or more dimensions: " + join_names(fields),
                   "."));
}

int Reader::attribute_owner(const std::string& variable) const {
  const Turn turn;
  if (variable.empty()) return NC_GLOBAL;
  this->variable(variable);
  int id = -1;
  check_read(nc_inq_varid(handle_, variable.c_str(), &id), path_, variable);
  return id;
}

std::vector<std::string> Reader::attribute_names(const std::string& variable) const {
  const Turn turn;
  const int id = attribute_owner(variable);
  int n = 0;
  check_read(nc_inq_varnatts(handle_, id, &n), path_, variable);
  std::vector<std::string> names;
  for (int i = 0; i < n; ++i) {
    std::array<char, NC_MAX_NAME + 1> name{};
    check_read(nc_inq_attname(handle_, id, i, name.data()), path_, variable);
    names.emplace_back(name.data());
  }
  return names;
}

std::optional<std::string> Reader::text_attribute(const std::string& variable,
                                                  const std::string& name) const {
  const Turn turn;
  const int id = attribute_owner(variable);
  nc_type code = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(handle_, id, name.c_str(), &code, &length) != NC_NOERR) return std::nullopt;
  if (code == NC_CHAR) {
    std::string value(length, '\0');
    check_read(nc_get_att_text(handle_, id, name.c_str(), value.data()), path_, variable);
    return without_padding(value);
  }
  if (code != NC_STRING || length == 0) return std::nullopt;
  std::vector<char*> values(length, nullptr);
  check_read(nc_get_att_string(handle_, id, name.c_str(), values.data()), path_, variable);
  const std::string first = values[0] == nullptr ? "" : values[0];
  nc_free_string(length, values.data());
  return without_padding(first);
}

std::optional<std::vector<double>> Reader::number_attribute(const std::string& variable,
                                                            const std::string& name) const {
  const Turn turn;
  const int id = attribute_owner(variable);
  nc_type code = NC_NAT;
  std::size_t length = 0;
  if (nc_inq_att(handle_, id, name.c_str(), &code, &length) != NC_NOERR) return std::nullopt;
  const Type type = type_of(code);
  if (type == Type::text || type == Type::other) return std::nullopt;
  std::vector<double> values(length);
  check_read(nc_get_att_double(handle_, id, name.c_str(), values.data()), path_, variable);
  return values;
}

std::optional<Type> Reader::attribute_type(const std::string& variable,
                                           const std::string& name) const {
  const Turn turn;
  nc_type code = NC_NAT;
  const int owner = attribute_owner(variable);
  if (nc_inq_atttype(handle_, owner, name.c_str(), &code) != NC_NOERR) return std::nullopt;
  return type_of(code);
}

template <class T>
std::vector<T> Reader::read_whole(const std::string& variable) const {
  const Variable& info = this->variable(variable);
  auto values = allocate<T>(path_, info);
  const std::vector<std::size_t> start(info.rank(), 0);
  std::vector<std::size_t> count;
  for (const Dimension& dimension : info.dimensions) count.push_back(dimension.length);
  read_any(variable, start, count, std::span<T>(values));
  return values;
}

std::vector<double> Reader::read_double(const std::string& variable) const {
  return read_whole<double>(variable);
}
std::vector<std::int32_t> Reader::read_int32(const std::string& variable) const {
  return read_whole<std::int32_t>(variable);
}
std::vector<std::int64_t> Reader::read_int64(const std::string& variable) const {
  return read_whole<std::int64_t>(variable);
}

std::string Reader::read_text(const std::string& variable) const {
  const Turn turn;
  const Variable& info = this->variable(variable);
  DELOS_CHECK(info.type == Type::text, ErrorKind::input, path_, ": variable '", variable,
              "' holds ", to_string(info.type), " values where text is expected.");
  int id = -1;
  check_read(nc_inq_varid(handle_, variable.c_str(), &id), path_, variable);
  std::string value(info.n_values(), '\0');
  check_read(nc_get_var_text(handle_, id, value.data()), path_, variable);
  return without_padding(value);
}

void Reader::read(const std::string& variable, std::span<const std::size_t> start,
                  std::span<const std::size_t> count, std::span<double> out) const {
  read_any(variable, start, count, out);
}

void Reader::read(const std::string& variable, std::span<const std::size_t> start,
                  std::span<const std::size_t> count, std::span<std::int32_t> out) const {
  read_any(variable, start, count, out);
}

template <class T>
void Reader::read_any(const std::string& variable, std::span<const std::size_t> start,
                      std::span<const std::size_t> count, std::span<T> out) const {
  const Turn turn;
  const Variable& info = this->variable(variable);
  DELOS_CHECK(info.type != Type::text && info.type != Type::other, ErrorKind::input, path_,
              ": variable '", variable, "' holds no numbers. Name a numeric variable.");
  DELOS_ASSERT(start.size() == info.rank() && count.size() == info.rank());
  DELOS_ASSERT(out.size() == product(count));
  if (out.empty()) return;
  int id = -1;
  check_read(nc_inq_varid(handle_, variable.c_str(), &id), path_, variable);
  check_read(get_block(handle_, id, start.data(), count.data(), out.data()), path_, variable);
}

}  // namespace delos::netcdf
