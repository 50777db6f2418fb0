// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Large text and binary files: written through one buffer, numbers with the fewest digits that
// read back to the same bits.
#include <charconv>
#include <cstring>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace delos {

class ByteStream {
 public:
  /// Replaces the file.
  explicit ByteStream(const std::string& path)
      : path_(path), stream_(path, std::ios::binary | std::ios::trunc) {
    buffer_.reserve(kFlushBytes + kSlack);
  }

  ByteStream& operator<<(std::string_view words) {
    buffer_.append(words);
    return flush_when_full();
  }
  ByteStream& operator<<(char letter) {
    buffer_ += letter;
    return flush_when_full();
  }
  ByteStream& operator<<(double value) { return number(value); }
  ByteStream& operator<<(std::int32_t value) { return number(value); }
  ByteStream& operator<<(std::int64_t value) { return number(value); }
  ByteStream& operator<<(std::uint64_t value) { return number(value); }

  /// The bytes of a value as they are in memory.
  template <class T>
  void raw(const T& value) {
    const auto old = buffer_.size();
    buffer_.resize(old + sizeof(T));
    std::memcpy(buffer_.data() + old, &value, sizeof(T));
    flush_when_full();
  }

  /// Error(output) when not everything could be written.
  void close() {
    flush();
    stream_.close();
    DELOS_CHECK(stream_.good(), ErrorKind::output, "can't write ", path_,
                ": the disk may be full. Free some space, or choose another output folder.");
  }

 private:
  static constexpr std::size_t kFlushBytes = std::size_t{1} << 20;
  static constexpr std::size_t kSlack = 4096;

  template <class T>
  ByteStream& number(T value) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof(digits), value).ptr;
    buffer_.append(digits, end);
    return flush_when_full();
  }
  ByteStream& flush_when_full() {
    if (buffer_.size() >= kFlushBytes) flush();
    return *this;
  }
  void flush() {
    stream_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

  std::string path_;
  std::ofstream stream_;
  std::string buffer_;
};

}  // namespace delos
