// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Whole files in memory, and the numbers of text files with the line where each stands.
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace delos {

/// All bytes of a file. Error(input) when it can't be read.
std::string read_file_bytes(const std::string& path);

/// Walks through text; every complaint begins with "file:line: ".
class TextScanner {
 public:
  TextScanner(std::string path, std::string_view content)
      : path_(std::move(path)), at_(content.data()), end_(content.data() + content.size()) {}

  std::int64_t line() const { return line_; }
  /// Nothing but blanks and line ends is left.
  bool at_end();
  /// The rest of this line without its end and a '\r', and on to the next one.
  std::string_view take_line();
  /// The next word behind blanks and line ends. Error(input) when there is none.
  std::string_view word(const char* what);
  /// The next word as a number; `what` names it in messages.
  double real(const char* what) { return number<double>(what); }
  std::int64_t integer(const char* what) { return number<std::int64_t>(what); }
  /// The next word as a whole number in [least, most].
  std::int64_t integer(const char* what, std::int64_t least, std::int64_t most);
  /// A letter between numbers, e.g. ';'. Error(input) when there is another.
  void expect(char letter);

  template <class... Parts>
  [[noreturn]] void fail(const Parts&... parts) const {
    throw Error(ErrorKind::input, text(path_, ":", line_, ": ", parts...));
  }

 private:
  void skip_blanks();
  template <class T>
  T number(const char* what);

  std::string path_;
  const char* at_;
  const char* end_;
  std::int64_t line_ = 1;
};

}  // namespace delos
