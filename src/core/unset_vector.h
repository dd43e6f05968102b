#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace asdfvk {

/// An allocator that leaves new elements uninitialised. Therefore the threads that write the elements are the first to
/// access the memory.
template <typename T>
struct UnsetAllocator : std::allocator<T> {
  static_assert(std::is_trivially_copyable_v<T>);  // Elements need no constructor call.
  template <typename U>
  struct rebind {
    using other = UnsetAllocator<U>;
  };
  template <typename U>
  void construct(U*) {}
  template <typename U, typename... Arguments>
  void construct(U* place, Arguments&&... arguments) {
    std::construct_at(place, std::forward<Arguments>(arguments)...);
  }
};

template <typename T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

}  // namespace asdfvk
