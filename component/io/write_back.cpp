// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_back.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace delos {

WriteBack::~WriteBack() {
  if (handle_ >= 0) ::close(handle_);
}

#ifdef SYNC_FILE_RANGE_WRITE

void WriteBack::watch(const std::string& path) {
  if (handle_ >= 0) ::close(handle_);
  handle_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  pending_bytes_ = 0;
}

// The whole file each time (length 0), since a writer may fill several variables in turn: pages
// that are neither dirty nor kept cost nothing to pass over.
int WriteBack::advance(std::int64_t written_bytes) {
  pending_bytes_ += written_bytes;
  if (handle_ < 0 || pending_bytes_ < piece_bytes_) return 0;
  pending_bytes_ = 0;
  if (::sync_file_range(handle_, 0, 0, SYNC_FILE_RANGE_WAIT_BEFORE) != 0) {
    const int reason = errno;
    if (reason == EIO || reason == ENOSPC || reason == EDQUOT) return reason;
    ::close(handle_);  // not that kind of file or system
    handle_ = -1;
    return 0;
  }
  static_cast<void>(::posix_fadvise(handle_, 0, 0, POSIX_FADV_DONTNEED));
  static_cast<void>(::sync_file_range(handle_, 0, 0, SYNC_FILE_RANGE_WRITE));
  return 0;
}

#else

void WriteBack::watch(const std::string&) {}
int WriteBack::advance(std::int64_t) { return 0; }

#endif

}  // namespace delos
