// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// netCDF files, read and written: the only layer that knows the C library is netcdf.cpp behind
// this header. Every failure is an Error(input) or Error(output) that names the file, the
// variable, the library's reason and what to do.
//
// Threads: the C library (and HDF5 below it) is not thread safe, not even for different files.
// Only one thread of the process may be inside a Reader or Writer at a time.
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/write_back.hpp"

namespace delos::netcdf {

enum class Type {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64,
  text,
  other
};

/// "int16", "float64", ...
const char* to_string(Type type);

struct Dimension {
  std::string name;
  std::size_t length = 0;  ///< records so far when unlimited
  bool unlimited = false;
};

struct Variable {
  std::string name;
  Type type = Type::other;
  std::vector<Dimension> dimensions;  ///< slowest first

  std::size_t rank() const { return dimensions.size(); }
  /// Product of the lengths; 1 for a scalar.
  std::size_t n_values() const;
  /// "TEMP(20, 180, 360)".
  std::string shape_text() const;
};

/// An open file; closed when it goes out of scope. Names are looked up exactly; an unknown one is
/// an Error(input) that suggests the nearest and lists the variables with two dimensions or more.
class Reader {
 public:
  /// Error(input) when there is no such file, when it is not netCDF, or when it is shorter than
  /// its own header says (the C library would read zeros from a truncated classic file).
  explicit Reader(const std::string& path);
  ~Reader();
  Reader(Reader&& other) noexcept;
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  const std::string& path() const { return path_; }
  const std::vector<Dimension>& dimensions() const { return dimensions_; }
  const std::vector<Variable>& variables() const { return variables_; }

  bool has_dimension(const std::string& name) const;
  bool has_variable(const std::string& name) const;
  const Dimension& dimension(const std::string& name) const;
  const Variable& variable(const std::string& name) const;

  /// Attributes of a variable, of the file when `variable` is empty. Nothing when absent or of
  /// the other kind. Text loses trailing blanks and zero bytes.
  std::vector<std::string> attribute_names(const std::string& variable) const;
  std::optional<std::string> text_attribute(const std::string& variable,
                                            const std::string& name) const;
  std::optional<std::vector<double>> number_attribute(const std::string& variable,
                                                      const std::string& name) const;

  /// Of an attribute; nothing when absent.
  std::optional<Type> attribute_type(const std::string& variable, const std::string& name) const;

  /// Whole variable, converted to the type asked for; a value that does not fit is an error.
  std::vector<double> read_double(const std::string& variable) const;
  std::vector<std::int32_t> read_int32(const std::string& variable) const;
  std::vector<std::int64_t> read_int64(const std::string& variable) const;
  /// All characters of a text variable.
  std::string read_text(const std::string& variable) const;

  /// The block [start, start + count) of each dimension into `out`, which has product(count)
  /// values.
  void read(const std::string& variable, std::span<const std::size_t> start,
            std::span<const std::size_t> count, std::span<double> out) const;
  void read(const std::string& variable, std::span<const std::size_t> start,
            std::span<const std::size_t> count, std::span<std::int32_t> out) const;

 private:
  void read_contents();
  int attribute_owner(const std::string& variable) const;
  template <class T>
  std::vector<T> read_whole(const std::string& variable) const;
  template <class T>
  void read_any(const std::string& variable, std::span<const std::size_t> start,
                std::span<const std::size_t> count, std::span<T> out) const;

