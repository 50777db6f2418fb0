// SPDX-License-Identifier: BSD-3-Clause
#include "io/file_text.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace delos {
namespace {

bool is_blank(char letter) {
  return letter == ' ' || letter == '\n' || letter == '\t' || letter == '\r';
}

}  // namespace

std::string read_file_bytes(const std::string& path) {
  std::error_code failed;
  const auto size = std::filesystem::file_size(path, failed);
  DELOS_CHECK(!failed, ErrorKind::input, "can't read ", path, ": ", failed.message(),
              ". Check the name.");
  std::string out(size, '\0');
  std::ifstream stream(path, std::ios::binary);
  stream.read(out.data(), static_cast<std::streamsize>(size));
  DELOS_CHECK(stream.good() && stream.gcount() == static_cast<std::streamsize>(size),
              ErrorKind::input, "can't read ", path, ". Check its permissions.");
  return out;
}

void TextScanner::skip_blanks() {
  for (; at_ != end_ && is_blank(*at_); ++at_) line_ += *at_ == '\n' ? 1 : 0;
}

bool TextScanner::at_end() {
  skip_blanks();
  return at_ == end_;
}

std::string_view TextScanner::take_line() {
  const char* const begin = at_;
  at_ = std::find(at_, end_, '\n');
  std::string_view out(begin, static_cast<std::size_t>(at_ - begin));
  if (at_ != end_) {
    ++at_;
    ++line_;
  }
  if (!out.empty() && out.back() == '\r') out.remove_suffix(1);
  return out;
}

std::string_view TextScanner::word(const char* what) {
  skip_blanks();
  if (at_ == end_) fail("the file ends where ", what, " should be. It is cut off.");
  const char* const begin = at_;
  at_ = std::find_if(at_, end_, is_blank);
  return {begin, static_cast<std::size_t>(at_ - begin)};
}

std::int64_t TextScanner::integer(const char* what, std::int64_t least, std::int64_t most) {
  const std::int64_t value = integer(what);
  if (value < least || value > most) {
    fail(what, " is ", value, ", must be in [", least, ", ", most, "].");
  }
  return value;
}

void TextScanner::expect(char letter) {
  if (at_ == end_ || *at_ != letter) {
    fail("expected '", letter, "', found ",
         at_ == end_ ? std::string("the end of the file") : "'" + std::string(1, *at_) + "'", ".");
  }
  ++at_;
}

template <class T>
T TextScanner::number(const char* what) {
  skip_blanks();
  if (at_ == end_) fail("the file ends where ", what, " should be. It is cut off.");
  if (*at_ == '+') ++at_;  // which from_chars does not know
  T value{};
  const auto [next, status] = std::from_chars(at_, end_, value);
  const bool is_whole_word = next == end_ || is_blank(*next) || *next == ';' || *next == ',';
  bool is_number = status == std::errc() && is_whole_word;
  if constexpr (std::is_floating_point_v<T>) is_number = is_number && std::isfinite(value);
  if (!is_number) {
    const char* const stop = std::find_if(at_, std::min(end_, at_ + 40), is_blank);
    fail(what, " is '", std::string_view(at_, static_cast<std::size_t>(stop - at_)), "', no ",
         std::is_floating_point_v<T> ? "finite number." : "whole number.");
  }
  at_ = next;
  return value;
}

template double TextScanner::number<double>(const char*);
template std::int64_t TextScanner::number<std::int64_t>(const char*);

}  // namespace delos
