#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace asdfvk {

/// Leaves new entries unset: the threads that write them touch their pages first, instead of one that writes zeros.
template <typename T>
struct UnsetAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };
  template <typename U>
  void construct(U* entry) {
    ::new (static_cast<void*>(entry)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* entry, Arguments&&... arguments) {
    ::new (static_cast<void*>(entry)) U(std::forward<Arguments>(arguments)...);
  }
};

/// A vector whose resize(count) and constructor from a count leave the entries unset.
template <typename T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

}  // namespace asdfvk
