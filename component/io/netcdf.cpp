// SPDX-License-Identifier: BSD-3-Clause
#include "io/netcdf.hpp"

#include <netcdf.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "io/names.hpp"
#include "io/netcdf_classic.hpp"

namespace delos::netcdf {
namespace {

namespace fs = std::filesystem;

/// Free space below which a failure without a reason of its own is taken for a full disk.
constexpr std::uintmax_t kFullDiskBytes = 1U << 20;

constexpr const char* kFillName = "_FillValue";

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

int put_values(int h, int v, const std::size_t* start, const std::size_t* count, const double* in) {
  return nc_put_vara_double(h, v, start, count, in);
}
int put_values(int h, int v, const std::size_t* start, const std::size_t* count, const float* in) {
  return nc_put_vara_float(h, v, start, count, in);
}
int put_values(int h, int v, const std::size_t* start, const std::size_t* count,
               const std::int32_t* in) {
  return nc_put_vara_int(h, v, start, count, in);
}
int put_values(int h, int v, const std::size_t* start, const std::size_t* count,
               const std::int64_t* in) {
  static_assert(sizeof(long long) == sizeof(std::int64_t));
  return nc_put_vara_longlong(h, v, start, count, reinterpret_cast<const long long*>(in));
}

std::size_t product(std::span<const std::size_t> count) {
  std::size_t n = 1;
  for (std::size_t c : count) n *= c;
  return n;
}

/// What the library does not say: why a write can have failed.
std::string reason_of(int status, const std::string& path) {
  if (status == ENOSPC || status == EDQUOT) return text("disk full (", nc_strerror(status), ")");
  std::string reason = nc_strerror(status);
  std::error_code error;
  fs::path folder = fs::path(path).parent_path();
  if (folder.empty()) folder = ".";
  const fs::space_info space = fs::space(folder, error);
  if (!fs::is_directory(folder, error)) return reason + "; there is no folder " + folder.string();
  if (!error && space.available < kFullDiskBytes) {
    reason =
        text("disk full: No space left on device (", space.available, " bytes free; ", reason, ")");
  }
  return reason;
}

/// What the disk has left and the process may write into one file (`ulimit -f`).
double space_for_file_bytes(const std::string& path) {
  double bytes = std::numeric_limits<double>::infinity();
  std::error_code error;
  const fs::space_info space = fs::space(path, error);
  if (!error) bytes = static_cast<double>(space.available);
  rlimit limit{};
  if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    bytes = std::min(bytes, static_cast<double>(limit.rlim_cur));
  }
  return bytes;
}

}  // namespace

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

Reader::Reader(const std::string& path) : path_(path) {
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
                   fields.empty() ? "It has no variable of two or more dimensions."
                                  : "Variables of two or more dimensions: " + join_names(fields),
                   "."));
}

int Reader::attribute_owner(const std::string& variable) const {
  if (variable.empty()) return NC_GLOBAL;
  this->variable(variable);
  int id = -1;
  check_read(nc_inq_varid(handle_, variable.c_str(), &id), path_, variable);
  return id;
}

std::vector<std::string> Reader::attribute_names(const std::string& variable) const {
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
  nc_type code = NC_NAT;
  const int owner = attribute_owner(variable);
  if (nc_inq_atttype(handle_, owner, name.c_str(), &code) != NC_NOERR) return std::nullopt;
  return type_of(code);
}

std::vector<double> Reader::read_double(const std::string& variable) const {
  const Variable& info = this->variable(variable);
  auto values = allocate<double>(path_, info);
  const std::vector<std::size_t> start(info.rank(), 0);
  std::vector<std::size_t> count;
  for (const Dimension& dimension : info.dimensions) count.push_back(dimension.length);
  read(variable, start, count, std::span<double>(values));
  return values;
}

std::vector<std::int32_t> Reader::read_int32(const std::string& variable) const {
  const Variable& info = this->variable(variable);
  auto values = allocate<std::int32_t>(path_, info);
  const std::vector<std::size_t> start(info.rank(), 0);
  std::vector<std::size_t> count;
  for (const Dimension& dimension : info.dimensions) count.push_back(dimension.length);
  read(variable, start, count, std::span<std::int32_t>(values));
  return values;
}

