#pragma once

namespace asdfvk {

/// Fetches memory into the cache. The assembly statement is an effect: GCC removes the calls of a function that only
/// prefetches, because it has none.
inline void prefetchMemory(const void* place) {
  __builtin_prefetch(place);
  __asm__ volatile("");
}

}  // namespace asdfvk
