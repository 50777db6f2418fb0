// SPDX-License-Identifier: BSD-3-Clause
#include "core/array.hpp"

#include <cstdint>

// Sanitizers watch the allocator's memory only.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define DELOS_PLAIN_MEMORY
#endif
#endif
#if !defined(__linux__) || defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define DELOS_PLAIN_MEMORY
#endif

#ifndef DELOS_PLAIN_MEMORY
#include <sys/mman.h>
#endif

namespace delos::detail {

#ifdef DELOS_PLAIN_MEMORY

void* allocate_large(std::size_t bytes) { return ::operator new (bytes, std::align_val_t{64}); }

void deallocate_large(void* memory, std::size_t) noexcept {
  ::operator delete (memory, std::align_val_t{64});
}

#else

namespace {

std::size_t whole_pages(std::size_t bytes) {
  return (bytes + kLargePage - 1) / kLargePage * kLargePage;
}

}  // namespace

// Straight from the system, so that what is freed goes back to it at once, in whole large pages.
void* allocate_large(std::size_t bytes) {
  const std::size_t size = whole_pages(bytes);
  void* raw = mmap(nullptr, size + kLargePage, PROT_READ | PROT_WRITE,
                   MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (raw == MAP_FAILED) throw std::bad_alloc();
  auto* begin = static_cast<char*>(raw);
  const std::size_t before =
      (kLargePage - reinterpret_cast<std::uintptr_t>(raw) % kLargePage) % kLargePage;
  if (before > 0) munmap(begin, before);
  if (before < kLargePage) munmap(begin + before + size, kLargePage - before);
  // A wish: where it is refused, small pages do, at one page fault for every 4 KiB.
  madvise(begin + before, size, MADV_HUGEPAGE);
  return begin + before;
}

void deallocate_large(void* memory, std::size_t bytes) noexcept {
  munmap(memory, whole_pages(bytes));
}

#endif

}  // namespace delos::detail
