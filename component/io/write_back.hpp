// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Long files go to the disk while they are made, and give their memory back as they go.
#include <cstdint>
#include <string>

namespace delos {

/// Watches a file that somebody writes, in any order. Every so many bytes it has the system begin
/// with what was added and, a piece later, forget it: the page cache then holds some pieces of the
/// file instead of all of it. Where the system can't, nothing is lost but the time.
class WriteBack {
 public:
  /// Some milliseconds of a fast disk, so that nobody waits for a piece that was begun one before.
  static constexpr std::int64_t kPieceBytes = std::int64_t{32} << 20;

  explicit WriteBack(std::int64_t piece_bytes = kPieceBytes) : piece_bytes_(piece_bytes) {}
  ~WriteBack();
  WriteBack(const WriteBack&) = delete;
  WriteBack& operator=(const WriteBack&) = delete;

  /// The file that is written from now on; it exists.
  void watch(const std::string& path);
  /// To be called after every write. 0, or the errno with which the disk refused an earlier piece:
  /// the system tells that once, a later fsync by another handle may succeed, so heed it.
  int advance(std::int64_t written_bytes);

 private:
  std::int64_t piece_bytes_;
  std::int64_t pending_bytes_ = 0;
  int handle_ = -1;
};

}  // namespace delos