  std::string path_;
  int handle_ = -1;
  std::vector<Dimension> dimensions_;
  std::vector<Variable> variables_;
};

enum class Format {
  netcdf4,  ///< HDF5 underneath; variables may be compressed
  cdf5      ///< classic layout with 64-bit sizes; needs no HDF5 to read, fastest to write
};

/// Handles of what a Writer defined; valid for that Writer only.
struct DimensionId {
  int id = -1;
};
struct VariableId {
  int id = -1;
};
/// Stands for the file itself in attribute().
inline constexpr VariableId kGlobal{-1};
/// Length of the one dimension that grows.
inline constexpr std::size_t kUnlimited = 0;

/// A new file. Order: define everything, end_definitions(), put, close(). Nothing is filled in
/// advance: what is never put is undefined. Bulk data go straight from the caller's array to the
/// library, without a copy when the types agree. A Writer that goes out of scope without close()
/// (an exception on the way) leaves an incomplete file for its owner to remove.
class Writer {
 public:
  /// Replaces an existing file.
  Writer(const std::string& path, Format format);
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  const std::string& path() const { return path_; }

  /// kUnlimited: records. (A fixed dimension of length 0 does not exist in netCDF.)
  DimensionId define_dimension(const std::string& name, std::size_t length);
  /// Type: float64, float32, int64, int32, int16, int8 or text; no dimensions = scalar.
  VariableId define_variable(const std::string& name, Type type,
                             std::span<const DimensionId> dimensions);
  VariableId define_variable(const std::string& name, Type type,
                             std::initializer_list<DimensionId> dimensions);
  /// Shuffle and deflate, level 1 to 9, of a netCDF-4 variable; no effect in the other format.
  void compress(VariableId variable, int level);

  /// `_FillValue` takes the type of the variable, whatever the overload.
  void attribute(VariableId variable, const std::string& name, const std::string& value);
  void attribute(VariableId variable, const std::string& name, const char* value);
  void attribute(VariableId variable, const std::string& name, double value);
  void attribute(VariableId variable, const std::string& name, std::int32_t value);
  void attribute(VariableId variable, const std::string& name, std::span<const double> values);
  void attribute(VariableId variable, const std::string& name,
                 std::span<const std::int32_t> values);

  /// Of a long file: who writes it reads it again at once. Else it goes to the disk while it is
  /// made and leaves the memory (io/write_back.hpp).
  void keep_in_memory() { is_kept_ = true; }

  /// Error(output) when the variables (but compressed ones) need more space than the disk has.
  void end_definitions();

  /// Whole variable (of fixed size), row-major; the number of values is checked.
  void put(VariableId variable, std::span<const double> values);
  void put(VariableId variable, std::span<const float> values);
  void put(VariableId variable, std::span<const std::int32_t> values);
  void put(VariableId variable, std::span<const std::int64_t> values);
  /// A text variable; shorter text is padded with zero bytes.
  void put_text(VariableId variable, const std::string& value);

  /// The block [start, start + count) of each dimension.
  void put_block(VariableId variable, std::span<const std::size_t> start,
                 std::span<const std::size_t> count, std::span<const double> values);
  void put_block(VariableId variable, std::span<const std::size_t> start,
                 std::span<const std::size_t> count, std::span<const float> values);
  void put_block(VariableId variable, std::span<const std::size_t> start,
                 std::span<const std::size_t> count, std::span<const std::int32_t> values);

  /// Writes what is buffered: an error here (disk full) is an Error(output), and the file is
  /// incomplete.
  void close();

 private:
  template <class T>
  void put_any(VariableId variable, std::span<const std::size_t> start,
               std::span<const std::size_t> count, std::span<const T> values);
  template <class T>
  void put_whole(VariableId variable, std::span<const T> values);
  void check(int status, const std::string& doing);
  double needed_bytes() const;
  /// Of a value in a classic file, without its header.
  std::int64_t place_bytes(VariableId variable, std::span<const std::size_t> start) const;
  void check_free_space() const;
  std::string name_of(VariableId variable) const;

  std::string path_;
  Format format_;
  int handle_ = -1;
  bool has_failed_ = false;
  bool is_kept_ = false;
  WriteBack write_back_;
  std::vector<Dimension> dimensions_;
  std::vector<Variable> variables_;
  std::vector<bool> is_compressed_;
};

}  // namespace delos::netcdf
