// SPDX-License-Identifier: BSD-3-Clause
#include "core/array.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace delos::detail {

void* allocate_large(std::size_t bytes) {
  void* memory = ::operator new (bytes, std::align_val_t{kLargePage});
#ifdef __linux__
  // A wish: where it is refused, small pages do. A page fault costs about as much as 1000
  // additions, and 2 MiB hold 512 small pages.
  madvise(memory, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
#endif
  return memory;
}

void deallocate_large(void* memory, std::size_t) noexcept {
  ::operator delete (memory, std::align_val_t{kLargePage});
}

}  // namespace delos::detail
