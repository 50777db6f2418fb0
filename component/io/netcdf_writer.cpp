// SPDX-License-Identifier: BSD-3-Clause
#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "io/netcdf_turn.hpp"
#include "io/netcdf_types.hpp"

namespace delos::netcdf {
namespace {

namespace fs = std::filesystem;

/// Free space below which a failure without a reason of its own is taken for a full disk.
constexpr std::uintmax_t kFullDiskBytes = 1U << 20;

/// What the C library gathers before it calls the system. Its own choice, 8 KiB, costs five calls
/// each; blocks of several variables in turn are read again to their ends, so more is no better.
constexpr std::size_t kBufferBytes = std::size_t{256} << 10;

/// Files from here on leave the page cache while they are made. Shorter ones stay in it for who
/// reads them next.
constexpr double kLongFileBytes = 256.0 * 1024.0 * 1024.0;

constexpr const char* kFillName = "_FillValue";

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

Writer::Writer(const std::string& path, Format format) : path_(path), format_(format) {
  const Turn turn;
  const int mode = NC_CLOBBER | (format == Format::netcdf4 ? NC_NETCDF4 : NC_64BIT_DATA);
  std::size_t buffer_bytes = kBufferBytes;
  check(nc__create(path.c_str(), mode, 0, &buffer_bytes, &handle_), "can't be created");
  check(nc_set_fill(handle_, NC_NOFILL, nullptr), "can't be prepared");
}

Writer::~Writer() {
  const Turn turn;
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
  const Turn turn;
  int id = -1;
  const std::size_t asked = length == kUnlimited ? NC_UNLIMITED : length;
  check(nc_def_dim(handle_, name.c_str(), asked, &id), "dimension '" + name + "' can't be defined");
  dimensions_.push_back({name, length, length == kUnlimited});
  return {id};
}

VariableId Writer::define_variable(const std::string& name, Type type,
                                   std::span<const DimensionId> dimensions) {
  const Turn turn;
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
  const Turn turn;
  if (format_ != Format::netcdf4) return;
  check(nc_def_var_deflate(handle_, variable.id, 1, 1, level),
        "can't compress" + name_of(variable));
  is_compressed_[static_cast<std::size_t>(variable.id)] = true;
}

void Writer::attribute(VariableId variable, const std::string& name, const std::string& value) {
  const Turn turn;
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
  attribute(variable, name, std::span<const std::int32_t>(&value, 1));
}

void Writer::attribute(VariableId variable, const std::string& name,
                       std::span<const std::int32_t> values) {
  const Turn turn;
  const bool typed = name == kFillName && variable.id >= 0;
  const nc_type code =
      typed ? code_of(variables_[static_cast<std::size_t>(variable.id)].type) : NC_INT;
  check(nc_put_att_int(handle_, variable.id, name.c_str(), code, values.size(), values.data()),
        "attribute '" + name + "' can't be written" + name_of(variable));
}

void Writer::attribute(VariableId variable, const std::string& name,
                       std::span<const double> values) {
  const Turn turn;
  const bool typed = name == kFillName && variable.id >= 0;
  const nc_type code =
      typed ? code_of(variables_[static_cast<std::size_t>(variable.id)].type) : NC_DOUBLE;
  check(nc_put_att_double(handle_, variable.id, name.c_str(), code, values.size(), values.data()),
        "attribute '" + name + "' can't be written" + name_of(variable));
}

double Writer::needed_bytes() const {
  // Compressed variables count as if they were not: HDF5 may crash when it meets a full disk.
  double bytes = 0.0;
  for (const Variable& variable : variables_) {
    bytes +=
        static_cast<double>(variable.n_values()) * static_cast<double>(size_bytes(variable.type));
  }
  return bytes;
}

std::int64_t Writer::place_bytes(VariableId variable, std::span<const std::size_t> start) const {
  // Variables follow each other in the order of their definition. The header before them is left
  // out, and the few bytes between them.
  std::size_t bytes = 0;
  for (std::size_t v = 0; v < static_cast<std::size_t>(variable.id); ++v) {
    bytes += variables_[v].n_values() * size_bytes(variables_[v].type);
  }
  const Variable& info = variables_[static_cast<std::size_t>(variable.id)];
  std::size_t index = 0;
  for (std::size_t d = 0; d < start.size(); ++d) {
    index = index * info.dimensions[d].length + start[d];
  }
  return static_cast<std::int64_t>(bytes + index * size_bytes(info.type));
}

void Writer::check_free_space() const {
  const bool is_compressed =
      std::find(is_compressed_.begin(), is_compressed_.end(), true) != is_compressed_.end();
  const double bytes = needed_bytes(), free_bytes = space_for_file_bytes(path_);
  DELOS_CHECK(bytes <= free_bytes, ErrorKind::output, path_, ": disk full: it needs ",
              is_compressed ? "up to " : "", bytes / 1e6, " MB where ", free_bytes / 1e6,
              " MB may be written. Make room, raise `ulimit -f` or choose another folder.");
}

void Writer::end_definitions() {
  const Turn turn;
  check_free_space();
  check(nc_enddef(handle_), "the header can't be written");
  // HDF5 goes back to its tables.
  const bool may_leave = format_ != Format::netcdf4 && !is_kept_;
  if (may_leave && needed_bytes() >= kLongFileBytes) write_back_.watch(path_);
}

template <class T>
void Writer::put_any(VariableId variable, std::span<const std::size_t> start,
                     std::span<const std::size_t> count, std::span<const T> values) {
  DELOS_CHECK(values.size() == product(count), ErrorKind::internal, path_, name_of(variable), ": ",
              values.size(), " values given for a block of ", product(count), ".");
  if (values.empty()) return;
  check(put_values(handle_, variable.id, start.data(), count.data(), values.data()),
        "can't write" + name_of(variable));
  check(write_back_.advance(place_bytes(variable, start),
                            static_cast<std::int64_t>(values.size_bytes())),
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
  const Turn turn;
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
  const Turn turn;
  if (handle_ < 0) return;
  check(nc_sync(handle_), "can't be completed");  // where HDF5 can still fail with grace
  check(nc_close(std::exchange(handle_, -1)), "can't be completed");
}

}  // namespace delos::netcdf
