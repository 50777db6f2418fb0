// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_back.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace delos {

WriteBack::~WriteBack() {
  if (handle_ >= 0) ::close(handle_);
}

#ifdef SYNC_FILE_RANGE_WRITE

void WriteBack::watch(const std::string& path) {
  if (handle_ >= 0) ::close(handle_);
  handle_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
}

int WriteBack::advance(std::int64_t begin, std::int64_t n_bytes) {
  if (handle_ < 0) return 0;
  if (!new_.empty() && new_.back().begin + new_.back().n_bytes == begin) {
    new_.back().n_bytes += n_bytes;
  } else {
    new_.push_back({begin, n_bytes});
  }
  new_bytes_ += n_bytes;
  return new_bytes_ < piece_bytes_ ? 0 : pass_piece();
}

int WriteBack::pass_piece() {
  for (const Range& range : written_) {
    static_cast<void>(
        ::sync_file_range(handle_, range.begin, range.n_bytes, SYNC_FILE_RANGE_WRITE));
  }
  int reason = 0;
  for (const Range& range : begun_) {
    if (reason == 0 && handle_ >= 0) reason = drop(range);
  }
  begun_ = std::exchange(written_, std::exchange(new_, {}));
  new_bytes_ = 0;
  return reason;
}

int WriteBack::drop(const Range& range) {
  if (::sync_file_range(handle_, range.begin, range.n_bytes, SYNC_FILE_RANGE_WAIT_BEFORE) == 0) {
    static_cast<void>(::posix_fadvise(handle_, range.begin, range.n_bytes, POSIX_FADV_DONTNEED));
    return 0;
  }
  const int reason = errno;
  if (reason == EIO || reason == ENOSPC || reason == EDQUOT) return reason;
  ::close(handle_);  // a file or a system that does not know this
  handle_ = -1;
  return 0;
}

#else

void WriteBack::watch(const std::string&) {}
int WriteBack::advance(std::int64_t, std::int64_t) { return 0; }

#endif

}  // namespace delos
