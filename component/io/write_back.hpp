// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// Long files go to the disk while they are made, and give their memory back as they go.
#include <cstdint>
#include <string>
#include <vector>

namespace delos {

/// Watches a file that somebody writes, here and there. What was written is begun to be brought to
/// the disk one piece later, and another piece later it leaves the page cache, which so holds three
/// pieces and not the whole file. Where the system can't, nothing is lost but the time.
class WriteBack {
 public:
  /// Some milliseconds of a fast disk, so that nobody waits for a piece that was begun one before,
  /// and far more than a writer keeps in buffers of its own.
  static constexpr std::int64_t kPieceBytes = std::int64_t{32} << 20;

  explicit WriteBack(std::int64_t piece_bytes = kPieceBytes) : piece_bytes_(piece_bytes) {}
  ~WriteBack();
  WriteBack(const WriteBack&) = delete;
  WriteBack& operator=(const WriteBack&) = delete;

  /// The file that is written from now on; it exists.
  void watch(const std::string& path);
  /// To be called after every write, of n_bytes from byte `begin` of the file or a little before.
  /// 0, or the errno with which the disk refused an earlier piece: the system tells that once, a
  /// later fsync by another handle may succeed, so heed it.
  int advance(std::int64_t begin, std::int64_t n_bytes);

 private:
  struct Range {
    std::int64_t begin, n_bytes;
  };
  int pass_piece();
  int drop(const Range& range);

  std::int64_t piece_bytes_;
  std::int64_t new_bytes_ = 0;
  std::vector<Range> new_, written_, begun_;  // the piece in the making and the two before
  int handle_ = -1;
};

}  // namespace delos
