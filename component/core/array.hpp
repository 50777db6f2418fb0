// SPDX-License-Identifier: BSD-3-Clause
#pragma once
// The arrays of a whole grid: a std::vector that leaves new elements of plain types unset, so that
// the loop that fills them touches their memory first (in parallel), and that asks for large pages.
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace delos {

namespace detail {
/// From this size on an array gets large pages: two of 2 MiB, so that little is wasted.
inline constexpr std::size_t kLargeBytes = std::size_t{4} << 20;
inline constexpr std::size_t kLargePage = std::size_t{2} << 20;
/// Memory in large pages where the system grants them; std::bad_alloc.
void* allocate_large(std::size_t bytes);
void deallocate_large(void* memory, std::size_t bytes) noexcept;
}  // namespace detail

template <class T>
struct ArrayAllocator {
  using value_type = T;
  ArrayAllocator() = default;
  template <class U>
  ArrayAllocator(const ArrayAllocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor)

  T* allocate(std::size_t n) {
    if (n > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_array_new_length();
    if (n * sizeof(T) >= detail::kLargeBytes) {
      return static_cast<T*>(detail::allocate_large(n * sizeof(T)));
    }
    return static_cast<T*>(::operator new (n * sizeof(T), std::align_val_t{alignof(T)}));
  }
  void deallocate(T* memory, std::size_t n) noexcept {
    if (n * sizeof(T) >= detail::kLargeBytes) {
      detail::deallocate_large(memory, n * sizeof(T));
    } else {
      ::operator delete (memory, std::align_val_t{alignof(T)});
    }
  }
  /// resize() leaves elements unset; assign(n, value), push_back() and the like set them.
  template <class U>
  void construct(U* place) noexcept(std::is_nothrow_default_constructible_v<U>) {
    ::new (static_cast<void*>(place)) U;
  }
  template <class U, class... Args>
  void construct(U* place, Args&&... args) {
    ::new (static_cast<void*>(place)) U{std::forward<Args>(args)...};
  }
  friend bool operator==(const ArrayAllocator&, const ArrayAllocator&) { return true; }
};

template <class T>
using Array = std::vector<T, ArrayAllocator<T>>;

}  // namespace delos