std::string Reader::read_text(const std::string& variable) const {
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

Writer::Writer(const std::string& path, Format format) : path_(path), format_(format) {
  const int mode = NC_CLOBBER | (format == Format::netcdf4 ? NC_NETCDF4 : NC_64BIT_DATA);
  check(nc_create(path.c_str(), mode, &handle_), "can't be created");
  check(nc_set_fill(handle_, NC_NOFILL, nullptr), "can't be prepared");
}

Writer::~Writer() {
  // After a failed write, closing an HDF5 file fails again, and netCDF-C 4.9.0 then follows a bad
  // pointer in its report of open objects. The process is worth more than the handle.
  const bool may_crash = has_failed_ && format_ == Format::netcdf4;
  if (handle_ >= 0 && !may_crash) nc_abort(handle_);
}

std::string Writer::name_of(VariableId variable) const {
  if (variable.id < 0) return "";
  return ": variable '" + variables_[static_cast<std::size_t>(variable.id)].name + "'";
}

void Writer::check(int status, const std::string& doing) {
  if (status == NC_NOERR) return;
  has_failed_ = status == NC_EHDFERR || status > 0;  // below netCDF: HDF5 or the system
  throw Error(ErrorKind::output, text(path_, ": ", doing, ": ", reason_of(status, path_),
                                      ". Check the folder, its permissions and the free space."));
}

DimensionId Writer::define_dimension(const std::string& name, std::size_t length) {
  int id = -1;
  const std::size_t asked = length == kUnlimited ? NC_UNLIMITED : length;
  check(nc_def_dim(handle_, name.c_str(), asked, &id), "dimension '" + name + "' can't be defined");
  dimensions_.push_back({name, length, length == kUnlimited});
  return {id};
}

VariableId Writer::define_variable(const std::string& name, Type type,
                                   std::span<const DimensionId> dimensions) {
  std::vector<int> ids;
  Variable variable{name, type, {}};
  for (const DimensionId dimension : dimensions) {
    ids.push_back(dimension.id);
    variable.dimensions.push_back(dimensions_.at(static_cast<std::size_t>(dimension.id)));
  }
  int id = -1;
  check(nc_def_var(handle_, name.c_str(), code_of(type), static_cast<int>(ids.size()), ids.data(),
                   &id),
        "variable '" + name + "' can't be defined");
  variables_.push_back(variable);
  is_compressed_.push_back(false);
  return {id};
}

VariableId Writer::define_variable(const std::string& name, Type type,
                                   std::initializer_list<DimensionId> dimensions) {
  return define_variable(name, type, std::span(dimensions.begin(), dimensions.size()));
}

void Writer::compress(VariableId variable, int level) {
  if (format_ != Format::netcdf4) return;
  check(nc_def_var_deflate(handle_, variable.id, 1, 1, level),
        "can't compress" + name_of(variable));
  is_compressed_[static_cast<std::size_t>(variable.id)] = true;
}

void Writer::attribute(VariableId variable, const std::string& name, const std::string& value) {
  check(nc_put_att_text(handle_, variable.id, name.c_str(), value.size(), value.c_str()),
        "attribute '" + name + "' can't be written" + name_of(variable));
}

void Writer::attribute(VariableId variable, const std::string& name, const char* value) {
  attribute(variable, name, std::string(value));
}

void Writer::attribute(VariableId variable, const std::string& name, double value) {
  attribute(variable, name, std::span<const double>(&value, 1));
}

void Writer::attribute(VariableId variable, const std::string& name, std::int32_t value) {
  const bool typed = name == kFillName && variable.id >= 0;
  const nc_type code =
      typed ? code_of(variables_[static_cast<std::size_t>(variable.id)].type) : NC_INT;
  check(nc_put_att_int(handle_, variable.id, name.c_str(), code, 1, &value),
        "attribute '" + name + "' can't be written" + name_of(variable));
}

void Writer::attribute(VariableId variable, const std::string& name,
                       std::span<const double> values) {
  const bool typed = name == kFillName && variable.id >= 0;
  const nc_type code =
      typed ? code_of(variables_[static_cast<std::size_t>(variable.id)].type) : NC_DOUBLE;
  check(nc_put_att_double(handle_, variable.id, name.c_str(), code, values.size(), values.data()),
        "attribute '" + name + "' can't be written" + name_of(variable));
}

void Writer::check_free_space() const {
  double needed_bytes = 0.0;
  for (std::size_t v = 0; v < variables_.size(); ++v) {
    const bool is_counted = !is_compressed_[v];
    needed_bytes += is_counted ? static_cast<double>(variables_[v].n_values()) *
                                     static_cast<double>(size_bytes(variables_[v].type))
                               : 0.0;
  }
  const double free_bytes = space_for_file_bytes(path_);
  DELOS_CHECK(needed_bytes <= free_bytes, ErrorKind::output, path_, ": disk full: it needs ",
              needed_bytes / 1e6, " MB where ", free_bytes / 1e6,
              " MB may be written. Make room, raise `ulimit -f` or choose another folder.");
}

void Writer::end_definitions() {
  check_free_space();
  check(nc_enddef(handle_), "the header can't be written");
}

template <class T>
void Writer::put_any(VariableId variable, std::span<const std::size_t> start,
                     std::span<const std::size_t> count, std::span<const T> values) {
  DELOS_CHECK(values.size() == product(count), ErrorKind::internal, path_, name_of(variable), ": ",
              values.size(), " values given for a block of ", product(count), ".");
  if (values.empty()) return;
  check(put_values(handle_, variable.id, start.data(), count.data(), values.data()),
        "can't write" + name_of(variable));
}

template <class T>
void Writer::put_whole(VariableId variable, std::span<const T> values) {
  const Variable& info = variables_.at(static_cast<std::size_t>(variable.id));
  const std::vector<std::size_t> start(info.rank(), 0);
  std::vector<std::size_t> count;
  for (const Dimension& dimension : info.dimensions) count.push_back(dimension.length);
  put_any(variable, start, count, values);
}

void Writer::put(VariableId variable, std::span<const double> values) {
  put_whole(variable, values);
}
void Writer::put(VariableId variable, std::span<const float> values) {
  put_whole(variable, values);
}
void Writer::put(VariableId variable, std::span<const std::int32_t> values) {
  put_whole(variable, values);
}
void Writer::put(VariableId variable, std::span<const std::int64_t> values) {
  put_whole(variable, values);
}

void Writer::put_text(VariableId variable, const std::string& value) {
  const Variable& info = variables_.at(static_cast<std::size_t>(variable.id));
  DELOS_CHECK(value.size() <= info.n_values(), ErrorKind::internal, path_, name_of(variable), ": ",
              value.size(), " characters given where ", info.n_values(), " fit.");
  std::string padded = value;
  padded.resize(info.n_values(), '\0');
  check(nc_put_var_text(handle_, variable.id, padded.c_str()), "can't write" + name_of(variable));
}

void Writer::put_block(VariableId variable, std::span<const std::size_t> start,
                       std::span<const std::size_t> count, std::span<const double> values) {
  put_any(variable, start, count, values);
}
void Writer::put_block(VariableId variable, std::span<const std::size_t> start,
                       std::span<const std::size_t> count, std::span<const float> values) {
  put_any(variable, start, count, values);
}
void Writer::put_block(VariableId variable, std::span<const std::size_t> start,
                       std::span<const std::size_t> count, std::span<const std::int32_t> values) {
  put_any(variable, start, count, values);
}

void Writer::close() {
  if (handle_ < 0) return;
  check(nc_sync(handle_), "can't be completed");  // where HDF5 can still fail with grace
  check(nc_close(std::exchange(handle_, -1)), "can't be completed");
}

}  // namespace delos::netcdf
