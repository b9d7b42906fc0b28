#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace ck {

/// Constructs elements without a value where none is given, so that the threads that write a large
/// array first are those that get its memory from the system.
template <typename T>
struct UninitializedAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = UninitializedAllocator<U>;
  };

  UninitializedAllocator() = default;
  template <typename U>
  UninitializedAllocator(const UninitializedAllocator<U>&) noexcept {}

  template <typename U>
  void construct(U* place) noexcept {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U, typename... Values>
  void construct(U* place, Values&&... values) {
    ::new (static_cast<void*>(place)) U(std::forward<Values>(values)...);
  }
};

/// A vector whose new elements have any value, unless one is given.
template <typename T>
using Uninitialized = std::vector<T, UninitializedAllocator<T>>;

}  // namespace ck
