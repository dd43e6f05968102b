#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace asdfvk {

/// Leaves what a vector is made or grown with unset where its type allows, so that those who write the elements, in
/// parallel, are the first to touch their memory.
template <typename T>
struct UnsetAllocator : std::allocator<T> {
  template <typename U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };
  template <typename U>
  void construct(U* place) {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }
};

template <typename T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

}  // namespace asdfvk
