#pragma once

#include <cstddef>

namespace asdfvk {

/// Fetches an object of up to 64 bytes into the cache, also if the object lies in two cache lines. The assembly
/// statement counts as a side effect. Without a side effect, GCC removes calls of a function that only prefetches.
template <typename Object>
inline void prefetchMemory(const Object* object) {
  __builtin_prefetch(object);
  if constexpr (sizeof(Object) > alignof(Object))
    __builtin_prefetch(reinterpret_cast<const std::byte*>(object) + sizeof(Object) - 1);
  __asm__ volatile("");
}

}  // namespace asdfvk
